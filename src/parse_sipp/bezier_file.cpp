// SPDX-License-Identifier: GPL-3.0-or-later
#include "parse_sipp/bezier_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

namespace farop::sipp {
namespace {

class BezierReader {
 public:
  BezierReader(WordReader& reader, DiagnosticSink& sink) : reader_(reader), sink_(sink) {}

  std::optional<BezierDescription> read() {
    BezierDescription out;
    if (!next("'bezier_patches:' or 'bezier_curves:'")) return std::nullopt;
    if (word_.text != "bezier_patches:" && word_.text != "bezier_curves:") {
      fail("expected 'bezier_patches:' or 'bezier_curves:'",
           "a description file starts with one of these words");
      return std::nullopt;
    }
    out.curves = word_.text == "bezier_curves:";
    const std::size_t group = out.curves ? 4 : 16;
    std::int64_t vertices = 0, groups = 0;
    if (!keyword("vertices:") || !count(vertices) || !keyword("vertex_list:")) return std::nullopt;
    for (std::int64_t i = 0; i < vertices; ++i) {
      V3d p;
      if (!coordinate(p.x) || !coordinate(p.y) || !coordinate(p.z)) return std::nullopt;
      out.points.push_back(p);
    }
    if (!keyword(out.curves ? "curves:" : "patches:") || !count(groups) ||
        !keyword(out.curves ? "curve_list:" : "patch_list:")) {
      return std::nullopt;
    }
    for (std::int64_t g = 0; g < groups; ++g) {
      for (std::size_t i = 0; i < group; ++i) {
        std::int64_t index = 0;
        if (!integer(index, "the number of a vertex")) return std::nullopt;
        if (index < 1 || index > vertices) {
          fail(fmt::format("there is no such vertex: they count from 1 to {}", vertices), "");
          return std::nullopt;
        }
        out.indices.push_back(static_cast<int>(index - 1));
      }
      // SIPP's reader takes the points of a curve in reverse order.
      if (out.curves) std::reverse(out.indices.end() - 4, out.indices.end());
    }
    if (reader_.next(word_)) {
      fail("expected the end of the file",
           fmt::format("{} {} were announced", groups, out.curves ? "curves" : "patches"));
      return std::nullopt;
    }
    return out;
  }

 private:
  // Every line of a file has room for some numbers: a count beyond this cannot be meant.
  static constexpr std::int64_t k_most = 100'000'000;

  bool next(const char* expected) {
    if (reader_.next(word_)) return true;
    Diagnostic d;
    d.where = reader_.here();
    d.message = fmt::format("the file ends where {} was expected", expected);
    d.hint = "add what is missing, or announce less";
    sink_.report(std::move(d));
    return false;
  }

  void fail(const std::string& expected, const std::string& hint) {
    sink_.report(reader_.diagnostic(Severity::error, word_,
                                    fmt::format("found '{}', {}", printable(word_.text), expected), hint));
  }

  bool keyword(const char* text) {
    if (!next(text)) return false;
    if (word_.text == text) return true;
    fail(fmt::format("expected '{}'", text), "keywords end with a colon and stand in a fixed order");
    return false;
  }

  template <class Number>
  bool whole_word(Number& value) const {
    const char* const end = word_.text.data() + word_.text.size();
    const auto [stop, error] = std::from_chars(word_.text.data(), end, value);
    return error == std::errc() && stop == end;
  }

  bool integer(std::int64_t& value, const char* what) {
    if (!next(what)) return false;
    if (whole_word(value)) return true;
    fail(fmt::format("expected {}, a whole number", what), "");
    return false;
  }

  bool count(std::int64_t& value) {
    if (!integer(value, "a count")) return false;
    if (value >= 1 && value <= k_most) return true;
    fail(fmt::format("expected a count from 1 to {}", k_most), "");
    return false;
  }

  bool coordinate(double& value) {
    if (!next("a coordinate")) return false;
    if (whole_word(value) && std::isfinite(value)) return true;
    fail("expected a coordinate, a number", "numbers look like 2, -0.5 or 1.5e-3");
    return false;
  }

  WordReader& reader_;
  DiagnosticSink& sink_;
  Word word_;
};

}  // namespace

std::optional<BezierDescription> read_bezier_file(WordReader& reader, DiagnosticSink& sink) {
  return BezierReader(reader, sink).read();
}

std::shared_ptr<Object> bezier(const BezierDescription& description, int resolution, const ShapeLook& look) {
  return description.curves ? bezier_rotcurves(description.points, description.indices, resolution, look)
                            : bezier_patches(description.points, description.indices, resolution, look);
}

}  // namespace farop::sipp
