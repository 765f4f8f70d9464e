// SPDX-License-Identifier: GPL-3.0-or-later
// Words that are not in the format but occur in files: AFF (the Animated File Format of BART: J. Lext, U.
// Assarsson and T. Moller, "A Benchmark for Animated Ray Tracing", IEEE CG&A 21(2), 2001), ENFF, Graphics
// Gems V and tracers written in courses. What has a certain extent and a meaning here is read, what has a
// certain extent and loses no geometry is skipped, everything else is an error: silently losing geometry
// would falsify counts and timings.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "parse_nff/nff_parser.h"

namespace farop::nff {
namespace {

constexpr std::string_view k_named_light_needs = "a name and 3 numbers (x y z) or 6 (x y z r g b)";

/// Words whose extent or meaning is not certain, and why.
constexpr std::pair<std::string_view, std::string_view> k_unsupported[] = {
    {"x", "AFF transform"},
    {"xs", "AFF transform"},
    {"m", "mesh"},
    {"mesh", "AFF mesh"},
    {"i", "include file"},
    {"include", "include file"},
    {"includeO", "include file"},
    {"obj", "external object file"},
    {"pb", "ENFF Bezier patch"},
    {"pn", "ENFF NURBS patch"},
    {"pnn", "ENFF NURBS patch"},
    {"pn_end", "ENFF NURBS patch"},
    {"dod", "dodecahedron of another dialect"},
    {"oct", "octahedron of another dialect"},
    {"tet", "tetrahedron of another dialect"},
    {"hex", "hexahedron of another dialect"},
    {"vo", "orthographic view"},
    {"vd", "view with depth of field"},
    {"vfisheye", "fish-eye view"},
    {"{", "block of another dialect"},
    {"}", "block of another dialect"},
    {"yaml{", "block of another dialect"},
    {"transform", "transform of another dialect"},
    {"larea", "area light"},
    {"lddome", "dome light"},
    {"lsun", "sun light"},
    {"lddirection", "directional light"},
    {"diffuse", "material of another dialect"},
    {"glossy", "material of another dialect"},
    {"medium", "material of another dialect"},
    {"Q", "word of another dialect"},
    {"Z", "word of another dialect"},
    {"T", "word of another dialect"},
};

}  // namespace

const std::vector<Parser::Keyword>& Parser::dialect_keywords() {
  static const std::vector<Keyword> k_keywords = [] {
    std::vector<Keyword> keywords = {
        {"fm", &Parser::bart_fill},
        {"fp", &Parser::alias_fill},
        {"fl", &Parser::color_fill},
        {"flam", &Parser::color_fill},
        {"la", &Parser::named_light},
        {"tpp", &Parser::textured_patch},
        {"tt", &Parser::textured_triangle},
        {"ttp", &Parser::textured_triangle},
        {"tpa", &Parser::animated_triangle},
        {"am", &Parser::skip_three_numbers},
        {"a", &Parser::skip_three_numbers},
        {"d", &Parser::skip_one_number},
        {"tess", &Parser::skip_one_number},
        {"k", &Parser::skip_key_frames},
        {"shader", &Parser::skip_rest_of_line},
        {"texture", &Parser::skip_rest_of_line},
        {"begin_hierarchy", &Parser::skip_hierarchy_word},
        {"end_hierarchy", &Parser::skip_hierarchy_word},
    };
    for (const auto& [name, reason] : k_unsupported) keywords.push_back({name, &Parser::unsupported});
    return keywords;
  }();
  return k_keywords;
}

void Parser::unsupported(const Word& keyword) {
  const auto* const found = std::find_if(std::begin(k_unsupported), std::end(k_unsupported),
                                         [&](const auto& u) { return u.first == keyword.text; });
  fail(keyword, fmt::format("'{}' is not supported: {}", keyword.text, found->second),
       "convert the scene to the entities of NFF: v b l f c s p pp");
}

// ------------------------------------------------------------------------------------------- materials and
// lights

// AFF: ambient, diffuse and specular colour, shine, transmittance, index of refraction.
void Parser::bart_fill(const Word& keyword) {
  const Run run = read_exactly(
      keyword, 12, "12 numbers (ambient, diffuse, specular r g b, shine, T, index of refraction)");
  Material m;
  m.color = run.color(3);
  m.ks = std::max({run.values[6], run.values[7], run.values[8]});
  m.shine = run.values[9];
  m.transmittance = run.values[10];
  m.refraction = run.values[11];
  warn(keyword, "'fm' is not in the NFF format; colour = diffuse, Ks = largest specular component");
  set_fill(m, run.places[9], run.places[10]);
}

void Parser::alias_fill(const Word& keyword) {
  warn(keyword, "'fp' is not in the NFF format; read as 'f'");
  read_fill(keyword);
}

void Parser::color_fill(const Word& keyword) {
  Material m;
  m.color = read_exactly(keyword, 3, "3 numbers (r g b)").color(0);
  warn(keyword,
       fmt::format("'{}' is not in the NFF format; read as 'f' with this colour and defaults", keyword.text));
  set_fill(m, keyword, keyword);
}

void Parser::named_light(const Word& keyword) {
  skip_name(keyword, k_named_light_needs);
  const Run run = read_run(keyword);
  if (run.count > 6) fail_extra(keyword, run.places[6], k_named_light_needs, run.count, {});
  if (run.count != 3 && run.count != 6) fail_missing(keyword, k_named_light_needs, run.count);
  warn(keyword, "'la' is not in the NFF format; read as 'l', the light stands still");
  Light light{run.vector(0), std::nullopt};
  if (run.count == 6) light.color = run.color(3);
  add_light(keyword, light);
}

// ----------------------------------------------------------------------------------------------------
// geometry

// ENFF: u and v behind position and normal.
void Parser::textured_patch(const Word& keyword) {
  warn(keyword, "'tpp' is not in the NFF format; read as 'pp', texture coordinates are dropped");
  corners(keyword, {true, 8});
}

// AFF: a texture's name, then three corners.
void Parser::textured_triangle(const Word& keyword) {
  const CornerFormat format = keyword.text == "ttp" ? CornerFormat{true, 8} : CornerFormat{false, 5};
  const std::string needs = fmt::format("a texture name and {} numbers for 3 vertices", 3 * format.numbers);
  skip_name(keyword, needs);
  const Run run = read_exactly(keyword, 3 * format.numbers, needs);
  warn(keyword, fmt::format("'{}' is not in the NFF format; read as '{} 3', the texture is dropped",
                            keyword.text, format.normal ? "pp" : "p"));
  add_triangle(keyword, run.values.data(), format);
}

// AFF: a number of keys, each a time and three corners with normals.
void Parser::animated_triangle(const Word& keyword) {
  constexpr std::string_view k_needs = "a number of keys, then for each a time and 3 vertices with normals";
  constexpr std::size_t k_key_numbers = 19;
  std::int64_t keys = 0;
  const Word place = read_integer(keyword, k_needs, 0, keys);
  if (keys < 1) fail(place, fmt::format("'tpa' announces {} keys, expected 1 or more", keys));
  std::array<double, k_key_numbers> first;
  for (std::int64_t key = 0; key < keys; ++key) {
    for (std::size_t i = 0; i < k_key_numbers; ++i) {
      double value = 0;
      if (!take_number(value))
        fail_missing(keyword, k_needs, 1 + static_cast<std::uint64_t>(key) * k_key_numbers + i);
      if (key == 0) first[i] = value;
    }
  }
  warn(keyword, "'tpa' is not in the NFF format; the first key is read as 'pp 3'");
  add_triangle(keyword, first.data() + 1, {true, 6});
}

void Parser::add_triangle(const Word& keyword, const double* numbers, CornerFormat format) {
  before_object(keyword);
  builder_.begin_polygon(format.normal);
  for (int i = 0; i < 3; ++i, numbers += format.numbers) {
    const V3d position(numbers[0], numbers[1], numbers[2]);
    if (format.normal) {
      builder_.add_corner(position, V3d(numbers[3], numbers[4], numbers[5]));
    } else {
      builder_.add_corner(position);
    }
  }
  builder_.end_polygon();
  count_polygon(format.normal);
}

// -------------------------------------------------------------------------------------------------------
// skipping

void Parser::skip_three_numbers(const Word& keyword) {
  read_exactly(keyword, 3, "3 numbers");
  warn_once(keyword, fmt::format("'{}' is not in the NFF format; skipped", keyword.text));
}

void Parser::skip_one_number(const Word& keyword) {
  read_exactly(keyword, 1, "1 number");
  warn_once(keyword, fmt::format("'{}' is not in the NFF format; skipped", keyword.text));
}

// AFF: a name and key frames in braces, which may contain braces.
void Parser::skip_key_frames(const Word& keyword) {
  constexpr std::string_view k_needs = "a name and key frames in braces";
  skip_name(keyword, k_needs);
  if (at_end_ || word_.text != "{") {
    if (!at_end_)
      fail(word_, fmt::format("expected '{{' behind the name of 'k', found '{}'", printable(word_.text)));
    fail_missing(keyword, k_needs, 0);
  }
  std::uint64_t depth = 0;
  do {
    if (at_end_) fail(keyword, "end of file inside 'k': its '{' is never closed", "add the missing '}'");
    refuse_binary(in_entity());
    if (word_.text == "{") ++depth;
    if (word_.text == "}") --depth;
    advance();
  } while (depth > 0);
  warn_once(keyword, "'k' is not in the NFF format; key frames are skipped");
}

void Parser::skip_rest_of_line(const Word& keyword) {
  warn_once(keyword,
            fmt::format("'{}' is not in the NFF format; skipped to the end of the line", keyword.text));
  skip_line(keyword.line);
}

void Parser::skip_hierarchy_word(const Word& keyword) {
  warn_once(keyword,
            fmt::format("'{}' is not in the NFF format; skipped, the contents are kept", keyword.text));
}

}  // namespace farop::nff
