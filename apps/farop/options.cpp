// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/limits.h"
#include "scene/tessellate.h"

namespace farop::app {
namespace {

template <class T>
std::optional<T> whole(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> finite_number(std::string_view text) {
  const std::optional<double> value = whole<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

bool is_integer(std::string_view word) {
  return whole<std::int64_t>(word).has_value();
}

[[noreturn]] void usage(const std::string& message, const std::string& hint = {}) {
  throw Error(ExitStatus::usage, message, hint);
}

V3d vector_of(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

CLI::Option* add_triple(CLI::App& command, const std::string& name, std::vector<double>& value,
                        const std::string& help, const std::string& words = "X Y Z") {
  return command.add_option(name, value, help)->expected(3)->delimiter(',')->type_name(words)->group("View");
}

}  // namespace

void add_input_options(CLI::App& command, InputOptions& options) {
  command.add_option("input", options.files, "scene files; - is standard input")
      ->required()
      ->type_name("IN")
      ->group("Input");
  command.add_option("--format", options.format, "format of inputs whose suffix does not tell [nff]")
      ->check(CLI::IsMember({"nff", "sipp"}))
      ->type_name("nff|sipp")
      ->group("Input");
  command.add_flag("--strict", options.strict, "treat warnings as errors")->group("Input");
  const char* script = "scripts: set a variable; which SippRender counts [1]";
  command.add_option("--define", options.defines, script)
      ->type_name("NAME=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("Input");
  command.add_option("--capture", options.capture, script)
      ->check(CLI::Range(1, 1'000'000'000))
      ->type_name("N")
      ->group("Input");
  ScriptLimits& limits = options.limits;
  const std::string most =
      fmt::format("what scripts may use up [{:g} s, {} MB, {:g}, {:g}, {}]", limits.seconds, limits.memory_mb,
                  static_cast<double>(limits.commands), static_cast<double>(limits.polygons), limits.nesting);
  command.add_option("--script-time", limits.seconds, most)
      ->check(CLI::Range(0.001, 1e6))
      ->type_name("S")
      ->group("Input");
  command.add_option("--script-memory", limits.memory_mb, most)
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 24))
      ->type_name("MB")
      ->group("Input");
  command.add_option("--script-commands", limits.commands, most)
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{2'147'483'647}))
      ->type_name("N")
      ->group("Input");
  command.add_option("--script-polygons", limits.polygons, most)
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000'000}))
      ->type_name("N")
      ->group("Input");
  command.add_option("--script-nesting", limits.nesting, most)
      ->check(CLI::Range(10, 100'000))
      ->type_name("N")
      ->group("Input");
}

void add_output_option(CLI::App& command, std::string& output, const std::string& what, bool required) {
  command.add_option("-o,--output", output, what)->required(required)->type_name("OUT")->group("Output");
}

void add_background_option(CLI::App& command, std::vector<double>& background, const std::string& group) {
  add_triple(command, "--background", background, "background colour, 0..1", "R G B")->group(group);
}

void add_camera_options(CLI::App& command, ViewOptions& options) {
  command.add_option("--resolution", options.resolution, "pixels WxH, or X Y Z C with depths and colours")
      ->type_name("WxH")
      ->group("View");
  add_triple(command, "--from", options.from, "eye point, middle of the picture, direction that is up in it");
  add_triple(command, "--at", options.at, "eye point, middle of the picture, direction that is up in it");
  add_triple(command, "--up", options.up, "eye point, middle of the picture, direction that is up in it");
  command.add_option("--angle", options.angle, "full angle of view, degrees")
      ->check(CLI::Number)
      ->type_name("DEG")
      ->group("View");
  command
      .add_option("--hither", options.hither, "near and far plane, distances; auto: just behind the scene")
      ->type_name("D")
      ->group("View");
  command.add_option("--yon", options.yon, "near and far plane, distances; auto: just behind the scene")
      ->type_name("D|auto|inf")
      ->group("View");
  command.add_option("--fit", options.fit, "dimension that the angle measures [vertical]")
      ->check(CLI::IsMember({"vertical", "horizontal", "smaller", "both"}))
      ->type_name("vertical|horizontal|smaller|both")
      ->group("View");
  add_background_option(command, options.background, "View");
}

void add_view_options(CLI::App& command, ViewOptions& options) {
  add_camera_options(command, options);
  command.add_option("--pixel-fit", options.pixel_fit, "what the frustum's sides go through [auto]")
      ->check(CLI::IsMember({"auto", "centres", "edges"}))
      ->type_name("auto|centres|edges")
      ->group("View");
  command.add_option("--subpixel-bits", options.subpixel_bits, "fractional bits of x and y, 0..8")
      ->check(CLI::Range(0, k_max_subpixel_bits))
      ->type_name("N")
      ->group("View");
  command.add_flag("--y-down", options.y_down, "count rows from the top in the numbers handed out")
      ->group("View");
}

void add_light_option(CLI::App& command, SceneOptions& options) {
  command
      .add_option("--light-intensity", options.light_intensity,
                  "of lights without a colour [sqrt: 1/sqrt(count)]")
      ->type_name("unit|sqrt|VALUE")
      ->group("Geometry");
}

void add_side_option(CLI::App& command, SceneOptions& options) {
  // A function: bound to the variable itself, CLI11 takes it for a count and sets it to 0, so "not given" is
  // lost.
  command
      .add_flag_function(
          "--two-sided,!--one-sided", [&options](std::int64_t count) { options.two_sided = count > 0; },
          "keep polygons that face away, or not [the scene's, else not]")
      ->group("Geometry");
}

void add_scene_options(CLI::App& command, SceneOptions& options) {
  command.add_flag("--triangles", options.triangles, "split polygons into triangles")->group("Geometry");
  command.add_option("--normals", options.normals, "where none are given: face, or shared = averaged [auto]")
      ->check(CLI::IsMember({"auto", "shared", "face"}))
      ->type_name("auto|shared|face")
      ->group("Geometry");
  command.add_option("--detail", options.detail, "facets of spheres and cones; 0 leaves them out [auto]")
      ->type_name("N|auto")
      ->group("Geometry");
}

RequestedResolution parse_resolution(const std::string& text) {
  std::vector<std::int64_t> numbers;
  std::string word;
  const std::string hint = "examples: --resolution 640x480, --resolution 512 512 512 128";
  const auto finish = [&] {
    const auto n = whole<std::int64_t>(word);
    if (!n) usage(fmt::format("--resolution: '{}' is not a whole number", word), hint);
    numbers.push_back(*n);
    word.clear();
  };
  for (const char c : text) {
    if (c == 'x' || c == 'X' || c == ',' || c == ' ') {
      finish();
    } else {
      word += c;
    }
  }
  finish();
  if (numbers.size() < 2 || numbers.size() > 4) {
    usage(fmt::format("--resolution: {} number{} found, expected WxH or X Y Z C", numbers.size(),
                      numbers.size() == 1 ? "" : "s"),
          hint);
  }
  const auto check = [&](const char* name, std::int64_t value, std::int64_t low, std::int64_t high) {
    if (value < low || value > high) {
      usage(fmt::format("--resolution: {} = {} is out of range, expected {}..{}", name, value, low, high),
            hint);
    }
  };
  RequestedResolution r;
  check("XRES", numbers[0], 1, k_max_resolution);
  check("YRES", numbers[1], 1, k_max_resolution);
  r.x = static_cast<int>(numbers[0]);
  r.y = static_cast<int>(numbers[1]);
  if (numbers.size() > 2) {
    check("ZRES", numbers[2], k_min_depth_resolution, k_max_depth_resolution);
    r.z = numbers[2];
  }
  if (numbers.size() > 3) {
    check("CRES", numbers[3], k_min_color_resolution, k_max_color_resolution);
    r.color = static_cast<int>(numbers[3]);
  }
  return r;
}

bool yon_is_forced_auto(const ViewOptions& options) {
  return options.yon == "auto";
}

ViewParameters view_parameters(const ViewOptions& options) {
  ViewParameters view;
  if (!options.from.empty()) view.from = vector_of(options.from);
  if (!options.at.empty()) view.at = vector_of(options.at);
  if (!options.up.empty()) view.up = vector_of(options.up);
  if (!options.background.empty())
    view.background = Rgb{options.background[0], options.background[1], options.background[2]};
  for (const auto* triple : {&options.from, &options.at, &options.up, &options.background}) {
    if (std::any_of(triple->begin(), triple->end(), [](double v) { return !std::isfinite(v); })) {
      usage("view option: a coordinate is not a finite number");
    }
  }
  if (options.angle) {
    if (!(*options.angle > 0 && *options.angle < 180)) {
      usage(fmt::format("--angle: {} is out of range, expected more than 0 and less than 180 degrees",
                        *options.angle));
    }
    view.angle = options.angle;
  }
  if (options.hither) {
    if (!(*options.hither >= 0) || std::isinf(*options.hither)) {
      usage(fmt::format("--hither: {} is out of range, expected a distance >= 0", *options.hither));
    }
    view.hither = options.hither;
  }
  if (options.yon == "inf") {
    view.yon = std::numeric_limits<double>::infinity();
  } else if (!options.yon.empty() && options.yon != "auto") {
    const auto d = finite_number(options.yon);
    if (!d || !(*d > 0)) {
      usage(fmt::format("--yon: '{}' found, expected a distance > 0, 'auto' or 'inf'", options.yon));
    }
    view.yon = d;
  }
  if (!options.fit.empty()) {
    view.fit = options.fit == "vertical"     ? Fit::vertical
               : options.fit == "horizontal" ? Fit::horizontal
               : options.fit == "smaller"    ? Fit::smaller
                                             : Fit::both;
  }
  if (!options.resolution.empty()) {
    const RequestedResolution r = parse_resolution(options.resolution);
    view.resolution = {*r.x, *r.y};
  }
  return view;
}

std::optional<int> detail_resolution(const SceneOptions& options) {
  if (options.detail == "auto") return std::nullopt;
  const auto n = whole<int>(options.detail);
  if (!n || *n < 0 || *n > k_max_detail) {
    usage(fmt::format("--detail: '{}' found, expected 'auto' or a whole number 0..{}", options.detail,
                      k_max_detail));
  }
  return n;
}

double light_intensity(const SceneOptions& options, std::size_t lights) {
  if (options.light_intensity == "unit") return 1;
  if (options.light_intensity == "sqrt") return lights == 0 ? 1 : 1 / std::sqrt(static_cast<double>(lights));
  const auto value = finite_number(options.light_intensity);
  if (!value || *value < 0) {
    usage(fmt::format("--light-intensity: '{}' found, expected 'unit', 'sqrt' or a number >= 0",
                      options.light_intensity));
  }
  return *value;
}

DrawMode draw_mode(const std::string& mode) {
  if (mode == "line") return DrawMode::line;
  if (mode == "flat") return DrawMode::flat;
  if (mode == "phong") return DrawMode::phong;
  return DrawMode::gouraud;
}

const char* name_of(DrawMode mode) {
  switch (mode) {
    case DrawMode::line:
      return "line";
    case DrawMode::flat:
      return "flat";
    case DrawMode::gouraud:
      return "gouraud";
    case DrawMode::phong:
      break;
  }
  return "phong";
}

std::vector<std::string> join_open_lists(std::vector<std::string> arguments) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    out.push_back(arguments[i]);
    const std::size_t most = arguments[i] == "--resolution" ? 4 : arguments[i] == "--tessellate" ? 1 : 0;
    if (arguments[i] == "--") {
      out.insert(out.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1, arguments.end());
      break;
    }
    std::string list;
    for (std::size_t n = 0; n < most && i + 1 < arguments.size() && is_integer(arguments[i + 1]); ++n) {
      list += (list.empty() ? "" : ",") + arguments[++i];
    }
    if (!list.empty()) out.back() += "=" + list;
  }
  return out;
}

}  // namespace farop::app
