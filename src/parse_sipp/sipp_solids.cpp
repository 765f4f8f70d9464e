// SPDX-License-Identifier: GPL-3.0-or-later
// Torus, ellipsoid, cone, prism and their relatives.
#include <algorithm>
#include <utility>
#include <vector>

#include "parse_sipp/shape_builder_internal.h"

namespace farop::sipp {
namespace {

/// A value per column of a ring.
using Columns = std::vector<V3d>;

/// count + 1 points at height z; the last one is the first again, bit for bit, so that surfaces which meet in
/// the ring and begin at different ends of it leave no gap.
Columns ring(double radius_x, double radius_y, double z, int count) {
  Columns out;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * k_pi * i / count;
    out.emplace_back(radius_x * std::cos(angle), radius_y * std::sin(angle), z);
  }
  out.push_back(V3d(out.front()));
  return out;
}

/// A fan of polygons between a ring and a point. Two-dimensional textures give the point one coordinate per
/// column, so that fans are then of quadrilaterals with two corners in one place.
/// Columns a and b of the ring come in this order; `textures` are those of the ring, `u` of its columns.
void fan_polygon(ShapeBuilder& shape, const Columns& points, const Columns& textures, int a, int b,
                 const V3d& centre, const V3d& centre_texture) {
  const auto at = [&](const Columns& values, int i) { return values[static_cast<std::size_t>(i)]; };
  const auto texture_of_centre = [&](int i) {
    return V3d(at(textures, i).x, centre_texture.y, centre_texture.z);
  };
  shape.push(at(points, a), at(textures, a));
  shape.push(at(points, b), at(textures, b));
  shape.push(centre, texture_of_centre(b));
  if (shape.two_dimensional()) shape.push(centre, texture_of_centre(a));
  shape.end_polygon();
}

/// Textures of an ellipsoid's ring. Column `count` of the spherical ones is a copy of column 0.
Columns ellipsoid_textures(const Columns& points, double polar_radius, TextureMapping mapping) {
  Columns out;
  const std::size_t count = points.size() - 1;
  for (std::size_t i = 0; i <= count; ++i) {
    const V3d& p = points[i == count ? 0 : i];
    const double v = mapping == TextureMapping::cylindrical
                         ? (polar_radius == 0 ? 0.5 : p.z / (2 * polar_radius) + 0.5)
                         : elevation(p.z, std::hypot(p.x, p.y));
    out.emplace_back(static_cast<double>(i) / static_cast<double>(count), v, 0);
  }
  return out;
}

}  // namespace

std::shared_ptr<Object> torus(double big_radius, double small_radius, int around_ring, int around_tube,
                              const ShapeLook& look) {
  if (around_ring < 1 || around_tube < 1 || !all_finite({big_radius, small_radius})) return nullptr;
  ShapeBuilder shape("torus", static_cast<double>(around_ring) * around_tube, look);
  const auto tube = static_cast<std::size_t>(around_tube);
  const double step = 2 * k_pi / around_ring;
  const double c = std::cos(step), s = std::sin(step);

  Columns old_ring, v_of_tube;  // the latter: texture v in y
  for (std::size_t i = 0; i < tube; ++i) {
    const double angle = static_cast<double>(i) * 2 * k_pi / around_tube - k_pi / 4;
    old_ring.emplace_back(big_radius + small_radius * std::cos(angle), 0, small_radius * std::sin(angle));
  }
  for (std::size_t i = 0; i <= tube; ++i) {
    const V3d& p = old_ring[i % tube];
    double v = static_cast<double>(i) / around_tube;
    if (look.texture == TextureMapping::cylindrical) {
      v = small_radius == 0 ? 0.5 : (p.z + small_radius) / (2 * small_radius);
    } else if (look.texture == TextureMapping::spherical) {
      v = elevation(p.z, p.x);
    }
    v_of_tube.emplace_back(0, v, 0);
  }
  const Columns first_ring = old_ring;
  Columns new_ring = old_ring;
  double old_angle = 0;
  for (int k = 0; k < around_ring; ++k) {
    // Step by step, as SIPP turns it. There the last ring meets the first through the merging tolerance,
    // which does not reach over a seam of textures: it is the first here, bit for bit, and the tube is
    // closed.
    const bool last = k + 1 == around_ring;
    if (last) new_ring = first_ring;
    for (std::size_t i = 0; i < tube && !last; ++i) {
      const V3d& p = old_ring[i];
      new_ring[i] = V3d(p.x * c - p.y * s, p.x * s + p.y * c, p.z);
    }
    const double new_angle = old_angle + step;
    const double u_old = old_angle / (2 * k_pi), u_new = new_angle / (2 * k_pi);
    for (std::size_t i = 0; i < tube; ++i) {
      const std::size_t j = (i + 1) % tube;
      const double vi = v_of_tube[i].y, vj = v_of_tube[i + 1].y;
      shape.polygon({{old_ring[i], V3d(u_old, vi, 0)},
                     {new_ring[i], V3d(u_new, vi, 0)},
                     {new_ring[j], V3d(u_new, vj, 0)},
                     {old_ring[j], V3d(u_old, vj, 0)}});
    }
    std::swap(old_ring, new_ring);
    old_angle = new_angle;
  }
  shape.end_surface();
  return shape.take();
}

