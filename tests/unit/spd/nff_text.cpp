// SPDX-License-Identifier: GPL-3.0-or-later
#include "nff_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace farop::test {

SpdRequest request(std::string name, std::optional<int> size, bool tessellate,
                   std::optional<int> resolution) {
  return {std::move(name), size, tessellate, resolution};
}

std::string printed(const SpdRequest& request) {
  std::string text;
  write_spd(request, [&text](std::string_view block) { text += block; });
  return text;
}

void EntityCounter::add(std::string_view block) {
  while (!block.empty()) {
    const std::size_t end = block.find('\n');
    if (end == std::string_view::npos) throw std::runtime_error("a block ends within a line");
    if (block.starts_with("p ")) ++counts_.polygons;
    if (block.starts_with("pp ")) ++counts_.patches;
    if (block.starts_with("s ")) ++counts_.spheres;
    if (block.starts_with("c ")) ++counts_.cones;
    if (block.starts_with("f ")) ++counts_.fills;
    if (block.starts_with("l ")) ++counts_.lights;
    block.remove_prefix(end + 1);
  }
}

SpdCounts scanned_counts(const SpdRequest& request) {
  EntityCounter counter;
  write_spd(request, [&counter](std::string_view block) { counter.add(block); });
  return counter.counts();
}

namespace {

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  std::size_t begin = text.find_first_not_of(separators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(separators, end);
  }
  return parts;
}

V3d vector_from(const std::vector<std::string_view>& words, std::size_t first) {
  return {to_number(words.at(first)), to_number(words.at(first + 1)), to_number(words.at(first + 2))};
}

}  // namespace

std::vector<std::string_view> lines_of(std::string_view text) {
  return split(text, "\n");
}
std::vector<std::string_view> words_of(std::string_view text) {
  return split(text, " \n");
}

double to_number(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    throw std::runtime_error("not a number: " + std::string(word));
  return value;
}

bool agree(std::string_view ours, std::string_view theirs) {
  const auto is_name = [](std::string_view word) {
    return std::isalpha(static_cast<unsigned char>(word[0])) != 0;
  };
  if (is_name(ours) || is_name(theirs)) return ours == theirs;
  const double a = to_number(ours), b = to_number(theirs);
  const double difference = std::abs(a - b);
  return difference <= 1e-9 || difference <= 1.01e-5 * std::max(std::abs(a), std::abs(b));
}

std::vector<PrintedPolygon> polygons_of(std::string_view text) {
  std::vector<PrintedPolygon> polygons;
  const std::vector<std::string_view> lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<std::string_view> head = words_of(lines[i]);
    if (head[0] != "p" && head[0] != "pp") continue;
    PrintedPolygon polygon;
    polygon.is_patch = head[0] == "pp";
    const auto corners = static_cast<std::size_t>(to_number(head.at(1)));
    for (std::size_t k = 0; k < corners; ++k) {
      polygon.lines.push_back(lines.at(++i));
      const std::vector<std::string_view> words = words_of(lines[i]);
      if (words.size() != (polygon.is_patch ? 6u : 3u)) throw std::runtime_error("odd corner line");
      polygon.positions.push_back(vector_from(words, 0));
      if (polygon.is_patch) polygon.normals.push_back(vector_from(words, 3));
    }
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

V3d vector_after(std::string_view text, std::string_view keyword) {
  for (const std::string_view line : lines_of(text)) {
    const std::vector<std::string_view> words = words_of(line);
    if (words[0] == keyword) return vector_from(words, 1);
  }
  throw std::runtime_error("no line begins with " + std::string(keyword));
}

}  // namespace farop::test
