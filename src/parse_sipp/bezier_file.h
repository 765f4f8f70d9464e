// SPDX-License-Identifier: GPL-3.0-or-later
// SIPP's description files of Bezier patches and rotational curves.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/diagnostics.h"
#include "core/word_reader.h"
#include "parse_sipp/sipp_shapes.h"

namespace farop::sipp {

/// Control points and what they span; ready for bezier_patches() or bezier_rotcurves().
struct BezierDescription {
  bool curves = false;  ///< rotational curves; otherwise patches
  std::vector<V3d> points;
  std::vector<int> indices;  ///< from 0; 16 a patch, 4 a curve (in reverse order of the file, as SIPP has it)
};

/// Words: `bezier_patches:` or `bezier_curves:`, `vertices:` count, `vertex_list:` 3 numbers each; then
/// `patches:` count `patch_list:` 16 indices each, or `curves:` count `curve_list:` 4 indices each. Indices
/// of the file count from 1; `#` starts a comment. Reads to the end of the text. Nothing after an error,
/// which is reported with its line and column; memory stays within a few times the size of the text.
std::optional<BezierDescription> read_bezier_file(WordReader& reader, DiagnosticSink& sink);

/// The shape of a description.
std::shared_ptr<Object> bezier(const BezierDescription& description, int resolution, const ShapeLook& look);

}  // namespace farop::sipp
