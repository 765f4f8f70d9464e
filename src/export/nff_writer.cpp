// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/nff_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>
#include <type_traits>

#include "core/error.h"
#include "export/nff_lights.h"
#include "export/nff_losses.h"
#include "scene/plane.h"
#include "scene/traverse.h"

namespace farop {
namespace {

constexpr std::size_t k_buffer = std::size_t{1} << 16;

/// Where a surface's local coordinates go. The identity is left out, not multiplied: it would turn -0 into 0.
class ToWorld {
 public:
  ToWorld(const M44d& matrix, NormalRule rule) : matrix_(matrix), moves_(matrix != M44d()) {
    if (!moves_) return;
    Imath::M33d linear;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) linear[row][column] = matrix[row][column];
    }
    const double volume = linear.determinant();
    mirrors_ = volume < 0;
    // A matrix that flattens has no inverse; zero normals let readers fall back to the plane normal.
    normals_ = rule == NormalRule::sipp ? linear
               : volume == 0            ? Imath::M33d(0.0)
                                        : linear.inverse().transposed();
  }

  V3d position(const V3d& p) const { return moves_ ? p * matrix_ : p; }
  V3d normal(const V3d& n) const { return moves_ ? n * normals_ : n; }
  /// What ran counter-clockwise seen from the front runs clockwise now.
  bool mirrors() const { return mirrors_; }

 private:
  M44d matrix_;
  Imath::M33d normals_;
  bool moves_;
  bool mirrors_ = false;
};

class NffWriter {
 public:
  NffWriter(const NffWriteOptions& options, const TextFunction& write, DiagnosticSink& sink)
      : options_(options), write_(write), sink_(sink) {}

  void write(const Scene& scene) {
    const ViewParameters& view = scene.view;
    if (view.background) line("b", view.background->r, view.background->g, view.background->b);
    write_view(view);
    for (const Light& light : nff_lights(scene, losses_)) {
      const V3d& p = light.position;
      if (light.color) {
        line("l", p.x, p.y, p.z, light.color->r, light.color->g, light.color->b);
      } else {
        line("l", p.x, p.y, p.z);
      }
    }
    for_each_surface(scene, [&](const SurfacePlacement& placement) {
      write_surface(placement.surface, placement.local_to_world);
    });
    if (scene.drawing.two_sided.value_or(false))
      losses_.add("that both sides of surfaces are drawn (--two-sided)");
    if (!losses_.empty()) note("lost, because NFF cannot say it: " + losses_.text());
    if (!text_.empty()) write_(text_);
  }

 private:
  void write_view(const ViewParameters& view) {
    if (!view.from || !view.at) {
      if (view.from || view.at || view.up || view.angle || view.hither || view.yon || view.resolution) {
        note("view parameters are not written: NFF has no view without from and at");
      }
      return;
    }
    text_ += "v\n";
    line("from", view.from->x, view.from->y, view.from->z);
    line("at", view.at->x, view.at->y, view.at->z);
    if (view.up) line("up", view.up->x, view.up->y, view.up->z);
    if (view.angle) line("angle", vertical_angle(view));
    if (view.hither) line("hither", *view.hither);
    if (view.resolution) line("resolution", view.resolution->x, view.resolution->y);
    if (view.yon) note("the far plane (yon) is not written: NFF's is infinitely far");
    const bool square = !view.resolution || view.resolution->x == view.resolution->y;
    if (view.fit == Fit::both && !square) {
      note("pixels that are not square are not written: NFF readers take the angle for the vertical one");
    }
  }

  /// NFF's angle. Square pixels, the frustum's sides through the centres of the outermost ones.
  static double vertical_angle(const ViewParameters& view) {
    if (!view.resolution || !view.fit) return *view.angle;
    const auto [width, height] = *view.resolution;
    const bool horizontal = *view.fit == Fit::horizontal || (*view.fit == Fit::smaller && width < height);
    if (!horizontal || width == height || width == 1 || height == 1) return *view.angle;
    const double half = std::tan(*view.angle * (std::numbers::pi / 360));
    return std::atan(half * (height - 1) / (width - 1)) * (360 / std::numbers::pi);
  }

  void write_surface(const Surface& surface, const M44d& local_to_world) {
    if (!surface.curved.empty()) throw Error(ExitStatus::internal, "write_nff: the scene is not tessellated");
    if (surface.polygons.empty()) return;  // an `f` without objects would not come back
    const Material m = material_of(surface);
    line("f", m.color.r, m.color.g, m.color.b, m.kd, m.ks, m.shine, m.transmittance, m.refraction);
    if (m.ka != Material{}.ka && surface.shader == nullptr && !ka_noted_) {
      note(fmt::format("ambient coefficients (Ka) other than {} are not written: NFF has none",
                       Material{}.ka));
      ka_noted_ = true;
    }
    const ToWorld to_world(local_to_world, surface.normal_rule);
    for (const PolygonView polygon : surface.polygons) write_polygon(surface, polygon, to_world);
  }

