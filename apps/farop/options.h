// SPDX-License-Identifier: GPL-3.0-or-later
// The option groups that commands share; the same word means the same everywhere.
#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/screen_polygon.h"
#include "geometry/pipeline.h"
#include "parse_sipp/parse_sipp.h"
#include "raster/internal_rasterizer.h"
#include "scene/scene.h"

namespace farop::app {

struct InputOptions {
  std::vector<std::string> files;
  std::string format;  ///< "nff", "sipp", or empty: by suffix
  bool strict = false;
  int threads = 1;                                ///< that read a file in NFF, 0: all
  std::size_t part_bytes = std::size_t{8} << 20;  ///< of a scene that is streamed
  // Of scripts:
  std::vector<std::string> defines;  ///< NAME=VALUE
  int capture = 1;                   ///< which render request counts
  ScriptLimits limits;
};

/// View parameters given as options; they override every input.
struct ViewOptions {
  std::vector<double> from, at, up, background;
  std::optional<double> angle, hither;
  std::string yon;         ///< "auto", "inf" or a distance; empty: the scene's
  std::string resolution;  ///< WxH, or X,Y,Z,C
  std::string fit;
  std::string pixel_fit = "auto";
  bool y_down = false;
  std::optional<int> subpixel_bits;
};

struct SceneOptions {
  std::optional<bool> two_sided;  ///< not given: the scene's
  bool triangles = false;
  std::string normals = "auto";
  std::string detail = "auto";
  std::string light_intensity = "sqrt";
};

struct DrawingOptions {
  std::string mode;  ///< empty, as samples: the scene's
  std::optional<int> samples;
  std::string depth_file;
};

struct ReportOptions {
  std::string stats_file;
  std::string trace_file;
  bool verbose = false;
  bool quiet = false;
  bool no_progress = false;
  std::string color = "auto";
};

void add_input_options(CLI::App& command, InputOptions& options);
void add_output_option(CLI::App& command, std::string& output, const std::string& what,
                       bool required = false);
void add_background_option(CLI::App& command, std::vector<double>& background, const std::string& group);
void add_camera_options(CLI::App& command, ViewOptions& options);
/// Adds the options about device coordinates (--pixel-fit, --subpixel-bits, --y-down) too.
void add_view_options(CLI::App& command, ViewOptions& options);
void add_scene_options(CLI::App& command, SceneOptions& options);
void add_light_option(CLI::App& command, SceneOptions& options);
void add_side_option(CLI::App& command, SceneOptions& options);

/// Parses "WxH", "X,Y", "X,Y,Z" or "X,Y,Z,C" (also separated by 'x' or blanks). Throws Error(usage) with the
/// limits.
struct RequestedResolution {
  std::optional<int> x, y;
  std::optional<std::int64_t> z;
  std::optional<int> color;
};
RequestedResolution parse_resolution(const std::string& text);

/// The members that the options give. Throws Error(usage) for impossible values.
ViewParameters view_parameters(const ViewOptions& options);
/// True when `--yon auto` asks to ignore the scene's own yon.
bool yon_is_forced_auto(const ViewOptions& options);
/// R of `--detail`: a number, or nothing for auto.
std::optional<int> detail_resolution(const SceneOptions& options);
/// Intensity of a light without a colour among `lights` lights: 1/sqrt(lights), 1, or the given number.
double light_intensity(const SceneOptions& options, std::size_t lights);
DrawMode draw_mode(const std::string& mode);
/// The word for a mode.
const char* name_of(DrawMode mode);

/// Joins the words of list-valued options whose length is open, so that an input may follow them:
/// `--resolution 512 512 512 128 a.nff` -> `--resolution=512,512,512,128 a.nff`, `--tessellate 3` ->
/// `--tessellate=3`.
std::vector<std::string> join_open_lists(std::vector<std::string> arguments);

}  // namespace farop::app
