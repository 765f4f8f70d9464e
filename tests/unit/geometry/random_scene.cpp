// SPDX-License-Identifier: GPL-3.0-or-later
#include "random_scene.h"

#include <cmath>
#include <numbers>
#include <random>

#include "scene/plane.h"
#include "scene/surface_builder.h"
#include "shading/procedural_shaders.h"

namespace farop::test {
namespace {

/// Minds in which order it is called, and writes it down.
class Diary : public Shader {
 public:
  explicit Diary(std::shared_ptr<std::vector<V3d>> pages) : pages_(std::move(pages)) {}
  Shaded shade(const ShadingPoint& point, const ShadingFrame&) const override {
    pages_->push_back(point.position);
    const double turn = static_cast<double>(pages_->size() % 7) / 7;
    return {{turn, std::abs(point.normal.x), std::abs(point.texture.y)}, {turn, 1, 0.5}};
  }
  bool opaque() const override { return false; }
  bool wants_texture() const override { return true; }
  Material approximate(std::vector<std::string>*) const override { return {}; }
  std::string describe() const override { return "diary"; }

 private:
  std::shared_ptr<std::vector<V3d>> pages_;
};

class Stripes : public LightShadow {
 public:
  double unshadowed(const V3d& p) const override { return std::max(0.0, std::sin(3 * p.x + p.y)); }
};

class Maker {
 public:
  explicit Maker(std::uint32_t number) : random_(number) {}

  RandomScene scene() {
    RandomScene s;
    s.shaded = std::make_shared<std::vector<V3d>>();
    set_view(s);
    for (int i = below(3); i >= 0; --i) s.scene.root.children.push_back(object(s));
    for (int i = below(5); i > 0; --i) s.scene.lights.push_back(light());
    s.shadows = chance(0.3);
    s.options.two_sided = chance(0.3);
    s.options.triangles = chance(0.2);
    s.options.flat = chance(0.2);
    s.options.unlit = chance(0.05);
    s.options.light_intensity = u(0.2, 1);
    s.wants.triangles = chance(0.2);
    s.wants.normals = chance(0.4), s.wants.eye_positions = chance(0.4), s.wants.vertex_ids = chance(0.4);
    s.wants.textures = chance(0.4), s.wants.opacities = chance(0.4);
    return s;
  }

 private:
  double u(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  bool chance(double p) { return u(0, 1) < p; }
  V3d point(double size) { return {u(-size, size), u(-size, size), u(-size, size)}; }
  Rgb color() { return {u(0, 1), u(0, 1), u(0, 1)}; }

  void set_view(RandomScene& s) {
    s.camera.from = point(1) + V3d(0, 0, chance(0.4) ? 1.0 : 6.0);
    s.camera.at = point(0.5);
    s.camera.up = V3d(0.1, 1, 0.05);
    s.camera.angle_degrees = u(20, 120);
    s.camera.hither = chance(0.5) ? u(0.1, 2) : u(3, 6);
    if (chance(0.5)) s.camera.yon = s.camera.hither + u(0.5, 8);
    if (chance(0.1)) s.camera.yon = std::numeric_limits<double>::infinity();
    s.viewport.resolution = {1 + below(2000), 1 + below(2000), std::int64_t{1} << (8 + below(23)),
                             2 + below(65535)};
    s.viewport.y_down = chance(0.3);
    if (chance(0.5)) s.viewport.pixel_fit = PixelFit::edges;
    if (chance(0.5)) s.viewport.subpixel_bits = below(9);
    s.viewport.half_pixel_border =
        s.viewport.pixel_fit == PixelFit::edges && s.viewport.subpixel_bits > 0 && chance(0.7);
  }

  Light light() {
    Light light;
    constexpr LightKind kinds[] = {LightKind::point, LightKind::point, LightKind::directional,
                                   LightKind::spot_sharp, LightKind::spot_soft};
    light.kind = kinds[below(5)];
    light.position = point(8);
    if (chance(0.2)) light.position = V3d(0.5, 0.5, 0.5);  // where vertices are, too
    if (light.kind == LightKind::directional) light.position.normalize();
    light.target = point(1);
    light.opening_degrees = u(5, 120);
    if (chance(0.5)) light.color = color() * u(0.3, 2);
    light.active = !chance(0.1);
    return light;
  }

  std::shared_ptr<Object> object(const RandomScene& s) {
    auto made = std::make_shared<Object>();
    for (int i = below(4); i >= 0; --i) made->surfaces.push_back(surface(s));
    switch (below(7)) {
      case 0:
      case 1:
        break;
      case 2:
        made->to_parent.rotate(point(3));
        made->to_parent.translate(point(1));
        break;
      case 3:
        made->to_parent.scale(V3d(u(0.5, 2), u(0.5, 2), u(0.5, 2)));
        break;
      case 4:
        made->to_parent.scale(V3d(-1, u(0.5, 2), 1));
        made->to_parent.rotate(point(3));
        break;
      case 5:
        if (chance(0.3)) made->to_parent.scale(V3d(1, 0, 1));  // leaves no volume
        break;
      default:
        if (chance(0.3)) made->to_parent[0][3] = 0.01;  // not affine
    }
    if (chance(0.3)) made->children.push_back(made->children.empty() ? leaf(s) : made->children.front());
    return made;
  }

  std::shared_ptr<Object> leaf(const RandomScene& s) {
    auto made = std::make_shared<Object>();
    made->surfaces.push_back(surface(s));
    made->to_parent.rotate(point(3));
    return made;
  }

  std::shared_ptr<Surface> surface(const RandomScene& s) {
    const int kind = below(4);  // normals: none, some given, all given, averaged
    SurfaceBuilder builder;
    const bool grid = chance(0.5);
    if (grid) add_grid(builder, kind);
    for (int i = grid ? below(20) : below(chance(0.1) ? 1500 : 60); i > 0; --i)
      add_polygon(builder, kind == 2 || (kind == 1 && chance(0.5)));
    auto made = std::make_shared<Surface>(builder.take());
    if (kind == 3 || chance(0.1)) average_normals(*made);
    if (kind == 3 && chance(0.3) && !made->averaged_normals.empty()) {
      for (V3d& n : made->averaged_normals) {
        if (chance(0.1)) n = V3d(0, 0, 0);
      }
    }
    made->normal_rule = chance(0.5) ? NormalRule::nff : NormalRule::sipp;
    made->material = material();
    if (chance(0.4)) made->shader = shader(s);
    if (made->shader || chance(0.2)) {
      for (std::size_t i = 0; i < made->positions.size(); ++i) made->textures.emplace_back(point(2));
    }
    return made;
  }

  /// A wavy sheet, whose vertices are shared.
  void add_grid(SurfaceBuilder& builder, int kind) {
    const int size = 3 + below(30);
    const V3d shift = point(1);
    const double bend = u(-2, 2);
    const auto at = [&](int i, int j) {
      const double x = 4.0 * i / size - 2, y = 4.0 * j / size - 2;
      return V3d(x, y, bend * std::sin(x) * y) + shift;
    };
    const auto normal = [&](int i, int j) { return V3d(std::sin(i), std::cos(j), 1.5); };
    const bool triangles = chance(0.5);
    for (int i = 0; i < size; ++i) {
      for (int j = 0; j < size; ++j) {
        const int ring[4][2] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}};
        for (int half = 0; half < (triangles ? 2 : 1); ++half) {
          builder.begin_polygon(kind == 2);
          for (int k = 0; k < 4; ++k) {
            if (triangles && k == (half == 0 ? 3 : 1)) continue;
            const V3d p = at(ring[k][0], ring[k][1]);
            if (kind == 2) {
              builder.add_corner(p, normal(ring[k][0], ring[k][1]));
            } else {
              builder.add_corner(p);
            }
          }
          builder.end_polygon();
        }
      }
    }
  }

