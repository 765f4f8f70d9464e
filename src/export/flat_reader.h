// SPDX-License-Identifier: GPL-3.0-or-later
// Flat file -> screen polygons, strictly: the reader is a test instrument for programs that write such files.
#pragma once

#include "core/diagnostics.h"
#include "core/progress.h"
#include "core/screen_polygon.h"
#include "core/word_reader.h"

namespace farop {

struct FlatReadOptions {
  bool plain = false;  ///< the plain way through numbers alone: same polygons, same messages; for comparison
  /// The numbers of the file count rows from the top (a flat file does not say so itself).
  bool y_down = false;
  /// Under y_down: hands on rows as the file counts them, in a frame that says so, instead of turning them y
  /// up.
  bool keep_rows = false;
  std::uint32_t max_vertices = 0;  ///< ScreenFrame::max_vertices of the frame; known from an earlier pass
  ProgressFunction progress;       ///< in bytes; may be empty
};

/// Reads one flat file (farop.md section 4; the layout is in flat_format.h) and hands its polygons to
/// `polygons` in batches, in file order, y up whatever the file counts (then y = its maximum minus the file's
/// y) unless keep_rows.
///
/// Every line holds exactly its integers; blank lines, further blanks, CRLF and `#` comments are allowed.
/// Integers are decimal digits; leading zeros are allowed, signs are not (so "-0" is an error too). Colours
/// may reach CRES, as in the 1997 paper's example, and are delivered as CRES-1. A polygon that runs clockwise
/// on the screen (y up) is marked back-facing; one without area is not. Materials are null: all is opaque.
///
/// Returns true when the whole file was read; otherwise exactly one error has been reported, end_frame() was
/// not called, and what `polygons` got so far is to be thrown away. Memory: one batch; a polygon is never
/// larger than the part of the file that has been read. Throws Error(ExitStatus::input) when the file cannot
/// be read, and what `polygons` throws.
bool read_flat(WordReader& reader, DiagnosticSink& diagnostics, ScreenPolygonSink& polygons,
               const FlatReadOptions& options = {});

}  // namespace farop
