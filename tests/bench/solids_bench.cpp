// SPDX-License-Identifier: GPL-3.0-or-later
// The table of M. Lenz Cesar and M. C. Ferreira de Oliveira (1995) as this machine has it: the three solids,
// 400 x 600 pixels, flat shading, with the variants of `solids` and, to have a scale, other rasterizers.
//
//   solids_bench [rounds]
//
// Rounds are interleaved (1 2 3 ... 1 2 3 ...), so that a slow moment of the machine hits all alike; medians
// count. Timed are all calls of a frame, from begin_frame() to end_frame(); clearing the picture is not.
#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "plugins/solid_scenes.h"

namespace farop::test {
namespace {

constexpr int k_width = 400, k_height = 600;

struct Contestant {
  std::string name;
  std::string library;
  std::map<std::string, std::string> options;
};

/// `face` is the first member, so a pointer to it is one to the Host.
struct Host {
  farop_host face{};
  std::map<std::string, std::string> options;
  std::string last_line;

  static Host& of(const farop_host* host) { return *reinterpret_cast<Host*>(const_cast<farop_host*>(host)); }
};

/// A rasterizer and its host.
class Instance {
 public:
  explicit Instance(const Contestant& contestant) {
    void* const library = dlopen(contestant.library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    host_->options = contestant.options;
    host_->face.struct_size = sizeof host_->face;
    host_->face.abi_version = FAROP_ABI_VERSION;
    host_->face.name = "solids_bench";
    host_->face.log = [](const farop_host* host, farop_log_level, const char* text) {
      Host::of(host).last_line = text;
    };
    host_->face.option = [](const farop_host* host, const char* key) -> const char* {
      const auto found = Host::of(host).options.find(key);
      return found == Host::of(host).options.end() ? nullptr : found->second.c_str();
    };
    host_->face.extension = [](const farop_host*, const char*) -> const void* { return nullptr; };
    using Entry = const farop_rasterizer* (*)(const farop_host*);
    const auto entry = reinterpret_cast<Entry>(dlsym(library, FAROP_ENTRY_SYMBOL));
    if (entry == nullptr) throw std::runtime_error(contestant.library + ": no entry");
    table_ = entry(&host_->face);
    check(table_->create(&host_->face, &self_));
  }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;
  ~Instance() { table_->destroy(self_); }

  const std::string& last_line() const { return host_->last_line; }

  /// Seconds of one frame.
  double draw(const std::vector<farop_polygon>& polygons, std::vector<std::uint8_t>& pixels) {
    std::memset(pixels.data(), 0, pixels.size());
    farop_frame frame{};
    frame.struct_size = sizeof frame;
    frame.width = k_width, frame.height = k_height;
    frame.z_far = 65535;
    frame.max_vertices = 100;
    frame.row_bytes = 3 * k_width;
    frame.pixels = pixels.data();
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    check(table_->begin_frame(self_, &frame));
    for (const farop_polygon& polygon : polygons) check(table_->polygon(self_, &polygon));
    check(table_->end_frame(self_));
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

 private:
  void check(farop_status status) const {
    if (status != FAROP_OK) throw std::runtime_error(table_->name + (": " + host_->last_line));
  }

  Host* host_ = new Host;  ///< the interface has hosts live as long as the process
  const farop_rasterizer* table_ = nullptr;
  void* self_ = nullptr;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// Of `key=number` in a line of statistics.
double number(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(" " + key + "=");
  return at == std::string::npos ? 0 : std::atof(line.c_str() + at + key.size() + 2);
}

void run(const std::string& solid, const std::vector<Contestant>& contestants, int rounds) {
  const Scene scene = load_solid(solid);
  const std::vector<PluginPolygon> polygons = screen_polygons(scene, own_view(scene), {});
  std::vector<farop_polygon> records;
  for (const PluginPolygon& polygon : polygons) {
    farop_polygon record{};
    record.struct_size = sizeof record;
    record.vertex_count = static_cast<std::uint32_t>(polygon.corners.size());
    record.vertices = polygon.corners.data();
    record.vertex_ids = polygon.ids.data();
    record.index = static_cast<std::uint32_t>(records.size());
    record.flags = polygon.flags;
    record.surface_id = polygon.surface_id, record.object_id = polygon.object_id;
    records.push_back(record);
  }
  std::vector<std::uint8_t> pixels(3 * k_width * k_height);
  std::vector<std::unique_ptr<Instance>> instances;
  for (const Contestant& contestant : contestants)
    instances.push_back(std::make_unique<Instance>(contestant));
  std::vector<std::vector<double>> seconds(contestants.size());
  std::vector<std::map<std::string, std::vector<double>>> parts(contestants.size());
  for (int round = 0; round < rounds + 3; ++round) {
    for (std::size_t i = 0; i < instances.size(); ++i) {
      const double taken = instances[i]->draw(records, pixels);
      if (round < 3) continue;  // caches and buffers are filled first
      seconds[i].push_back(taken);
      for (const char* part : {"build", "scan", "pixel"}) {
        parts[i][part].push_back(number(instances[i]->last_line(), std::string(part) + "_seconds"));
      }
    }
  }
  const double first = median(seconds[0]);
  std::printf("\n%s, %zu faces\n%-14s%12s%14s%12s%9s%9s%9s%9s%9s\n", solid.c_str(), polygons.size(), "",
              "edge table", "active, max", "compared", "build", "scan", "pixels", "all, ms", "ratio");
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const std::string& line = instances[i]->last_line();
    const auto ms = [&](const char* part) { return 1000 * median(parts[i][part]); };
    std::printf("%-14s%12.0f%14.0f%12.0f%9.3f%9.3f%9.3f%9.3f%9.3f\n", contestants[i].name.c_str(),
                number(line, "edge_table"), number(line, "active_edges_max"),
                number(line, "depth_comparisons"), ms("build"), ms("scan"), ms("pixel"),
                1000 * median(seconds[i]), median(seconds[i]) / first);
  }
}

}  // namespace
}  // namespace farop::test

int main(int argc, char** argv) {
  using farop::test::Contestant;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 201;
  std::vector<Contestant> contestants;
  for (const char* variant : {"1", "2", "3"}) {
    contestants.push_back(
        {std::string("Alg. ") + variant, FAROP_SOLIDS, {{"variant", variant}, {"statistics", "1"}}});
  }
  contestants.push_back({"trapezoid", FAROP_TRAPEZOID, {}});
  contestants.push_back({"scanline_fill", FAROP_SCANLINE_FILL, {}});
  contestants.push_back({"watkins", FAROP_WATKINS, {}});
  try {
    for (const char* solid : {"hollow-cube", "solid-torus", "solid-cylinder"}) {
      farop::test::run(solid, contestants, std::max(rounds, 1));
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "solids_bench: %s\n", error.what());
    return 1;
  }
}
