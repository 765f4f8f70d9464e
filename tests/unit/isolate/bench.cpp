// SPDX-License-Identifier: GPL-3.0-or-later
#include "unit/isolate/bench.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace farop::test {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::string plugin_path(const std::string& name) {
  return std::string(FAROP_TEST_PLUGINS) + "/" + name + ".so";
}

IsolationOptions options_for_tests() {
  IsolationOptions options;
  options.runner = own_runner();
  options.limits.cpu_seconds = 10;
  options.limits.wall_seconds = 20;
  options.limits.memory_bytes = std::uint64_t{256} << 20;
  return options;
}

Drawing triangles(int width, int height, std::uint32_t count, std::uint32_t per_batch, int subpixel_bits,
                  std::uint64_t seed) {
  Drawing drawing;
  drawing.frame.resolution = {width, height, 65536, 256};
  drawing.frame.subpixel_bits = subpixel_bits;
  drawing.frame.max_vertices = 3;
  std::mt19937_64 random(seed);
  const auto below = [&](std::int64_t end) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(end));
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % per_batch == 0) drawing.batches.emplace_back();
    ScreenPolygonBatch& batch = drawing.batches.back();
    ScreenPolygonRecord record;
    record.first_vertex = static_cast<std::uint32_t>(batch.vertices.size());
    record.vertex_count = 3;
    record.surface_id = 1 + i % 5;
    batch.polygons.push_back(record);
    for (int k = 0; k < 3; ++k) {
      ScreenVertex v;
      v.x = below((std::int64_t{width - 1} << subpixel_bits) + 1);
      v.y = below((std::int64_t{height - 1} << subpixel_bits) + 1);
      v.z = below(65536);
      v.r = static_cast<std::uint16_t>(below(256));
      v.g = static_cast<std::uint16_t>(below(256));
      v.b = static_cast<std::uint16_t>(below(256));
      batch.vertices.push_back(v);
      batch.vertex_ids.push_back(i);
    }
  }
  return drawing;
}

void draw(ScreenPolygonSink& sink, const Drawing& drawing) {
  sink.begin_frame(drawing.frame);
  for (const ScreenPolygonBatch& batch : drawing.batches) sink.polygons(batch);
  sink.end_frame();
}

Belongings belongings() {
  Belongings all;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc/self/fd")) {
    std::error_code error;
    const fs::path target = fs::read_symlink(entry.path(), error);
    if (!error && target.string().find("/proc/") != 0) all.descriptors.insert(entry.path().filename());
  }
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    std::string text;
    if (!std::getline(file, text) || text.rfind(')') == std::string::npos) continue;
    std::istringstream rest(text.substr(text.rfind(')') + 1));
    std::string state;
    int parent = 0;
    rest >> state >> parent;
    if (parent == ::getpid()) all.children.insert(text);
  }
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    if (line.find("memfd:") != std::string::npos) all.memories.insert(line);
  }
  return all;
}

const std::string& own_runner() {
  struct Copy {
    Copy() {
      std::string name = (std::filesystem::temp_directory_path() / "farop-runner-XXXXXX").string();
      if (::mkdtemp(name.data()) == nullptr) std::abort();
      folder = name;
      std::filesystem::permissions(folder, std::filesystem::perms(0755));
      path = folder + "/farop-runner";
      std::filesystem::copy_file(FAROP_RUNNER, path);
    }
    ~Copy() {
      std::error_code ec;
      std::filesystem::remove_all(folder, ec);
    }
    std::string folder, path;
  };
  static const Copy copy;
  return copy.path;
}

std::set<int> processes_running(const std::string& program) {
  std::set<int> found;
  const fs::path wanted = fs::canonical(program);
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc")) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0) continue;
    std::error_code error;
    bool is_it = fs::read_symlink(entry.path() / "exe", error) == wanted;
    if (error == std::errc::permission_denied) {
      // Runners may not be looked into; then by name and owner.
      std::ifstream file(entry.path() / "status");
      std::string name, uid;
      for (std::string line; std::getline(file, line);) {
        if (line.starts_with("Name:")) name = line;
        if (line.starts_with("Uid:")) uid = line;
      }
      is_it = name.find("farop-") != std::string::npos &&
              uid.find("\t" + std::to_string(::getuid()) + "\t") != std::string::npos;
    }
    if (is_it) found.insert(pid);
  }
  return found;
}

PluginFinding sin_finding(const std::string& sin, IsolationOptions options, int sinful_frame, int frames,
                          int scale) {
  options.plugin_options["sin"] = sin;
  options.plugin_options["frame"] = std::to_string(sinful_frame);
  try {
    IsolatedRasterizer rasterizer(plugin_path("sinner"), options, {});
    const Drawing drawing = triangles(16 * scale, 16 * scale, 5, 2);
    for (int i = 0; i < frames; ++i) draw(rasterizer, drawing);
    if (!rasterizer.findings().empty()) return rasterizer.findings().front();
  } catch (const PluginFailure& failure) {
    return failure.finding();
  }
  PluginFinding none;
  none.verdict = "pass";
  return none;
}

}  // namespace farop::test
