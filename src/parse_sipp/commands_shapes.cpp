// SPDX-License-Identifier: GPL-3.0-or-later
// Primitives: each command makes an object.
#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "core/word_reader.h"
#include "parse_sipp/bezier_file.h"
#include "parse_sipp/script.h"
#include "parse_sipp/sipp_objects.h"

namespace farop::sipp {
namespace {

constexpr std::int64_t k_largest_resolution = 1'000'000'000;

int resolution(Tcl_Obj* word, std::string_view what = "the resolution") {
  return static_cast<int>(integer(word, what, 1, k_largest_resolution));
}

double length_of(Tcl_Obj* word, std::string_view what) {
  const double value = number(word, what);
  if (value <= 0) unexpected(word, what, "a number > 0");
  return value;
}

double radius_or_zero(Tcl_Obj* word, std::string_view what) {
  const double value = number(word, what);
  if (value < 0) unexpected(word, what, "a number >= 0");
  return value;
}

V3d lengths_of(Tcl_Obj* word, std::string_view what) {
  const V3d v = vector(word, what);
  if (v.x <= 0 || v.y <= 0 || v.z <= 0) unexpected(word, what, "{x y z}, each > 0");
  return v;
}

void add_index(Tcl_Obj* word, std::size_t points, std::vector<int>& indices) {
  if (points == 0) throw ScriptError("the list of vertices is empty");
  indices.push_back(static_cast<int>(
      integer(word, "an index into the vertices", 0, static_cast<std::int64_t>(points) - 1)));
}

std::vector<V3d> points_of(Tcl_Obj* word) {
  std::vector<V3d> points;
  for (Tcl_Obj* point : list(word, "the list of vertices")) points.push_back(vector(point, "a vertex"));
  return points;
}

}  // namespace

ShapeLook Script::look(Tcl_Obj* shader_word, Words rest) {
  ShapeLook look;
  look.shader = shader(shader_word);
  look.max_polygons = std::min<std::uint64_t>(polygons_left(), 0x7FFFFFFF);
  if (rest.empty() || is_empty(rest[0])) return look;
  if (is_word(rest[0], "WORLD")) {
    look.texture = TextureMapping::world;
  } else if (is_word(rest[0], "CYLINDRICAL")) {
    look.texture = TextureMapping::cylindrical;
  } else if (is_word(rest[0], "SPHERICAL")) {
    look.texture = TextureMapping::spherical;
  } else if (is_word(rest[0], "NATURAL")) {
    look.texture = TextureMapping::natural;
  } else {
    unexpected(rest[0], "the texture mapping", "NATURAL, CYLINDRICAL, SPHERICAL or WORLD");
  }
  return look;
}

ScriptError Script::too_many(const Error& error) const {
  const std::string used = polygons_made_ == 0 ? ""
                                               : fmt::format(" (of {}, {} are made already)",
                                                             options_.limits.polygons, polygons_made_);
  return ScriptError(error.what() + used, {}, "fewer polygons, or --script-polygons N");
}

Tcl_Obj* Script::new_shape(const char* noun, const std::shared_ptr<Object>& object) {
  if (object == nullptr) throw ScriptError(fmt::format("no {} of this size can be made", noun));
  count_polygons(tree_size(*object).polygons);
  return new_object(object);
}

void Script::add_shape_commands() {
  const auto shape = [this](const char* name, const char* usage, std::size_t count, const char* noun,
                            std::shared_ptr<Object> (*make)(Words, const ShapeLook&)) {
    // count: arguments in front of the shader
    add(name, usage, count + 1, count + 2, [this, count, noun, make](Words w) {
      const ShapeLook l = look(w[count], w.subspan(count + 1));
      std::shared_ptr<Object> object;
      try {
        object = make(w, l);
      } catch (const Error& error) {
        throw too_many(error);
      }
      return new_shape(noun, object);
    });
  };
  shape("SippTorus", "bigradius smallradius radialres tuberes shader ?texture?", 4, "torus",
        [](Words w, const ShapeLook& l) {
          return torus(length_of(w[0], "bigradius"), length_of(w[1], "smallradius"),
                       resolution(w[2], "radialres"), resolution(w[3], "tuberes"), l);
        });
  shape("SippSphere", "radius res shader ?texture?", 2, "sphere", [](Words w, const ShapeLook& l) {
    return sphere(length_of(w[0], "the radius"), resolution(w[1]), l);
  });
  shape("SippEllipsoid", "{rx ry rz} res shader ?texture?", 2, "ellipsoid", [](Words w, const ShapeLook& l) {
    return ellipsoid(lengths_of(w[0], "the radii"), resolution(w[1]), l);
  });
  shape("SippCone", "bottomradius topradius length res shader ?texture?", 4, "cone",
        [](Words w, const ShapeLook& l) {
          return cone(radius_or_zero(w[0], "bottomradius"), radius_or_zero(w[1], "topradius"),
                      length_of(w[2], "the length"), resolution(w[3]), l);
        });
  shape("SippCylinder", "radius length res shader ?texture?", 3, "cylinder", [](Words w, const ShapeLook& l) {
    return cylinder(length_of(w[0], "the radius"), length_of(w[1], "the length"), resolution(w[2]), l);
  });
  shape("SippPrism", "{{x y} {x y} ...} length shader ?texture?", 2, "prism",
        [](Words w, const ShapeLook& l) {
          std::vector<V2d> outline;
          for (Tcl_Obj* point : list(w[0], "the outline")) outline.push_back(vector2(point, "a point"));
          if (outline.size() < 3) unexpected(w[0], "the outline", "at least three points {x y}");
          return prism(outline, length_of(w[1], "the length"), l);
        });
  shape("SippBlock", "{sx sy sz} shader ?texture?", 1, "block",
        [](Words w, const ShapeLook& l) { return block(lengths_of(w[0], "the size"), l); });
  shape("SippCube", "size shader ?texture?", 1, "cube",
        [](Words w, const ShapeLook& l) { return cube(length_of(w[0], "the size"), l); });
  shape("SippTeapot", "res shader ?texture?", 1, "teapot",
        [](Words w, const ShapeLook& l) { return teapot(resolution(w[0]), l); });
  shape("SippTeapotBody", "res shader ?texture?", 1, "teapot body",
        [](Words w, const ShapeLook& l) { return teapot_body(resolution(w[0]), l); });
  shape("SippTeapotLid", "res shader ?texture?", 1, "teapot lid",
        [](Words w, const ShapeLook& l) { return teapot_lid(resolution(w[0]), l); });
  shape("SippTeapotSpout", "res shader ?texture?", 1, "teapot spout",
        [](Words w, const ShapeLook& l) { return teapot_spout(resolution(w[0]), l); });
  shape("SippTeapotHandle", "res shader ?texture?", 1, "teapot handle",
        [](Words w, const ShapeLook& l) { return teapot_handle(resolution(w[0]), l); });
  shape("SippSuperquadric", "{a1 a2 a3} n e alpha shader ?texture?", 4, "superquadric",
        [](Words w, const ShapeLook& l) {
          return superquadric(lengths_of(w[0], "the radii"), number(w[1], "exponent n"),
                              number(w[2], "exponent e"), number(w[3], "alpha"), l);
        });
  for (const char* part : {"", "BackFender", "Back", "BackSide", "FrontDoor", "FrontFender", "FrontSide",
                           "Hood", "FrontPanel", "RunningBoard"}) {
    add((std::string("SippVW") + part).c_str(), "?side? shader", 0, 1000, [](Words) -> Tcl_Obj* {
      throw ScriptError("there is no data of the Volkswagen", {}, "model another car");
    });
  }
}

void Script::add_bezier_commands() {
  const auto make = [this](const BezierDescription& description, int res, const ShapeLook& l) {
    try {
      return new_shape("surface", bezier(description, res, l));
    } catch (const Error& error) {
      throw too_many(error);
    }
  };
  add("SippBezierPatch", "res vertexlist patchlist shader ?texture?", 4, 5, [this, make](Words w) {
    BezierDescription d;
    d.points = points_of(w[1]);
    for (Tcl_Obj* patch : list(w[2], "the list of patches")) {
      const std::vector<Tcl_Obj*> rows = list(patch, "a patch");
      if (rows.size() != 4 && rows.size() != 16) unexpected(patch, "a patch", "4 rows of 4 indices");
      for (Tcl_Obj* row : rows) {
        if (rows.size() == 16) {
          add_index(row, d.points.size(), d.indices);
          continue;
        }
        for (Tcl_Obj* index : list_of(row, "a row of a patch", 4, "4 indices"))
          add_index(index, d.points.size(), d.indices);
      }
    }
    return make(d, resolution(w[0]), look(w[3], w.subspan(4)));
  });
  add("SippBezierCurve", "res vertexlist curvelist shader ?texture?", 4, 5, [this, make](Words w) {
    BezierDescription d;
    d.curves = true;
    d.points = points_of(w[1]);
    for (Tcl_Obj* curve : list(w[2], "the list of curves")) {
      for (Tcl_Obj* index : list_of(curve, "a curve", 4, "4 indices"))
        add_index(index, d.points.size(), d.indices);
    }
    return make(d, resolution(w[0]), look(w[3], w.subspan(4)));
  });
  add("SippBezierFile", "file res shader ?texture?", 3, 4, [this, make](Words w) {
    const std::string name(text_of(w[0]));
    WordReader reader(interpreter_.files().resolve(name));
    DiagnosticList problems;
    const auto description = read_bezier_file(reader, problems);
    if (!description) {
      const Diagnostic& d = problems.items.back();
      throw ScriptError(fmt::format("{}:{}:{}: {}", name, d.where.line, d.where.column, d.message), name,
                        d.hint.empty() ? "see the format of Bezier files" : d.hint);
    }
    return make(*description, resolution(w[1]), look(w[2], w.subspan(3)));
  });
}

}  // namespace farop::sipp