  void add_polygon(SurfaceBuilder& builder, bool given) {
    // A star in a plane through a random point.
    const V3d center = point(2.5), a = point(1), b = point(1);
    const int shape = below(40);
    const int corners = shape == 0 ? 20 + below(60) : shape == 1 && chance(0.1) ? 600 : 3 + below(6);
    std::vector<V3d> ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners, r = chance(0.2) ? 0.4 : 1.0;
      ring.push_back(center + a * (r * std::cos(angle)) + b * (r * std::sin(angle)));
    }
    switch (below(30)) {
      case 0:
        ring.assign(ring.size(), ring.front());
        break;
      case 1:
        for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = center + a * static_cast<double>(i);
        break;
      case 2:
        for (V3d& p : ring) p *= 1e-3;
        break;
      case 3:
        for (V3d& p : ring) p = p * 0.3 + V3d(0.5, 0.5, 0.5);
        ring.front() = V3d(0.5, 0.5, 0.5);
        break;
      case 4:
        ring[1] = ring[0];
        break;
      default:
        break;
    }
    builder.begin_polygon(given);
    for (const V3d& p : ring) {
      if (!given) {
        builder.add_corner(p);
        continue;
      }
      V3d n = chance(0.7) ? a.cross(b) + point(0.3) : point(1);
      if (chance(0.05)) n = V3d(0, 0, 0);
      if (chance(0.05)) n *= 1e-170;
      builder.add_corner(p, n);
    }
    builder.end_polygon();
  }

  Material material() {
    Material m;
    m.color = color();
    m.kd = u(0, 1);
    m.ks = chance(0.5) ? 0 : u(0, 1);
    m.shine = chance(0.1) ? 0 : chance(0.2) ? std::exp(u(0, 8)) : 1 + below(50);
    m.transmittance = chance(0.3) ? u(0, 1) : 0;
    return m;
  }

  std::shared_ptr<const Shader> shader(const RandomScene& s) {
    const BasicParameters basic{u(0, 1), u(0, 1), u(0, 1), color(), color()};
    switch (below(5)) {
      case 0:
        return std::make_shared<BasicShader>(basic);
      case 1:
        return std::make_shared<PhongShader>(
            PhongParameters{u(0, 1), u(0, 1), u(0, 1), below(40), color(), color()});
      case 2:
        return std::make_shared<StraussShader>(
            StraussParameters{u(0, 1), u(0, 1), u(0, 1), color(), color()});
      case 3:
        return std::make_shared<BumpyShader>(
            std::make_shared<MarbleShader>(PatternFinish{0.3, 0.4, 0.5, color()},
                                           MarblePattern{2, color(), color()}),
            BumpParameters{3, true, false});
      default:
        return std::make_shared<Diary>(s.shaded);
    }
  }

  std::mt19937 random_;
};

}  // namespace

RandomScene random_scene(std::uint32_t number) {
  return Maker(number).scene();
}

GeometrySetup prepare(const RandomScene& s) {
  GeometrySetup setup = prepare_geometry(s.scene, s.camera, s.viewport, s.options);
  if (!s.shadows) return setup;
  for (std::size_t i = 0; i < setup.shading.lights.size(); i += 2)
    setup.shading.lights[i].shadow = std::make_shared<Stripes>();
  return setup;
}

}  // namespace farop::test