std::shared_ptr<Object> ellipsoid(const V3d& radii, int resolution, const ShapeLook& look) {
  if (resolution < 1 || !all_finite({radii.x, radii.y, radii.z})) return nullptr;
  ShapeBuilder shape("sphere or ellipsoid", 0.5 * resolution * resolution, look);
  const int count = resolution + resolution % 2;
  const int rings = count / 2 - 1;  // between the poles
  const auto ring_at = [&](double sine, double height) {
    return ring(radii.x * sine, radii.y * sine, height, count);
  };
  const auto textures_of = [&](const Columns& points) {
    return ellipsoid_textures(points, radii.z, look.texture);
  };
  const double step = 2 * k_pi / count;
  Columns upper = ring_at(std::sin(step), radii.z * std::cos(step));
  Columns upper_texture = textures_of(upper);
  for (int i = 0; i < count; ++i) {
    fan_polygon(shape, upper, upper_texture, i, i + 1, V3d(0, 0, radii.z), V3d(0, 1, 0));
  }
  for (int j = 1; j < rings; ++j) {
    const double angle = (j + 1) * k_pi / (0.5 * count);
    Columns lower = ring_at(std::sin(angle), radii.z * std::cos(angle));
    Columns lower_texture = textures_of(lower);
    // SIPP 3.1 gives both edges of a band the v of the lower one, but for the cylindrical mapping.
    if (look.texture != TextureMapping::cylindrical) upper_texture = lower_texture;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      shape.polygon({{upper[i], upper_texture[i]},
                     {lower[i], lower_texture[i]},
                     {lower[i + 1], lower_texture[i + 1]},
                     {upper[i + 1], upper_texture[i + 1]}});
    }
    upper = std::move(lower);
    upper_texture = std::move(lower_texture);
  }
  const Columns last = ring_at(std::sin(step), -radii.z * std::cos(step));
  const Columns last_texture = textures_of(last);
  for (int i = 0; i < count; ++i) {
    fan_polygon(shape, last, last_texture, i + 1, i, V3d(0, 0, -radii.z), V3d(0, 0, 0));
  }
  shape.end_surface();
  return shape.take();
}

std::shared_ptr<Object> sphere(double radius, int resolution, const ShapeLook& look) {
  return ellipsoid(V3d(radius, radius, radius), resolution, look);
}

std::shared_ptr<Object> cone(double bottom_radius, double top_radius, double length, int resolution,
                             const ShapeLook& look) {
  if (resolution < 1 || !all_finite({bottom_radius, top_radius, length})) return nullptr;
  if (bottom_radius < 0 || top_radius < 0 || (bottom_radius == 0 && top_radius == 0)) return nullptr;
  ShapeBuilder shape("cone or cylinder", 3.0 * resolution, look);
  const double top_z = length / 2, bottom_z = -top_z;
  const Columns bottom = ring(bottom_radius, bottom_radius, bottom_z, resolution);
  const Columns top = ring(top_radius, top_radius, top_z, resolution);
  const auto textures = [&](double radius, double z, double v) {
    if (look.texture == TextureMapping::spherical) v = elevation(z, radius);
    Columns out;
    for (int i = 0; i <= resolution; ++i) out.emplace_back(static_cast<double>(i) / resolution, v, z);
    return out;
  };
  const Columns bottom_texture = textures(bottom_radius, bottom_z, 0);
  const Columns top_texture = textures(top_radius, top_z, 1);
  const V3d bottom_centre(0, 0, bottom_z), top_centre(0, 0, top_z);

  if (bottom_radius > 0) {
    for (int i = resolution; i > 0; --i) {
      fan_polygon(shape, bottom, bottom_texture, i, i - 1, bottom_centre, bottom_centre);
    }
    shape.end_surface();
  }
  if (top_radius > 0) {
    for (int i = 0; i < resolution; ++i) {
      fan_polygon(shape, top, top_texture, i, i + 1, top_centre, V3d(0, 1, top_z));
    }
    shape.end_surface();
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(resolution); ++i) {
    // An apex has the texture of the column where its triangle begins.
    if (bottom_radius == 0) {
      shape.polygon(
          {{bottom_centre, bottom_texture[i]}, {top[i + 1], top_texture[i + 1]}, {top[i], top_texture[i]}});
    } else if (top_radius == 0) {
      shape.polygon({{bottom[i], bottom_texture[i]},
                     {bottom[i + 1], bottom_texture[i + 1]},
                     {top_centre, top_texture[i]}});
    } else {
      shape.polygon({{bottom[i], bottom_texture[i]},
                     {bottom[i + 1], bottom_texture[i + 1]},
                     {top[i + 1], top_texture[i + 1]},
                     {top[i], top_texture[i]}});
    }
  }
  shape.end_surface();
  return shape.take();
}

