// SPDX-License-Identifier: GPL-3.0-or-later
// Includes point one way: parse -> scene -> geometry -> screen polygons -> raster | export; siblings do not
// know each other, and each third-party package has one room.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;
using Rooms = std::set<std::string>;

const fs::path k_root = FAROP_SOURCE_DIR;

const std::map<std::string, Rooms> k_may_include = {
    {"core", {}},
    {"shading", {"core"}},
    {"scene", {"core", "shading"}},
    {"parse_nff", {"core", "shading", "scene"}},
    {"parse_sipp", {"core", "shading", "scene"}},
    {"spd", {"core", "scene"}},
    {"geometry", {"core", "shading", "scene"}},
    {"solids", {"core", "scene", "geometry"}},
    {"raster", {"core", "shading"}},
    {"shadow", {"core", "shading", "scene", "geometry", "raster"}},
    {"sipp_api", {"core", "shading", "scene", "parse_sipp", "geometry", "raster", "shadow", "export"}},
    {"plugin", {"core", "shading"}},
    {"isolate", {"core", "shading", "plugin"}},
    {"export", {"core", "shading", "scene"}},
    {"conformance", {"core"}},
    {"conformance_report", {"core", "conformance"}},
};

/// Third-party headers by their first folder -> the only places that may include them.
const std::map<std::string, Rooms> k_guests = {{"CGAL", {"src/geometry", "src/solids"}},
                                               {"OpenImageIO", {"src/export"}},
                                               {"CLI", {"apps/farop"}},
                                               {"hwy", {"src/raster", "src/geometry", "apps/farop"}},
                                               {"tbb", {"src/parse_nff", "src/raster", "src/geometry"}},
                                               {"tcl.h", {"src/parse_sipp"}},
                                               {"nlohmann", {"apps/farop", "src/conformance_report"}},
                                               {"mstch", {"src/conformance_report"}}};

/// First folder of an #include line, "" for anything else.
std::string included_folder(const std::string& line) {
  if (line.starts_with("#include <tcl.h>")) return "tcl.h";
  const std::size_t open = line.find_first_of("<\"");
  const std::size_t slash = line.find('/');
  if (!line.starts_with("#include") || open == std::string::npos || slash == std::string::npos) return "";
  return line.substr(open + 1, slash - open - 1);
}

template <class Visit>
void for_each_include(const fs::path& folder, const Visit& visit) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const std::string other = included_folder(line);
      if (!other.empty()) visit(entry.path(), other);
    }
  }
}

TEST(Layering, RoomsIncludeOnlyTheRoomsBeforeThem) {
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(k_root / "src")) {
    if (!entry.is_directory()) continue;
    const std::string room = entry.path().filename();
    ASSERT_TRUE(k_may_include.contains(room)) << "a new room: say here what it may include: " << room;
    for_each_include(entry.path(), [&](const fs::path& file, const std::string& other) {
      if (!k_may_include.contains(other) || other == room) return;
      ++seen;
      EXPECT_TRUE(k_may_include.at(room).contains(other)) << file << " includes " << other;
    });
  }
  EXPECT_GT(seen, 50);
}

TEST(Layering, GuestsStayInTheirRooms) {
  for (const std::string top : {"src", "apps"}) {
    for_each_include(k_root / top, [&](const fs::path& file, const std::string& guest) {
      const auto rooms = k_guests.find(guest);
      if (rooms == k_guests.end()) return;
      const std::string place = fs::relative(file, k_root).string();
      bool allowed = false;
      for (const std::string& room : rooms->second) allowed = allowed || place.starts_with(room + "/");
      EXPECT_TRUE(allowed) << place << " includes " << guest;
    });
  }
}

TEST(Layering, HeavyHeadersStayOutOfHeaders) {
  for_each_include(k_root / "src", [](const fs::path& file, const std::string& guest) {
    const bool heavy = guest == "CGAL" || guest == "OpenImageIO";
    const bool shared = file.extension() == ".h" && !file.filename().string().ends_with("_internal.h");
    EXPECT_FALSE(heavy && shared) << file;
  });
}

}  // namespace
