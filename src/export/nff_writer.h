// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a scene in NFF, the Neutral File Format of E. Haines (document version 3.9, 1996).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "core/output_file.h"
#include "scene/scene.h"

namespace farop {

/// Splits one polygon: world-space corners in order -> triangles as triples of corner indices, same
/// orientation. `out` comes empty.
using TriangulateFunction =
    std::function<void(std::span<const V3d> corners, std::vector<std::array<std::uint32_t, 3>>& out)>;

/// Takes the text piece by piece.
using TextFunction = std::function<void(std::string_view text)>;

struct NffWriteOptions {
  TriangulateFunction triangulate;  ///< for polygons of more than three corners; empty: they stay whole
  std::string name = "output";      ///< what notices are about
};

/// Writes the tessellated scene in world coordinates: `b` if the scene has a background, the `v` block with
/// every parameter that is known if both from and at are, all lights as nff_lights() has them, then each
/// surface that has polygons as one `f` and its polygons in order. `pp` where corners have given normals (as
/// read, moved by the surface's normal rule) or the surface has averaged normals, `p` elsewhere. Polygons
/// that their object's matrix mirrors are walked the other way round, so that their front stays in front. The
/// angle is the vertical one. Shaders are written as Shader::approximate() says.
///
/// Numbers are the shortest decimal text that reads back as the same double, so parsing the output of a scene
/// that was read from one NFF file gives that scene again, and writing it a second time the same bytes.
///
/// sink    a note per kind of thing that NFF cannot say and that is left out: yon, a Ka other than 0.30, a
///         view without from or at, pixels that are not square; one note that names all that is lost of
///         shaders, lights and shadows
/// throws  Error(ExitStatus::input) when a coordinate left the range of a double on its way to world space;
///         Error(ExitStatus::internal) for a scene with curved primitives; whatever `write` throws
///
/// Holds 64 KiB of text at a time, and one polygon when triangulating.
void write_nff(const Scene& scene, const NffWriteOptions& options, const TextFunction& write,
               DiagnosticSink& sink);

/// The same into a file, which the caller commits. Throws also what OutputFile::write throws.
void write_nff(const Scene& scene, const NffWriteOptions& options, OutputFile& file, DiagnosticSink& sink);

}  // namespace farop
