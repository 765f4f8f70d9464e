// SPDX-License-Identifier: GPL-3.0-or-later
// Milliseconds a frame of the internal rasterizer's two paths and of llvmpipe, in turns, so that whatever
// else the machine does meets all of them. Prints JSON: medians, quartiles and the best.
//
// raster_bench [--threads N] [--seconds S] [--scene NAME] [--only tiled|plain|llvmpipe] [--vectors AVX2]
#include <fmt/format.h>
#include <hwy/targets.h>
#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <optional>

#include "raster/internal_rasterizer.h"
#include "triangle_scenes.h"
#ifdef FAROP_LLVMPIPE
#include "llvmpipe.h"
#endif

namespace farop::bench {
namespace {

struct Contestant {
  std::string name;
  std::function<void()> draw;
  std::vector<double> wall, cpu;  ///< milliseconds

  static double quantile(std::vector<double> sorted, double q) {
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1) + 0.5)];
  }
};

/// Seconds of all threads of the process: unlike the clock on the wall it does not run while others have the
/// processor.
double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

double now() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

InternalRasterizerOptions options(RasterPath path, int threads) {
  InternalRasterizerOptions o;
  o.tuning.path = path;
  o.tuning.threads = threads;
  return o;
}

struct Arguments {
  int threads = 1;
  double seconds = 2;       ///< a scene
  std::string scene, only;  ///< empty: all
  std::string vectors;      ///< instruction set, as Highway calls it; empty: the best of this machine
};

void use_vectors(const std::string& name) {
  for (std::int64_t rest = hwy::SupportedTargets() | HWY_SCALAR; rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

void run(const Arguments& arguments) {
  if (!arguments.vectors.empty()) use_vectors(arguments.vectors);
  InternalRasterizer tiled(options(RasterPath::tiled, arguments.threads));
  InternalRasterizer plain(options(RasterPath::plain, 1));
  Framebuffer picture;
#ifdef FAROP_LLVMPIPE
  Llvmpipe mesa(arguments.threads);
#endif
  fmt::print("{{\n  \"threads\": {},\n  \"vectors\": \"{}\",\n", arguments.threads,
             hwy::TargetName(hwy::SupportedTargets() & -hwy::SupportedTargets()));
#ifdef FAROP_LLVMPIPE
  fmt::print("  \"mesa\": \"{}\",\n", mesa.name());
#endif
  fmt::print("  \"scenes\": [");
  const char* comma = "";
  for (const std::string& name : triangle_scene_names()) {
    if (!arguments.scene.empty() && arguments.scene != name) continue;
    const TriangleScene scene = make_triangle_scene(name);
    std::vector<Contestant> all;
    all.push_back({"tiled", [&] { scene.play(tiled), picture = tiled.take(); }, {}, {}});
    all.push_back({"plain", [&] { scene.play(plain), picture = plain.take(); }, {}, {}});
#ifdef FAROP_LLVMPIPE
    double equal = 0;
    if (mesa.works()) {
      mesa.load(scene);
      all.push_back({"llvmpipe", [&] { mesa.draw(); }, {}, {}});
    }
#endif
    if (!arguments.only.empty()) {
      std::erase_if(all, [&](const Contestant& c) { return c.name != arguments.only; });
    }
    for (Contestant& c : all) c.draw();  // caches, pages, compiled shaders
#ifdef FAROP_LLVMPIPE
    scene.play(tiled);
    picture = tiled.take();
    std::size_t close = 0;
    const std::size_t pixels = picture.rgb.size() / 3;
    for (std::size_t i = 0; i < pixels; ++i) {
      bool is_close = true;
      for (std::size_t c = 0; c < 3; ++c) {
        is_close = is_close && std::abs(int{picture.rgb[3 * i + c]} - int{mesa.pixels()[4 * i + c]}) <= 2;
      }
      close += is_close ? 1 : 0;
    }
    equal = static_cast<double>(close) / static_cast<double>(pixels);
#endif
    const double end = now() + 1000 * arguments.seconds;
    int rounds = 0;
    while (rounds < 7 || now() < end) {
      // The slow ones need fewer repetitions.
      for (Contestant& c : all) {
        if (c.name == "plain" && rounds >= 7 && rounds % 8 != 0) continue;
        c.draw();  // so that the caches hold what this one needs, not what the one before it did
        const double start = now(), cpu_start = cpu_now();
        c.draw();
        c.cpu.push_back(cpu_now() - cpu_start);
        c.wall.push_back(now() - start);
      }
      ++rounds;
    }
    plain.begin_frame(scene.frame), plain.end_frame(), picture = plain.take();
    scene.play(plain);
    fmt::print(
        "{}\n    {{\"name\": \"{}\", \"triangles\": {}, \"fragments\": {}, \"visible\": {}, \"rounds\": {}",
        comma, name, scene.triangles(), plain.counts().fragments, plain.counts().visible_fragments, rounds);
    picture = plain.take();
#ifdef FAROP_LLVMPIPE
    fmt::print(", \"pixels_as_llvmpipe\": {:.5f}", equal);
#endif
    for (const Contestant& c : all) {
      fmt::print(",\n     \"{}\": {{", c.name);
      for (const bool cpu : {false, true}) {
        const std::vector<double>& times = cpu ? c.cpu : c.wall;
        fmt::print("{}\"{}\": {{\"median\": {:.4f}, \"low\": {:.4f}, \"high\": {:.4f}, \"best\": {:.4f}}}",
                   cpu ? ", " : "", cpu ? "cpu_ms" : "wall_ms", Contestant::quantile(times, 0.5),
                   Contestant::quantile(times, 0.25), Contestant::quantile(times, 0.75),
                   Contestant::quantile(times, 0));
      }
      fmt::print("}}");
    }
    fmt::print("}}");
    std::fflush(stdout);
    comma = ",";
  }
  fmt::print("\n  ]\n}}\n");
}

}  // namespace
}  // namespace farop::bench

int main(int argc, char** argv) {
  // Freed memory stays with the process, as in a program that draws frame after frame: no page faults in any
  // frame.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  farop::bench::Arguments arguments;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--threads") == 0) arguments.threads = std::max(1, std::atoi(argv[i + 1]));
    if (std::strcmp(argv[i], "--seconds") == 0) arguments.seconds = std::atof(argv[i + 1]);
    if (std::strcmp(argv[i], "--scene") == 0) arguments.scene = argv[i + 1];
    if (std::strcmp(argv[i], "--only") == 0) arguments.only = argv[i + 1];
    if (std::strcmp(argv[i], "--vectors") == 0) arguments.vectors = argv[i + 1];
  }
  farop::bench::run(arguments);
}
