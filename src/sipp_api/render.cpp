// SPDX-License-Identifier: GPL-3.0-or-later
// The render calls: a snapshot of the world, through our stages, to a file or a function of the program.
#include <algorithm>
#include <cstdio>

#include "capture_internal.h"
#include "core/limits.h"
#include "geometry/pipeline.h"
#include "library_internal.h"
#include "raster/internal_rasterizer.h"
#include "shadow/shadow_map.h"
#include "sipp_bitmap.h"
#include "snapshot_internal.h"

namespace farop::sipp_api {
namespace {

using PixelFunction = void (*)(void*, int, int, int, int, int);
using LineFunction = void (*)(void*, int, int, int, int);

/// While something is rendered; render calls inside of one are refused.
class RenderingScope {
 public:
  RenderingScope() {
    State& s = state();
    if (s.rendering) throw Error(ExitStatus::input, "a render call while another one is under way");
    s.rendering = true;
    s.terminated = false;
    s.work = 0;
  }
  ~RenderingScope() {
    State& s = state();
    s.rendering = false;
    s.world_lights.clear();
    s.frame_lights = nullptr;
  }
  RenderingScope(const RenderingScope&) = delete;
  RenderingScope& operator=(const RenderingScope&) = delete;
};

void check(const RenderRequest& r) {
  const auto refuse = [](const std::string& what, std::string hint) {
    throw Error(ExitStatus::input, what, std::move(hint));
  };
  if (r.width < 1 || r.height < 1 || r.width > k_max_resolution || r.height > k_max_resolution) {
    refuse(fmt::format("an image of {} x {} pixels", r.width, r.height),
           fmt::format("sizes are 1 to {}", k_max_resolution));
  }
  if (r.mode < PHONG || r.mode > LINE) {
    refuse(fmt::format("unknown mode {}", r.mode), "PHONG, GOURAUD, FLAT or LINE");
  }
  if (r.mode == LINE && r.field != BOTH) refuse("fields in LINE mode", "render the whole image");
  if (r.mode != LINE && (r.oversampling < 1 || r.oversampling > k_max_samples)) {
    refuse(fmt::format("oversampling {}", r.oversampling), fmt::format("it is 1 to {}", k_max_samples));
  }
  if (r.field != EVEN && r.field != ODD && r.field != BOTH) {
    refuse(fmt::format("unknown field {}", r.field), "EVEN, ODD or BOTH");
  }
}

DrawMode draw_mode(int mode) {
  return mode == PHONG ? DrawMode::phong : mode == FLAT ? DrawMode::flat : DrawMode::gouraud;
}

/// Depth maps of all spots that cast shadows, kept with the lights.
void make_shadow_maps(const Scene& scene, int size) {
  std::shared_ptr<const ShadowJitter> jitter;
  std::size_t i = 0;
  const auto maps = std::count_if(scene.lights.begin(), scene.lights.end(), casts_shadows);
  const double side = std::min(size, k_max_shadow_size);
  if (static_cast<double>(maps) * side * side > static_cast<double>(k_max_shadow_texels)) {
    throw Error(ExitStatus::input, fmt::format("{} shadow maps of {} x {} texels", maps, size, size),
                "give sipp_shadows a smaller size");
  }
  for (const Lightsource* light = state().lights; light != nullptr; light = light->next) {
    farop::Light seen = scene.lights[i++];
    seen.shadow_size = size;
    if (!casts_shadows(seen)) continue;
    if (!jitter) jitter = std::make_shared<const ShadowJitter>(next_random);
    info_of(*light).shadow = std::make_shared<const ShadowMap>(scene, seen, jitter);
  }
}

void drop_shadow_maps() {
  for (const Lightsource* light = state().lights; light != nullptr; light = light->next) {
    info_of(*light).shadow.reset();
  }
}

/// Hands the lights' maps to the frame, whose lights are in eye space.
void attach_shadows(ShadingFrame& shading) {
  std::size_t source = 0;
  for (const Lightsource* light = state().lights; light != nullptr; light = light->next) {
    if (light->active == 0) continue;
    LightSource& seen = shading.lights[source++];
    if (const auto& map = info_of(*light).shadow) {
      seen.shadow = std::make_shared<const MovedShadow>(map, shading.eye_to_world);
    }
  }
}

bool any_procedural(const farop::Object& object) {
  return std::any_of(object.surfaces.begin(), object.surfaces.end(),
                     [](const auto& s) { return s->shader && s->shader->is_procedural(); }) ||
         std::any_of(object.children.begin(), object.children.end(),
                     [](const auto& child) { return any_procedural(*child); });
}

/// Lights, shadows and noise of a frame, in the order in which SIPP draws random numbers.
void prepare_shading(const Scene& scene, ShadingFrame& shading) {
  State& s = state();
  if (!s.lasting_shadows) {
    drop_shadow_maps();
    if (s.shadows) make_shadow_maps(scene, s.shadow_size);
  }
  attach_shadows(shading);
  const std::span<const LightSource> lights = world_lights(s.lights);
  const std::vector<LightSource> copy(lights.begin(), lights.end());
  s.world_lights = copy;
  s.frame_lights = s.lights;
  if (s.noise || any_procedural(*scene.root.children.front())) shading.noise = noise_table();
}

Framebuffer draw(const RenderRequest& r) {
  const Scene scene = snapshot({true, state().update != nullptr, false});
  Viewport viewport;
  viewport.resolution.x = r.width * r.oversampling;
  viewport.resolution.y = r.height * r.oversampling;
  // What `farop render` takes for its own rasterizer: the pictures are the same.
  viewport.resolution.z = std::int64_t{1} << 24;
  viewport.pixel_fit = PixelFit::edges;
  viewport.subpixel_bits = 8;
  viewport.half_pixel_border = true;
  GeometryOptions geometry;
  geometry.two_sided = state().show_backfaces;
  geometry.flat = r.mode == FLAT;
  geometry.unlit = r.mode == PHONG;
  geometry.light_at_eye = false;
  GeometrySetup setup = prepare_geometry(scene, camera_of(scene.view), viewport, geometry);
  prepare_shading(scene, setup.shading);

  InternalRasterizerOptions drawing;
  drawing.mode = draw_mode(r.mode);
  drawing.samples = r.oversampling;
  drawing.background = state().background;
  drawing.additive_transparency = true;
  drawing.shading = setup.shading;
  InternalRasterizer rasterizer(std::move(drawing));
  GeometryClocks clocks;
  run_geometry(scene, setup, geometry, rasterizer, clocks);
  return rasterizer.take();
}

/// Rows of the picture that belong to the request's field, in the order asked for; counted from the top.
std::vector<int> rows_of(const RenderRequest& r) {
  std::vector<int> rows;
  for (int y = 0; y < r.height; ++y) {
    if (r.field == BOTH || y % 2 == r.field) rows.push_back(y);
  }
  if (state().bottom_to_top) std::reverse(rows.begin(), rows.end());
  return rows;
}

void write_header(const RenderRequest& r, const char* magic, std::size_t rows) {
  std::fprintf(r.file, "%s\n# FAROP, SIPP %s\n", magic, SIPP_VERSION);
  if (r.field != BOTH) std::fprintf(r.file, "# %s field\n", r.field == EVEN ? "even" : "odd");
  std::fprintf(r.file, "%d\n%zu\n", r.width, rows);
}

void check_written(std::FILE* file) {
  if (std::fflush(file) != 0 || std::ferror(file) != 0) {
    throw Error(ExitStatus::surroundings, "the image cannot be written");
  }
}

void deliver(const RenderRequest& r, const Framebuffer& picture) {
  const std::vector<int> rows = rows_of(r);
  if (r.file != nullptr) {
    write_header(r, "P6", rows.size());
    std::fputs("255\n", r.file);
  }
  for (const int y : rows) {
    const std::uint8_t* const row = picture.rgb.data() + 3 * picture.pixel(0, r.height - 1 - y);
    if (r.file != nullptr) {
      std::fwrite(row, 3, static_cast<std::size_t>(r.width), r.file);
      check_written(r.file);
    } else {
      for (int x = 0; x < r.width; ++x) {
        const std::uint8_t* const p = row + 3 * x;
        reinterpret_cast<PixelFunction>(r.func)(r.data, x, y, p[0], p[1], p[2]);
        if (state().terminated) return;
      }
    }
    for (int x = 0; x < r.width; ++x) {
      if (worked()) return;
    }
  }
}

/// LINE mode: every edge of every polygon that is left, the end higher up first. Rows count from the top.
class LineSink : public ScreenPolygonSink {
 public:
  LineSink(LineFunction function, void* data) : function_(function), data_(data) {}
  void begin_frame(const ScreenFrame&) override {}
  void polygons(const ScreenPolygonBatch& batch) override {
    for (const ScreenPolygonRecord& record : batch.polygons) {
      const std::span<const ScreenVertex> corners = batch.corners(record);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const ScreenVertex* a = &corners[i];
        const ScreenVertex* b = &corners[(i + 1) % corners.size()];
        if (a->y > b->y) std::swap(a, b);
        function_(data_, a->x, a->y, b->x, b->y);
        if (worked()) throw Terminated{};
      }
    }
  }
  void end_frame() override {}

