// SPDX-License-Identifier: GPL-3.0-or-later
// Looks at printed NFF text without the project's own parser.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/math.h"
#include "spd/spd.h"

namespace farop::test {

/// The default form, or the tessellated one.
SpdRequest request(std::string name, std::optional<int> size = {}, bool tessellate = false,
                   std::optional<int> resolution = {});

/// All of a scene's text.
std::string printed(const SpdRequest& request);

/// Counts entities by the first word of each line of blocks that hold whole lines.
class EntityCounter {
 public:
  void add(std::string_view block);
  const SpdCounts& counts() const { return counts_; }

 private:
  SpdCounts counts_;
};

/// Entities that a scene really prints; nothing of the text is kept.
SpdCounts scanned_counts(const SpdRequest& request);

std::vector<std::string_view> lines_of(std::string_view text);
/// Separated by blanks and line ends.
std::vector<std::string_view> words_of(std::string_view text);
double to_number(std::string_view word);

/// The rule for comparing with other people's output: equal words; numbers equal within 1e-9 (what is zero
/// but for rounding) or a relative 1.01e-5 (the last of six digits).
bool agree(std::string_view ours, std::string_view theirs);

/// A `p` or `pp` as printed.
struct PrintedPolygon {
  bool is_patch = false;
  std::vector<std::string_view> lines;  ///< one a corner
  std::vector<V3d> positions;
  std::vector<V3d> normals;  ///< patches only
};
/// Views into `text`, which must outlive the result.
std::vector<PrintedPolygon> polygons_of(std::string_view text);

/// The three numbers behind a keyword that begins a line ("from"), first occurrence.
V3d vector_after(std::string_view text, std::string_view keyword);

}  // namespace farop::test
