// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugins/plugin_driver.h"

#include <dlfcn.h>

#include <algorithm>
#include <cfenv>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace farop::test {
namespace {

constexpr std::size_t k_apron = 4096;  ///< bytes before the first row and behind the last one

std::uint8_t pattern(std::size_t at) {
  return static_cast<std::uint8_t>(at * 37 + 0xA5);
}

}  // namespace

/// The interface promises that a host lives as long as the process, so these are never destroyed.
struct PluginDriver::Host {
  farop_host face{};
  std::map<std::string, std::string> options;
  std::mutex mutex;  // log() may be called from threads of the rasterizer
  std::vector<std::string> lines;

  explicit Host(std::map<std::string, std::string> given) : options(std::move(given)) {
    face.struct_size = sizeof face;
    face.abi_version = FAROP_ABI_VERSION;
    face.name = "farop tests";
    face.log = [](const farop_host* host, farop_log_level, const char* text) {
      Host& self = of(host);
      const std::lock_guard lock(self.mutex);
      self.lines.emplace_back(text);
    };
    face.option = [](const farop_host* host, const char* key) -> const char* {
      const auto found = of(host).options.find(key);
      return found == of(host).options.end() ? nullptr : found->second.c_str();
    };
    face.extension = [](const farop_host*, const char*) -> const void* { return nullptr; };
  }
  static Host& of(const farop_host* host) {
    // `face` is the first member, and no Host is const.
    return *reinterpret_cast<Host*>(const_cast<farop_host*>(host));
  }
};

struct PluginDriver::Library {
  const farop_rasterizer* table = nullptr;
  Host* host = nullptr;  ///< the one that the entry got
};

PluginDriver::Library& PluginDriver::open(const std::string& path,
                                          const std::map<std::string, std::string>& options) {
  // The entry is called once for a library, whatever the number of instances.
  static auto& libraries = *new std::map<std::string, Library>;
  Library& library = libraries[path];
  if (library.table != nullptr) return library;
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw std::runtime_error(dlerror());
  using Entry = const farop_rasterizer* (*)(const farop_host*);
  const auto entry = reinterpret_cast<Entry>(dlsym(handle, FAROP_ENTRY_SYMBOL));
  if (entry == nullptr) throw std::runtime_error(path + ": no " FAROP_ENTRY_SYMBOL);
  library.host = new Host(options);
  const farop_rasterizer* const table = entry(&library.host->face);
  const auto refuse = [&](const std::string& why) { throw std::runtime_error(path + ": " + why); };
  if (table == nullptr) {
    refuse("refused to load: " + (library.host->lines.empty() ? "no reason" : library.host->lines.back()));
  }
  if (table->struct_size < sizeof(farop_rasterizer)) refuse("table too small");
  if (table->abi_version >> 16 != FAROP_ABI_MAJOR) refuse("other major version");
  if (table->name == nullptr || *table->name == '\0' || table->summary == nullptr)
    refuse("no name or summary");
  if (std::string_view(table->name).find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") !=
      std::string_view::npos) {
    refuse(std::string("name '") + table->name + "' is not [a-z0-9_-]+");
  }
  if (!table->begin_frame || !table->polygon || !table->end_frame) refuse("a required function is missing");
  library.table = table;
  return library;
}

PluginDriver::PluginDriver(const std::string& library, std::map<std::string, std::string> options)
    : library_(&open(library, options)), host_(new Host(std::move(options))), table_(library_->table) {
  static auto& hosts = *new std::vector<Host*>;  // reachable until the end: not a leak
  hosts.push_back(host_);
  forget_log();
  if (table_->create != nullptr) check(table_->create(&host_->face, &self_), "create");
}

PluginDriver::~PluginDriver() {
  if (table_->destroy != nullptr) table_->destroy(self_);
}

void PluginDriver::forget_log() {
  last_log.clear();
  logs.clear();
  for (Host* host : {library_->host, host_}) {
    const std::lock_guard lock(host->mutex);
    host->lines.clear();
  }
}

void PluginDriver::collect_log() {
  for (Host* host : {library_->host, host_}) {
    const std::lock_guard lock(host->mutex);
    logs.insert(logs.end(), host->lines.begin(), host->lines.end());
    host->lines.clear();
  }
  if (!logs.empty()) last_log = logs.back();
}