 private:
  LineFunction function_;
  void* data_;
};

void draw_lines(const RenderRequest& r, LineFunction function, void* data) {
  const Scene scene = snapshot({false, false, false});
  Viewport viewport;
  viewport.resolution.x = r.width;
  viewport.resolution.y = r.height;
  viewport.y_down = true;
  GeometryOptions geometry;
  geometry.two_sided = state().show_backfaces;
  geometry.unlit = true;
  geometry.light_at_eye = false;
  const GeometrySetup setup = prepare_geometry(scene, camera_of(scene.view), viewport, geometry);
  LineSink sink(function, data);
  GeometryClocks clocks;
  run_geometry(scene, setup, geometry, sink, clocks);
}

void draw_line_file(const RenderRequest& r) {
  const std::unique_ptr<Sipp_bitmap, void (*)(Sipp_bitmap*)> bitmap(sipp_bitmap_create(r.width, r.height),
                                                                    sipp_bitmap_destruct);
  draw_lines(r, reinterpret_cast<LineFunction>(&sipp_bitmap_line), bitmap.get());
  write_header(r, "P4", static_cast<std::size_t>(r.height));
  const auto row_bytes = static_cast<std::size_t>(bitmap->width_bytes);
  for (const int y : rows_of(r)) {
    std::fwrite(bitmap->buffer + row_bytes * static_cast<std::size_t>(y), 1, row_bytes, r.file);
  }
  check_written(r.file);
}

void render(const RenderRequest& r) {
  guarded([&] {
    if (r.file == nullptr && r.func == nullptr)
      throw Error(ExitStatus::input, "no file or function to render to");
    check(r);
    const RenderingScope scope;
    try {
      if (capture(r)) return;
      if (r.mode != LINE) {
        deliver(r, draw(r));
      } else if (r.file != nullptr) {
        draw_line_file(r);
      } else {
        draw_lines(r, reinterpret_cast<LineFunction>(r.func), r.data);
      }
    } catch (const Terminated&) {
      // The program has asked for it.
    }
  });
}

}  // namespace

void shade_frame(const Scene& scene, GeometrySetup& setup) {
  prepare_shading(scene, setup.shading);
}

}  // namespace farop::sipp_api

using namespace farop::sipp_api;

void render_image_file(int width, int height, FILE* file, int mode, int oversampling) {
  render({width, height, mode, oversampling, BOTH, file, nullptr, nullptr});
}
void render_image_func(int width, int height, void (*func)(), void* data, int mode, int oversampling) {
  render({width, height, mode, oversampling, BOTH, nullptr, func, data});
}
void render_field_file(int width, int height, FILE* file, int mode, int oversampling, int field) {
  render({width, height, mode, oversampling, field, file, nullptr, nullptr});
}
void render_field_func(int width, int height, void (*func)(), void* data, int mode, int oversampling,
                       int field) {
  render({width, height, mode, oversampling, field, nullptr, func, data});
}

void sipp_render_terminate() {
  state().terminated = true;
}

void shadowmaps_create(int size) {
  guarded([&] {
    drop_shadow_maps();
    make_shadow_maps(snapshot({false, false, false}), size > 0 ? size : 256);
    state().lasting_shadows = true;
  });
}
void shadowmaps_destruct() {
  drop_shadow_maps();
  state().lasting_shadows = false;
}
