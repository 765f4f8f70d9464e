// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes, one function each, and what several of them share.
#pragma once

#include "spd/nff_printer.h"

namespace farop {

void print_balls(NffPrinter& printer, const SceneForm& form);
void print_gears(NffPrinter& printer, const SceneForm& form);
void print_mount(NffPrinter& printer, const SceneForm& form);
void print_rings(NffPrinter& printer, const SceneForm& form);
void print_teapot(NffPrinter& printer, const SceneForm& form);
void print_tetra(NffPrinter& printer, const SceneForm& form);
void print_tree(NffPrinter& printer, const SceneForm& form);
void print_jacks(NffPrinter& printer, const SceneForm& form);
void print_lattice(NffPrinter& printer, const SceneForm& form);
void print_shells(NffPrinter& printer, const SceneForm& form);
void print_sombrero(NffPrinter& printer, const SceneForm& form);
void print_nurbtst(NffPrinter& printer, const SceneForm& form);
void print_sample(NffPrinter& printer, const SceneForm& form);
void print_hollow_cube(NffPrinter& printer, const SceneForm& form);
void print_solid_torus(NffPrinter& printer, const SceneForm& form);
void print_solid_cylinder(NffPrinter& printer, const SceneForm& form);

/// Background of most scenes.
constexpr Rgb k_sky{0.078, 0.361, 0.753};

/// Material of a scene's `f`, its highlight given as the angle from the mirror direction, in degrees, at
/// which it has half its strength: exponent ln 0.5 / ln cos h. 0 = no visible highlight, printed as 100000;
/// from 90 on: 1.
Material material(const Rgb& color, double kd, double ks, double half_angle, double transmittance,
                  double refraction);

double radians(double degrees);

/// Right-handed rotation about an axis through the origin, for row vectors: point * rotation(...).
M44d rotation(const V3d& axis, double radians);

}  // namespace farop