  Material material_of(const Surface& surface) {
    if (surface.shader == nullptr) return surface.material;
    std::vector<std::string> lost;
    const Material material = surface.shader->approximate(&lost);
    losses_.add(lost);
    // Whether a function of a program is opaque nobody knows before it is asked.
    if (!surface.shader->opaque() && material.transmittance > 0)
      losses_.add("how opacities of surfaces behind each other add up");
    return material;
  }

  void write_polygon(const Surface& surface, const PolygonView& polygon, const ToWorld& to_world) {
    const std::vector<V3d>& normals = polygon.has_given_normals ? surface.normals : surface.averaged_normals;
    ring_.assign(polygon.corners.begin(), polygon.corners.end());
    if (to_world.mirrors())
      std::reverse(ring_.begin() + 1, ring_.end());  // the first one stays: flat shading
    if (surface.normal_rule == NormalRule::sipp && !normals.empty())
      look_for_turned(surface, normals, to_world);
    const auto write_corners = [&](const auto& which, std::size_t count) {
      line(normals.empty() ? "p" : "pp", count);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t vertex = ring_[which(i)];
        const V3d p = to_world.position(surface.positions[vertex]);
        number(p.x), numbers(p.y, p.z);
        if (!normals.empty()) {
          const V3d n = to_world.normal(normals[vertex]);
          numbers(n.x, n.y, n.z);
        }
        end_line();
      }
    };
    if (!options_.triangulate || polygon.corners.size() == 3) {
      write_corners([](std::size_t i) { return i; }, polygon.corners.size());
      return;
    }
    corners_.clear();
    for (const std::uint32_t vertex : ring_) corners_.push_back(to_world.position(surface.positions[vertex]));
    triangles_.clear();
    options_.triangulate(corners_, triangles_);
    for (const auto& triangle : triangles_) {
      write_corners([&](std::size_t i) { return triangle[i]; }, 3);
    }
  }

  /// NFF readers turn round the normals of a corner that point to the back of its polygon; SIPP uses them.
  void look_for_turned(const Surface& surface, const std::vector<V3d>& normals, const ToWorld& to_world) {
    corners_.clear();
    order_.clear();
    for (const std::uint32_t vertex : ring_) {
      order_.push_back(static_cast<std::uint32_t>(corners_.size()));
      corners_.push_back(to_world.position(surface.positions[vertex]));
    }
    const std::optional<V3d> plane = plane_normal(corners_, order_);
    if (!plane) return;
    for (const std::uint32_t vertex : ring_) {
      if (to_world.normal(normals[vertex]).dot(*plane) < 0) {
        losses_.add("vertex normals that point behind their polygon (readers turn them round)");
        return;
      }
    }
  }

  template <class... Numbers>
  void line(std::string_view keyword, Numbers... values) {
    text_ += keyword;
    numbers(values...);
    end_line();
  }

  template <class... Numbers>
  void numbers(Numbers... values) {
    ((text_ += ' ', number(values)), ...);
  }

  template <class Number>
  void number(Number value) {
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(value)) {
        throw Error(ExitStatus::input,
                    "a number of the scene is too large for NFF after its object was moved",
                    "check the transformations of the scene");
      }
    }
    char digits[32];
    const auto [end, error] = std::to_chars(std::begin(digits), std::end(digits), value);
    text_.append(digits, end);
  }

  void end_line() {
    text_ += '\n';
    if (text_.size() < k_buffer) return;
    write_(text_);
    text_.clear();
  }

  void note(std::string message) {
    Diagnostic d;
    d.severity = Severity::note;
    d.where.file = options_.name;
    d.message = std::move(message);
    sink_.report(std::move(d));
  }

  const NffWriteOptions& options_;
  const TextFunction& write_;
  DiagnosticSink& sink_;
  std::string text_;
  NffLosses losses_;
  std::vector<std::uint32_t> ring_, order_;  ///< scratch, like those that follow
  std::vector<V3d> corners_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  bool ka_noted_ = false;
};

}  // namespace

void write_nff(const Scene& scene, const NffWriteOptions& options, const TextFunction& write,
               DiagnosticSink& sink) {
  NffWriter(options, write, sink).write(scene);
}

void write_nff(const Scene& scene, const NffWriteOptions& options, OutputFile& file, DiagnosticSink& sink) {
  write_nff(
      scene, options, [&](std::string_view text) { file.write(text); }, sink);
}

}  // namespace farop
