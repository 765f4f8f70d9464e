// SPDX-License-Identifier: GPL-3.0-or-later
// Frames of screen polygons, written to and read from flat files.
#pragma once

#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "core/screen_polygon.h"
#include "core/word_reader.h"
#include "export/flat_reader.h"
#include "export/flat_writer.h"

namespace farop::test {

struct FlatPolygon {
  std::vector<ScreenVertex> vertices;
  bool back_facing = false;
  friend bool operator==(const FlatPolygon&, const FlatPolygon&) = default;
};

/// Keeps everything it is given.
class RecordedFrame : public ScreenPolygonSink {
 public:
  void begin_frame(const ScreenFrame& f) override { frame = f, begun = true; }
  void polygons(const ScreenPolygonBatch& batch) override {
    ++batches;
    for (const ScreenPolygonRecord& record : batch.polygons) {
      const auto corners = batch.corners(record);
      all.push_back({{corners.begin(), corners.end()}, record.back_facing});
      if (record.material != nullptr) ++with_material;
    }
  }
  void end_frame() override { ended = true; }

  ScreenFrame frame;
  std::vector<FlatPolygon> all;
  int batches = 0, with_material = 0;
  bool begun = false, ended = false;
};

/// What comes of reading a text.
struct FlatResult {
  bool ok = false;
  RecordedFrame frame;
  std::vector<Diagnostic> errors;
};

inline FlatResult read_flat_only(std::string_view text, bool y_down, bool plain) {
  FlatResult result;
  WordReader words(text, "test.scr");
  DiagnosticList diagnostics;
  FlatReadOptions options;
  options.y_down = y_down;
  options.plain = plain;
  result.ok = read_flat(words, diagnostics, result.frame, options);
  result.errors = std::move(diagnostics.items);
  return result;
}

/// The short way through plain lines must not show: same polygons, same messages at the same places. Blank
/// lines behind the text let it be taken to the end.
inline void expect_same_as_plain(std::string_view text, bool y_down) {
  const std::string padded = std::string(text) + std::string(80, '\n');
  const FlatResult fast = read_flat_only(padded, y_down, false), plain = read_flat_only(padded, y_down, true);
  ASSERT_EQ(fast.ok, plain.ok) << text;
  ASSERT_EQ(fast.frame.all, plain.frame.all) << text;
  ASSERT_EQ(fast.errors.size(), plain.errors.size()) << text;
  for (std::size_t i = 0; i < fast.errors.size(); ++i) {
    const Diagnostic &a = fast.errors[i], &b = plain.errors[i];
    ASSERT_EQ(a.message, b.message) << text;
    ASSERT_EQ(a.hint, b.hint) << text;
    ASSERT_EQ(a.excerpt, b.excerpt) << text;
    ASSERT_EQ(a.where.line, b.where.line) << text;
    ASSERT_EQ(a.where.column, b.where.column) << text;
  }
}

inline FlatResult read_flat_text(std::string_view text, bool y_down = false) {
  expect_same_as_plain(text, y_down);
  return read_flat_only(text, y_down, false);
}

inline void write_flat(const std::string& path, const ScreenFrame& frame,
                       const std::vector<FlatPolygon>& polygons) {
  OutputFile file(path);
  FlatWriter writer(file);
  writer.begin_frame(frame);
  ScreenPolygonBatch batch;
  for (const FlatPolygon& polygon : polygons) {
    ScreenPolygonRecord record;
    record.first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
    record.vertex_count = static_cast<std::uint32_t>(polygon.vertices.size());
    batch.polygons.push_back(record);
    batch.vertices.insert(batch.vertices.end(), polygon.vertices.begin(), polygon.vertices.end());
    if (batch.polygons.size() == 100) {
      writer.polygons(batch);
      batch.clear();
    }
  }
  writer.polygons(batch);
  writer.end_frame();
  file.commit();
}

/// Polygons of 3 to 12 corners anywhere in the frame; the corners of the frame turn up often.
inline std::vector<FlatPolygon> random_polygons(const ScreenFrame& frame, std::size_t count,
                                                std::mt19937& random) {
  const auto number = [&random](std::int64_t high) {
    switch (random() % 8) {
      case 0:
        return std::int64_t{0};
      case 1:
        return high;
      default:
        return std::uniform_int_distribution<std::int64_t>(0, high)(random);
    }
  };
  const Resolution& r = frame.resolution;
  std::vector<FlatPolygon> polygons(count);
  for (FlatPolygon& polygon : polygons) {
    polygon.vertices.resize(3 + random() % 10);
    for (ScreenVertex& v : polygon.vertices) {
      v.x = static_cast<std::int32_t>(number(std::int64_t{r.x - 1} << frame.subpixel_bits));
      v.y = static_cast<std::int32_t>(number(std::int64_t{r.y - 1} << frame.subpixel_bits));
      v.z = static_cast<std::int32_t>(number(r.z - 1));
      v.r = static_cast<std::uint16_t>(number(r.color - 1));
      v.g = static_cast<std::uint16_t>(number(r.color - 1));
      v.b = static_cast<std::uint16_t>(number(r.color - 1));
    }
  }
  return polygons;
}

}  // namespace farop::test
