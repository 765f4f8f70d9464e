// SPDX-License-Identifier: GPL-3.0-or-later
// Reads scenes in NFF, the Neutral File Format of E. Haines (document version 3.9, 1996).
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/diagnostics.h"
#include "core/progress.h"
#include "core/word_reader.h"
#include "scene/scene.h"

namespace farop {

/// Takes a part of a scene: surfaces in order, to keep or to let go. A large surface comes in several parts,
/// each with vertices of its own. `so_far`: the lights and the view that stand before it; its object has no
/// surfaces.
using NffPartFunction =
    std::function<void(const Scene& so_far, std::vector<std::shared_ptr<Surface>> surfaces)>;

struct NffOptions {
  ProgressFunction progress;  ///< called with bytes read so far and bytes in all, once per block of input
  bool plain = false;         ///< the plain reader alone: same scene, same messages, slower; for comparison
  /// That read at once; more than one helps with long files and texts, not with pipes. 0: as many as the
  /// machine gives this process, one for files that are read before another has started.
  int threads = 1;
  std::size_t piece_bytes = std::size_t{1} << 18;  ///< of the text that a thread looks at as a unit
  /// Where given, surfaces go there and not into the scene, whenever they have come to some `part_bytes` or
  /// `part_curved` spheres and cones, and at the end: memory does not grow with the scene.
  NffPartFunction on_part;
  std::size_t part_bytes = std::size_t{8} << 20;
  std::size_t part_curved = 4096;
  int warnings_per_kind = 3;  ///< further ones are only counted, in one closing line per kind
};

/// Reads one NFF file to its end. The scene has one object under the root, named after the file without
/// folder and extension, with a surface for every `f` that an object follows; world coordinates,
/// right-handed, nothing moved, split or tessellated. View parameters that the file does not give stay empty.
/// `inputs` holds one summary.
///
/// Text level, dialects that are read or skipped, and all errors: nff.md. The first error ends reading; it is
/// the last thing reported. Warnings never end it.
///
/// reader   at the start of the file; `%` becomes a second comment character (AFF dialect)
/// returns  nothing after an error was reported to `sink`
/// throws   Error(ExitStatus::input) from the reader when the file cannot be read
///
/// Scene and messages do not depend on `threads` and `piece_bytes`.
///
/// Memory grows with what was read, with `on_part` with its parts and the largest polygon alone, never with a
/// count that the file merely announces. While reading, threads
/// > 1 need some MB beside (nff_read_ahead.h), fixed by their number and `piece_bytes`.
std::optional<Scene> parse_nff(WordReader& reader, DiagnosticSink& sink, const NffOptions& options = {});

}  // namespace farop
