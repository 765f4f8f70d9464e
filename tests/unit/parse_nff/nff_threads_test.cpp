// SPDX-License-Identifier: GPL-3.0-or-later
// Reading with several threads gives the same scene and the same messages as the plain reader, wherever the
// text is split.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "nff_text.h"
#include "spd/spd.h"
#include "unit/conformance/long_tests.h"

#ifdef FAROP_HAVE_ZLIB
#include <zlib.h>
#endif

namespace farop {
namespace {

namespace fs = std::filesystem;

NffOptions on_threads(int threads, std::size_t piece) {
  NffOptions options;
  options.threads = threads;
  options.piece_bytes = piece;
  return options;
}

ParsedText parse_file(const std::string& path, const NffOptions& options) {
  WordReader reader(path);
  DiagnosticList list;
  ParsedText parsed;
  parsed.scene = parse_nff(reader, list, options);
  parsed.reports = std::move(list.items);
  return parsed;
}

/// Excerpts are of the text that is still at hand, which for files depends on how they are read.
void expect_same(const ParsedText& parsed, const ParsedText& plain, bool with_excerpts) {
  ASSERT_EQ(parsed.scene.has_value(), plain.scene.has_value());
  if (plain.scene) {
    ASSERT_TRUE(same_content(*parsed.scene, *plain.scene));
    const InputSummary &a = parsed.summary(), &b = plain.summary();
    ASSERT_EQ(fmt::format("{} {} {} {} {} {} {}", a.bytes, a.surfaces, a.polygons, a.patches, a.spheres,
                          a.cones, a.lights),
              fmt::format("{} {} {} {} {} {} {}", b.bytes, b.surfaces, b.polygons, b.patches, b.spheres,
                          b.cones, b.lights));
  }
  ASSERT_EQ(parsed.reports.size(), plain.reports.size());
  for (std::size_t i = 0; i < plain.reports.size(); ++i) {
    ASSERT_EQ(parsed.report(i), plain.report(i));
    ASSERT_EQ(parsed.reports[i].hint, plain.reports[i].hint);
    if (with_excerpts) {
      ASSERT_EQ(to_text(parsed.reports[i]), to_text(plain.reports[i]));
    }
  }
}

ParsedText parse_plainly(std::string_view text) {
  NffOptions plain;
  plain.plain = true;
  return parse_only(text, plain);
}

/// Named like the texts in memory, in a folder of its own: the object has the name of the file.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string_view text) {
    fs::create_directory(folder_);
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  ~TemporaryFile() { fs::remove_all(folder_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

 private:
  fs::path folder_ = fs::temp_directory_path() / fmt::format("farop-threads-{}", ::getpid());

 public:
  const std::string path = (folder_ / "scene.nff").string();
};

void expect_same_on_threads(std::string_view text, std::initializer_list<std::size_t> pieces) {
  const ParsedText plain = parse_plainly(text);
  int threads = 2;
  for (const std::size_t piece : pieces) {
    SCOPED_TRACE(fmt::format("pieces of {} bytes, {} threads", piece, threads));
    expect_same(parse_only(text, on_threads(threads, piece)), plain, true);
    if (testing::Test::HasFatalFailure()) return;
    threads = threads % 4 + 1;  // 1 is without pieces
  }
}

std::string spd_text(const char* name, int size, bool tessellate) {
  SpdRequest request;
  request.name = name;
  request.size = size;
  request.tessellate = tessellate;
  std::string text;
  write_spd(request, [&](std::string_view block) { text += block; });
  return text;
}

// Everything that a run may end at, or that may make one out of what is none.
const std::string k_odd_scene =
    "\xEF\xBB\xBF# p 3\nb 0.078 0.361 0.753\nv\nfrom -1.1 -2.1 2.6\nat 0 0 0\nup 0 0 1\nangle 45\n"
    "hither 1\nresolution 512 512\nl 2 4 4\nl -2 4 3 1 0.5 0.5\n"
    "p 3\n0 0 0\n1 0 0\n0 1 0\n"  // before the first f
    "f 1 0.85 0.7 0.3 0.6 3.0827 0 0\np 4\n2 2 0\n-2 2 0\n-2 -2 0\n2 -2 0\n"
    "p 4\n2 2 0\n-2 2 0\n-2 -2 0\n2 -2 0.5\n"  // bent
    "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1 # corner\n0 1 0 0 0 1\n"
    "pp 3\r\n0 0 0 0 0 1\r\n1 0 0 0 0 1\r\n0 1 0 0 0 1\r\np 3\r0 0 0\r1 0 0\r0 1 0\r"
    "p 2\n0 0 0\n1 1 1\n  p 3 0 0 0\n\t1 0 0\n\n\n-0 1e0 +0.\n"
    "f 1 0.5 0.4 0.2 0 -1 0.8 1.1\nf 1 0.5 0.4 0.2 0 1 1.8 1.1\nf 1 1 1 1 0 0 0 1 p3.tga\nf 1 1 1\n"
    "k p\n{\np 3\n0 0 0\n1 0 0\n0 1 0\n}\n"  // a name; key frames that look like a polygon
    "tt\np 0 0 0 0 0 1 0 0 1 0 0 1 0 0 1\np 3\n0 0 5\n1 0 0\n0 1 0\n"  // the texture's name is p
    "texture p 3\np 3\n0 0 0 1 0 0 0 1 0\ns 1e-3 +2 3. .5\nc 0 0 0 1 0 0 1 0\n"
    "f 1 0.85 0.7 0.3 0.6 3.0827 0 0\nl 1 1 1\np 3\n0.123456789012345678 0 0\n1.5e-300 0 0\n0 12345678 0\n"
    "p 3\n100000000 0.12345678 0\n-12345.6789 0 1\n0 1 -.5\npp 3\n1 2 3 0 0 1\n2 2 3 0 0 1\n2 3 3 0 0 1\n% p "
    "3\n"
    "p 3\n0 0 0\n1 0 0\n0 1 0\nf 0 0 0 0 0 0 0 0\n";

TEST(NffThreads, GiveTheSameWhereverASceneIsSplit) {
  const ParsedText plain = parse_plainly(k_odd_scene);
  ASSERT_TRUE(plain.scene) << plain.report(plain.reports.size() - 1);
  ASSERT_GT(plain.reports.size(), 10u);  // of all kinds
  const TemporaryFile file(k_odd_scene);
  for (std::size_t piece = 1; piece <= k_odd_scene.size() / 2; piece += 1 + piece / 64) {
    SCOPED_TRACE(piece);
    ASSERT_NO_FATAL_FAILURE(expect_same(parse_only(k_odd_scene, on_threads(2, piece)), plain, true));
    ASSERT_NO_FATAL_FAILURE(expect_same(parse_file(file.path, on_threads(3, piece)), plain, false));
  }
}

TEST(NffThreads, GiveTheSameOfAllScenesOfTheGenerators) {
  const std::tuple<const char*, int, bool> scenes[] = {
      {"gears", 1, false},  {"gears", 3, false}, {"mount", 6, true},    {"balls", 2, true},
      {"balls", 3, false},  {"tetra", 6, false}, {"jacks", 1, true},    {"lattice", 2, true},
      {"rings", 2, true},   {"tree", 5, true},   {"nurbtst", 2, false}, {"shells", 2, true},
      {"teapot", 4, false}, {"sample", 2, true}, {"sombrero", 1, false}};
  for (const auto& [name, size, tessellate] : scenes) {
    SCOPED_TRACE(name);
    ASSERT_NO_FATAL_FAILURE(expect_same_on_threads(spd_text(name, size, tessellate), {700, 4096, 0, 50'000}));
  }
}

TEST(NffThreads, GiveTheSameOfDamagedScenes) {
  std::mt19937_64 random(78);
  std::string scene = k_odd_scene;
  for (int i = 0; i < 60; ++i) {
    const bool patch = random() % 2 != 0;
    const auto corners = 3 + random() % 2;
    if (random() % 8 == 0) scene += "f 1 0.5 0 0.5 0.5 20 0 1\n";
    scene += fmt::format("{} {}\n", patch ? "pp" : "p", corners);
    for (auto c = corners; c > 0; --c) {
      for (int k = patch ? 6 : 3; k > 0; --k)
        scene += fmt::format("{}{:.6g}", random() % 16 == 0 ? "\r\n" : " ",
                             std::ldexp(static_cast<double>(random() % 64), -5) - 1);
      scene += '\n';
    }
  }
  constexpr std::string_view k_letters = "0123456789.-+eEpvf#% \n\r\t\x80{}\0";
  std::size_t errors = 0;
  for (auto round = test::repetitions(2500, 100'000); round > 0; --round) {
    std::string damaged = scene;
    for (auto edits = random() % 4; edits > 0; --edits) {
      const std::size_t at = random() % damaged.size();
      switch (random() % 4) {
        case 0:
          damaged[at] = k_letters[random() % k_letters.size()];
          break;
        case 1:
          damaged.insert(at, 1, k_letters[random() % k_letters.size()]);
          break;
        case 2:
          damaged.insert(at, damaged, random() % damaged.size(), random() % 200);
          break;
        default:
          damaged.erase(at, 1 + random() % 10);
          break;
      }
    }
    const std::size_t piece = 1 + random() % (random() % 4 == 0 ? 2000 : 100);
    const ParsedText plain = parse_plainly(damaged);
    errors += plain.count(Severity::error);
    ASSERT_NO_FATAL_FAILURE(
        expect_same(parse_only(damaged, on_threads(2 + static_cast<int>(random() % 3), piece)), plain, true))
        << "pieces of " << piece << " bytes of\n"
        << damaged;
  }
  EXPECT_GT(errors, 500u);
}

// Longer than any piece and any room around it: cut between words, or within a word that is cut anyway.
/// All polygons and primitives of surfaces in order, whatever surfaces they are in.
struct Flattened {
  std::vector<double> numbers;

  void add(const Surface& surface) {
    std::size_t next = 0;
    const auto curved_before = [&](std::uint64_t polygon) {
      for (; next < surface.curved.size() && surface.curved[next].after_polygons <= polygon; ++next) {
        const CurvedPrimitive& c = surface.curved[next];
        numbers.insert(numbers.end(),
                       {c.sphere.center.x, c.sphere.radius, c.cone.base.y, c.cone.apex_radius});
      }
    };
    std::uint64_t index = 0;
    for (const PolygonView polygon : surface.polygons) {
      curved_before(index++);
      numbers.insert(numbers.end(), {surface.material.color.r, surface.material.shine, surface.material.ks});
      for (const std::uint32_t v : polygon.corners) {
        const V3d p = surface.positions[v];
        const V3d n = polygon.has_given_normals ? surface.normals[v] : V3d(9, 9, 9);
        numbers.insert(numbers.end(), {p.x, p.y, p.z, n.x, n.y, n.z});
      }
    }
    curved_before(index);
  }
};

TEST(NffParts, AreTheSceneInOrder) {
  for (const std::string& text : {k_odd_scene, spd_text("gears", 1, false), spd_text("balls", 1, false)}) {
    const ParsedText plain = parse_plainly(text);
    Flattened expected;
    for (std::size_t i = 0; i < plain.surfaces(); ++i) expected.add(plain.surface(i));
    for (const std::size_t part : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 30}) {
      for (const int threads : {1, 2}) {
        SCOPED_TRACE(fmt::format("parts of {} bytes, {} threads", part, threads));
        NffOptions options = on_threads(threads, 500);
        options.part_bytes = part;
        Flattened parts;
        std::size_t calls = 0;
        options.on_part = [&](const Scene& so_far, const std::vector<std::shared_ptr<Surface>>& surfaces) {
          EXPECT_TRUE(so_far.root.children.empty());
          ++calls;
          for (const auto& surface : surfaces) parts.add(*surface);
        };
        const ParsedText parsed = parse_only(text, options);
        ASSERT_TRUE(parsed.scene);
        EXPECT_EQ(parsed.surfaces(), 0u);
        EXPECT_EQ(parsed.summary().surfaces, plain.summary().surfaces);
        EXPECT_EQ(parsed.summary().polygons, plain.summary().polygons);
        EXPECT_TRUE(parts.numbers == expected.numbers);
        if (part > text.size() * 20) {
          EXPECT_EQ(calls, 1u);
        } else {
          EXPECT_GT(calls, 1u);
        }
      }
    }
  }
}

TEST(NffThreads, TakeLongLinesCommentsAndWords) {
  std::string polygons = "f 1 1 1 1 0 0 0 1 ";
  for (int i = 0; i < 20'000; ++i) polygons += fmt::format("p 3 0 0 {} 1 0 0 0 1 0 ", i);
  const std::string comment =
      "f 1 1 1 1 0 0 0 1\np 3 0 0 0 1 0 0 0 1 0\n#" + std::string(300'000, 'c') + " p 3\n";
  const std::string word = comment + "p 3 0 0 0 1 0 0 0 1 " + std::string(300'000, '1');
  const std::string blanks = comment + std::string(300'000, ' ') + "\np 3\n0 0 0\n0 0 1\n0 1 0";
  for (const std::string& text : {polygons, comment, word, blanks, polygons + '\n' + polygons}) {
    const ParsedText plain = parse_plainly(text);
    const TemporaryFile file(text);
    for (const std::size_t piece : {std::size_t{1000}, std::size_t{70'000}}) {
      ASSERT_NO_FATAL_FAILURE(expect_same(parse_only(text, on_threads(2, piece)), plain, true));
      ASSERT_NO_FATAL_FAILURE(expect_same(parse_file(file.path, on_threads(2, piece)), plain, false));
    }
  }
}

TEST(NffThreads, ShowTheSourceLineOfAMessageInAFile) {
  std::string text = spd_text("tetra", 5, false);
  text.insert(text.rfind("p 3"), "q 3\n");
  const TemporaryFile file(text);
  const ParsedText parsed = parse_file(file.path, on_threads(2, 3000));
  ASSERT_EQ(parsed.reports.size(), 1u);
  EXPECT_EQ(parsed.reports[0].excerpt, "q 3");
}

std::string contents(const fs::path& path) {
  if (path.extension() != ".gz") {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  std::string text;
#ifdef FAROP_HAVE_ZLIB
  const gzFile file = gzopen(path.c_str(), "rb");
  char block[1 << 16];
  for (int got = 0; (got = gzread(file, block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(got));
  gzclose(file);
#endif
  return text;
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ec;
  for (const auto& entry : fs::recursive_directory_iterator(folder, ec)) {
    if (entry.path().string().find(".nff") != std::string::npos) files.push_back(entry.path());
  }
  return files;
}

void expect_same_of_all(const fs::path& folder) {
#ifdef FAROP_HAVE_ZLIB
  const std::vector<fs::path> files = files_below(folder);
  if (files.empty()) GTEST_SKIP() << "no scenes in " << folder;
  for (const fs::path& path : files) {
    SCOPED_TRACE(path);
    const std::string text = contents(path);
    const std::size_t tiny = 1 + text.size() / 3000;
    ASSERT_NO_FATAL_FAILURE(expect_same_on_threads(text, {tiny, 1000 + tiny, 0, 1 + text.size() / 5}));
  }
#else
  GTEST_SKIP() << "built without zlib: " << folder;
#endif
}

TEST(NffThreads, GiveTheSameOfAllReferenceFiles) {
  expect_same_of_all(fs::path(FAROP_SOURCE_DIR) / "../shared/data/spd");
}

TEST(NffThreads, GiveTheSameOfTheCorpus) {
  expect_same_of_all(fs::path(FAROP_SOURCE_DIR) / "tests/corpus/nff");
}

TEST(NffThreads, GiveTheSameOfScenesThatShip) {
  expect_same_of_all(fs::path(FAROP_SOURCE_DIR) / "spd_scenes");
}

}  // namespace
}  // namespace farop