void PluginDriver::fail(const std::string& what) {
  collect_log();
  throw std::runtime_error(std::string(table_->name) + ": " + what +
                           (last_log.empty() ? "" : ": " + last_log));
}

void PluginDriver::check(farop_status status, const char* call) {
  if (status != FAROP_OK) fail(std::string(call) + " returned " + std::to_string(status));
  if (std::fegetround() != FE_TONEAREST) fail(std::string(call) + " changed the rounding mode");
}

void PluginDriver::draw_polygon(const PluginPolygon& polygon, std::uint32_t index) {
  if (!polygon.ids.empty() && polygon.ids.size() != polygon.corners.size()) {
    throw std::invalid_argument("as many ids as corners, or none");
  }
  if ((table_->wants & FAROP_WANT_TRIANGLES) != 0 && polygon.corners.size() != 3) {
    throw std::invalid_argument("this rasterizer takes triangles only");
  }
  // Copies that end with the call, so that a sanitizer sees who keeps a pointer.
  const std::vector<farop_vertex> corners = polygon.corners;
  const std::vector<std::uint32_t> ids = polygon.ids;
  farop_polygon record{};
  record.struct_size = sizeof record;
  record.vertex_count = static_cast<std::uint32_t>(corners.size());
  record.vertices = corners.data();
  if ((table_->wants & FAROP_WANT_VERTEX_IDS) != 0 && !ids.empty()) record.vertex_ids = ids.data();
  record.index = index;
  record.flags = polygon.flags;
  record.surface_id = polygon.surface_id;
  record.object_id = polygon.object_id;
  const farop_polygon before = record;
  check(table_->polygon(self_, &record), "polygon");
  if (std::memcmp(&before, &record, sizeof record) != 0 || ids != polygon.ids ||
      std::memcmp(corners.data(), polygon.corners.data(), corners.size() * sizeof(farop_vertex)) != 0) {
    fail("polygon changed what it was given");
  }
}

PluginPicture PluginDriver::draw(const PluginFrame& size, std::span<const PluginPolygon> polygons) {
  forget_log();
  const auto width = static_cast<std::size_t>(size.width), height = static_cast<std::size_t>(size.height);
  const std::size_t row_bytes = 3 * width + static_cast<std::size_t>(size.padding);
  std::vector<std::uint8_t> memory(k_apron + height * row_bytes + k_apron);
  for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = pattern(i);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t i = 0; i < 3 * width; ++i) {
      memory[k_apron + y * row_bytes + i] = size.background[i % 3];
    }
  }

  farop_frame frame{};
  frame.struct_size = sizeof frame;
  frame.width = size.width;
  frame.height = size.height;
  frame.subpixel_bits = size.subpixel_bits;
  frame.z_far = size.z_far;
  frame.max_vertices = 3;
  for (const PluginPolygon& polygon : polygons) {
    frame.max_vertices = std::max(frame.max_vertices, static_cast<std::uint32_t>(polygon.corners.size()));
  }
  if (size.max_vertices != 0) frame.max_vertices = size.max_vertices;
  frame.number = frame_number_++;
  frame.row_bytes = static_cast<std::int64_t>(row_bytes);
  frame.pixels = memory.data() + k_apron;
  std::copy(size.background.begin(), size.background.end(), frame.background);
  const farop_frame before = frame;

  check(table_->begin_frame(self_, &frame), "begin_frame");
  std::uint32_t index = 0;
  for (const PluginPolygon& polygon : polygons) draw_polygon(polygon, index++);
  check(table_->end_frame(self_), "end_frame");
  if (std::memcmp(&before, &frame, sizeof frame) != 0) fail("the frame record was changed");

  PluginPicture picture{size.width, size.height, {}};
  picture.rgb.reserve(3 * width * height);
  for (std::size_t i = 0; i < memory.size(); ++i) {
    const bool in_rows = i >= k_apron && i < k_apron + height * row_bytes;
    if (in_rows && (i - k_apron) % row_bytes < 3 * width) {
      picture.rgb.push_back(memory[i]);
    } else if (memory[i] != pattern(i)) {
      fail("wrote outside the picture, " +
           std::to_string(static_cast<long long>(i) - static_cast<long long>(k_apron)) +
           " bytes from its start (" + std::to_string(size.width) + " x " + std::to_string(size.height) +
           ", row_bytes " + std::to_string(row_bytes) + ")");
    }
  }
  collect_log();
  return picture;
}

}  // namespace farop::test