std::shared_ptr<Object> cylinder(double radius, double length, int resolution, const ShapeLook& look) {
  return cone(radius, radius, length, resolution, look);
}

std::shared_ptr<Object> prism(std::span<const V2d> outline, double length, const ShapeLook& look) {
  const std::size_t n = outline.size();
  const bool finite = std::all_of(outline.begin(), outline.end(), [](const V2d& p) {
    return all_finite({p.x, p.y});
  });
  if (n < 3 || !finite || !all_finite({length})) return nullptr;
  ShapeBuilder shape("prism", static_cast<double>(n) + 2, look);
  const double half = length / 2;

  // Texture u and v of the upper end of each side edge; entry n closes the ring.
  std::vector<double> u(n + 1, 1.0), v(n + 1, 1.0);
  double perimeter = 0;
  std::vector<double> along;
  for (std::size_t i = 0; i < n; ++i) {
    along.push_back(perimeter);
    perimeter += (outline[(i + 1) % n] - outline[i]).length();
  }
  const double first_angle = std::atan2(outline[0].y, outline[0].x);
  for (std::size_t i = 0; i < n; ++i) {
    if (look.texture == TextureMapping::natural) {
      u[i] = perimeter > 0 ? along[i] / perimeter : 0;
      continue;
    }
    double angle = std::atan2(outline[i].y, outline[i].x) - first_angle;
    if (angle < 0) angle += 2 * k_pi;
    u[i] = angle / (2 * k_pi);
    if (look.texture == TextureMapping::spherical) v[i] = elevation(half, outline[i].length());
  }
  v[n] = v[0];

  const auto at = [&](std::size_t i, double z) { return V3d(outline[i].x, outline[i].y, z); };
  for (std::size_t i = 0; i < n; ++i) shape.push(at(i, half), V3d(0, 1, 0));
  shape.end_polygon();
  shape.end_surface();
  for (std::size_t i = n; i-- > 0;) shape.push(at(i, -half), V3d(0, 0, 0));
  shape.end_polygon();
  shape.end_surface();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    shape.polygon({{at(i, half), V3d(u[i], v[i], 0)},
                   {at(i, -half), V3d(u[i], 1 - v[i], 0)},
                   {at(j, -half), V3d(u[i + 1], 1 - v[i + 1], 0)},
                   {at(j, half), V3d(u[i + 1], v[i + 1], 0)}});
    shape.end_surface();
  }
  return shape.take();
}

std::shared_ptr<Object> block(const V3d& size, const ShapeLook& look) {
  const double x = size.x / 2, y = size.y / 2;
  const V2d outline[] = {{x, -y}, {x, y}, {-x, y}, {-x, -y}};
  return prism(outline, size.z, look);
}

std::shared_ptr<Object> cube(double size, const ShapeLook& look) {
  return block(V3d(size, size, size), look);
}

std::shared_ptr<Object> superquadric(const V3d& radii, double n, double e, double alpha,
                                     const ShapeLook& look) {
  if (!all_finite({radii.x, radii.y, radii.z, n, e, alpha})) return nullptr;
  constexpr double smallest_exponent = 0.1;
  n = std::max(n, smallest_exponent);
  e = std::max(e, smallest_exponent);
  constexpr int half_steps = 8;
  ShapeBuilder shape("superquadric", (2 * half_steps + 1) * (2 * half_steps + 1), look);
  const double u_step = k_pi / half_steps;
  const double v_step = alpha > 0 ? k_pi / half_steps : k_pi / (2 * half_steps);
  const double offset = std::max(alpha, 0.0);
  const auto power = [](double base, double exponent) { return std::pow(std::abs(base), exponent); };
  const auto sign = [](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : 0.0; };
  const auto point = [&](int iu, int iv) {
    const double u = iu * u_step, v = iv * v_step;
    const double cos_u = std::cos(u), sin_u = std::sin(u), cos_v = std::cos(v), sin_v = std::sin(v);
    const double out = offset + power(cos_v, n);
    return V3d(radii.x * out * power(cos_u, e) * sign(cos_u) * sign(cos_v),
               radii.y * out * power(sin_u, e) * sign(sin_u) * sign(cos_v),
               radii.z * power(sin_v, n) * sign(sin_v));
  };
  for (int v = -half_steps; v <= half_steps; ++v) {
    for (int u = -half_steps; u <= half_steps; ++u) {
      const auto corner = [&](int iu, int iv) {
        return ShapeBuilder::Corner{point(iu, iv),
                                    V3d((iu + half_steps) / 16.0, (iv + half_steps) / 16.0, 0)};
      };
      shape.polygon({corner(u, v), corner(u + 1, v), corner(u + 1, v + 1), corner(u, v + 1)});
    }
  }
  shape.end_surface();
  return shape.take();
}

}  // namespace farop::sipp
