// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace farop {

/// line: every edge, hidden ones too. flat: the first corner's colour for the whole polygon (the geometry
/// stage gives all corners one colour; a flat file need not). gouraud interpolates the corners' colours.
/// phong interpolates normals and lights every visible fragment.
enum class DrawMode { line, flat, gouraud, phong };

}  // namespace farop
