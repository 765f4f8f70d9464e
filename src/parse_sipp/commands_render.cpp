// SPDX-License-Identifier: GPL-3.0-or-later
// Render requests, their targets, and what concerns the whole scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/limits.h"
#include "parse_sipp/script.h"
#include "scene/traverse.h"

namespace farop::sipp {
namespace {

/// hither = distance to the point looked at / this, yon = that distance times this.
constexpr double k_depth_factor = 100;

bool is_flag(Tcl_Obj* word) {
  const std::string_view text = text_of(word);
  return text.size() > 1 && text[0] == '-' && std::isalpha(static_cast<unsigned char>(text[1])) != 0;
}

}  // namespace

void Script::capture(const ViewParameters::Size& size, const DrawingParameters& drawing, bool sized) {
  check_tree();
  const ScriptCamera& camera = cameras_.all().at(camera_in_use_);
  const double distance = (camera.at - camera.position).length();
  if (distance == 0 || !std::isfinite(distance * k_depth_factor)) {
    throw ScriptError(
        fmt::format("{} looks from {} {} {} at {} {} {}, expected two places in reach of each other",
                    camera_in_use_, camera.position.x, camera.position.y, camera.position.z, camera.at.x,
                    camera.at.y, camera.at.z),
        {}, "set its position and point with SippCameraParams");
  }
  Scene scene;
  scene.root.children.push_back(world_);
  for (auto name = light_order_.rbegin(); name != light_order_.rend(); ++name) {
    Light light = lights_.all().at(*name);
    light.casts_shadows = light.casts_shadows && shadows_;
    light.shadow_size = shadow_size_;
    scene.lights.push_back(light);
  }
  ViewParameters& view = scene.view;
  view.from = camera.position;
  view.at = camera.at;
  view.up = camera.up;
  view.angle = 2 * std::atan(camera.focal) * (180 / std::numbers::pi);
  view.fit = Fit::smaller;
  view.hither = distance / k_depth_factor;
  view.yon = distance * k_depth_factor;
  view.fit_depth = true;
  if (sized) view.resolution = size;
  view.background = background_;
  scene.drawing = drawing;
  scene.drawing.two_sided = backfaces_;
  const SceneTotals sums = totals(scene);
  InputSummary summary;
  summary.format = "sipp";
  summary.surfaces = sums.surfaces;
  summary.polygons = sums.polygons;
  summary.lights = scene.lights.size();
  scene.inputs.push_back(std::move(summary));
  scene_ = std::move(scene);
}

void Script::finish() {
  if (scene_) return;
  if (renderings_ > 0) {
    throw ScriptError(fmt::format("the script asks for {} rendering{}, expected at least {}", renderings_,
                                  renderings_ == 1 ? "" : "s", options_.capture),
                      {}, "--capture N says which one is wanted");
  }
  capture({}, {}, false);
  Diagnostic note;
  note.severity = Severity::note;
  note.message = "the script asks for no rendering: its scene is taken as it is at the end";
  note.hint = "SippRender says when, and how large the picture is";
  remarks_.push_back(std::move(note));
}

Tcl_Obj* Script::render(Words words) {
  bool field = false;
  while (!words.empty() && is_flag(words[0])) {
    if (is_word(words[0], "-odd") || is_word(words[0], "-even")) {
      field = true;
    } else if (is_word(words[0], "-both")) {
      field = false;
    } else if (is_word(words[0], "-update") && words.size() > 1) {
      integer(words[1], "-update", 0, 1'000'000'000'000);
      words = words.subspan(1);
    } else if (!is_word(words[0], "-clear") && !is_word(words[0], "-noclear")) {
      unexpected(words[0], "a flag", "-odd, -even, -both, -update n, -clear or -noclear");
    }
    words = words.subspan(1);
  }
  if (words.size() < 3 || words.size() > 5) {
    throw ScriptError(fmt::format("{} argument{} found behind the flags, expected 3 to 5", words.size(),
                                  words.size() == 1 ? "" : "s"));
  }
  const std::vector<Tcl_Obj*> outputs = list(words[0], "the list of outputs");
  std::vector<Output*> targets;
  targets.reserve(outputs.size());
  for (Tcl_Obj* word : outputs) {
    targets.push_back(pixmaps_.contains(word)     ? &pixmaps_.at(word)
                      : rle_files_.contains(word) ? &rle_files_.at(word)
                                                  : &pbm_files_.at(word));
  }
  ViewParameters::Size size;
  size.x = static_cast<int>(integer(words[1], "xsize", 1, k_max_resolution));
  size.y = static_cast<int>(integer(words[2], "ysize", 1, k_max_resolution));
  DrawingParameters drawing;
  drawing.mode = DrawMode::phong;
  if (words.size() > 3 && !is_empty(words[3])) {
    if (is_word(words[3], "GOURAUD")) {
      drawing.mode = DrawMode::gouraud;
    } else if (is_word(words[3], "FLAT")) {
      drawing.mode = DrawMode::flat;
    } else if (is_word(words[3], "LINE")) {
      drawing.mode = DrawMode::line;
    } else if (!is_word(words[3], "PHONG")) {
      unexpected(words[3], "the mode", "PHONG, GOURAUD, FLAT or LINE");
    }
  }
  const bool line = drawing.mode == DrawMode::line;
  drawing.samples = 1;
  if (words.size() > 4 && !is_empty(words[4])) {
    const auto samples = static_cast<int>(integer(words[4], "oversample", 1, k_max_samples));
    if (!line) drawing.samples = samples;
  }
  if (field && line) throw ScriptError("-odd and -even do not go with LINE");
  for (Output* target : targets) target->width = size.x, target->height = size.y;
  if (++renderings_ < options_.capture) return nullptr;
  if (field) remark(Severity::warning, "SippRender: fields are not drawn, the whole picture is", "");
  capture(size, drawing, true);
  interpreter_.stop();
  return nullptr;
}

void Script::add_render_commands() {
  add("SippRender",
      "?-odd|-even|-both? ?-update n? ?-clear|-noclear? outputlist xsize ysize ?mode? ?oversample?", 3, 12,
      [this](Words w) { return render(w); });
}

void Script::add_output_commands() {
  const auto close = [](Handles<Output>& handles, Tcl_Obj* word) {
    if (is_word(word, "ALL")) {
      handles.all().clear();
      return;
    }
    for (Tcl_Obj* handle : list(word, "a list of handles")) handles.take(handle);
  };
  // No file is ever opened: where the picture goes is the command line's to say.
  add("SippPBMOpen", "?-plain|-raw? filename access", 2, 3, [this](Words w) {
    if (w.size() == 3) {
      if (!is_word(w[0], "-plain") && !is_word(w[0], "-raw")) unexpected(w[0], "a flag", "-plain or -raw");
      w = w.subspan(1);
    }
    const std::string_view name = text_of(w[0]), access = text_of(w[1]);
    if (name.empty() || name.starts_with('|')) unexpected(w[0], "the file name", "a name, no pipeline");
    if (access != "w" && access != "a" && access != "w+" && access != "a+" && access != "r+" &&
        access != "r") {
      unexpected(w[1], "the access", "w or a");
    }
    return new_text(pbm_files_.add({}));
  });
  add("SippPBMClose", "handlelist|ALL", 1, 1, [this, close](Words w) -> Tcl_Obj* {
    close(pbm_files_, w[0]);
    return nullptr;
  });
  add("SippRLEOpen", "filename ?access?", 1, 2, [this](Words w) {
    if (text_of(w[0]).starts_with('|')) unexpected(w[0], "the file name", "a name, no pipeline");
    return new_text(rle_files_.add({}));
  });
  add("SippRLEClose", "handlelist|ALL", 1, 1, [this, close](Words w) -> Tcl_Obj* {
    close(rle_files_, w[0]);
    return nullptr;
  });
  add("SippRLEInfo", "handle XSIZE|YSIZE|EOF", 2, 2, [this](Words w) {
    const Output& o = rle_files_.at(w[0]);
    return Tcl_NewWideIntObj(is_word(w[1], "XSIZE") ? o.width : is_word(w[1], "YSIZE") ? o.height : 0);
  });
  add("SippPixMapCreate", "?xsize ysize?", 0, 2, [this](Words) { return new_text(pixmaps_.add({true})); });
  add("SippPixMapUnref", "handlelist|ALL", 1, 1, [this, close](Words w) -> Tcl_Obj* {
    close(pixmaps_, w[0]);
    return nullptr;
  });
  add("SippPixMapInfo", "pixmap XSIZE|YSIZE", 2, 2, [this](Words w) {
    const Output& o = pixmaps_.at(w[0]);
    if (!is_word(w[1], "XSIZE") && !is_word(w[1], "YSIZE")) unexpected(w[1], "a keyword", "XSIZE or YSIZE");
    return Tcl_NewWideIntObj(is_word(w[1], "XSIZE") ? o.width : o.height);
  });
  for (const auto& [name, usage, fewest] : {std::tuple{"SippCommentPut", "handle name ?text?", 2u},
                                            std::tuple{"SippCommentGet", "handle ?name?", 1u},
                                            std::tuple{"SippCommentDelete", "handle ?name?", 1u},
                                            std::tuple{"SippCopy", "?-clear|-noclear? input output", 2u}}) {
    add(name, usage, fewest, 3, [](Words) { return nullptr; });
  }
}

void Script::add_control_commands() {
  add("SippBackground", "?color?", 0, 1, [this](Words w) -> Tcl_Obj* {
    if (w.empty()) return new_color(background_);
    background_ = color(w[0], "the colour");
    return nullptr;
  });
  add("SippShowBackFaces", "?flag?", 0, 1, [this](Words w) -> Tcl_Obj* {
    if (w.empty()) return Tcl_NewIntObj(backfaces_ ? 1 : 0);
    backfaces_ = boolean(w[0], "the flag");
    return nullptr;
  });
  add("SippInfo", "VERSION|SIPPVERSION|TSIPPVERSION|TSIPPPATCHLEVEL|RLE|RENDERING|TK", 1, 1, [](Words w) {
    for (const char* version : {"VERSION", "SIPPVERSION", "TSIPPVERSION"}) {
      if (is_word(w[0], version)) return new_text("3.1");
    }
    for (const char* zero : {"TSIPPPATCHLEVEL", "RLE", "RENDERING", "TK"}) {
      if (is_word(w[0], zero)) return Tcl_NewIntObj(0);
    }
    unexpected(w[0], "a keyword",
               "VERSION, SIPPVERSION, TSIPPVERSION, TSIPPPATCHLEVEL, RLE, RENDERING or TK");
  });
  add("SippAbortRender", "", 0, 0, [](Words) { return nullptr; });
  add("SippReset", "", 0, 0, [this](Words) -> Tcl_Obj* {
    reset();
    return nullptr;
  });
  add("SippColor", "...", 0, 1000, [](Words) -> Tcl_Obj* {
    throw ScriptError("colours of Tk are not known", {}, "write the colour as {red green blue}, 0..1");
  });
}

}  // namespace farop::sipp
