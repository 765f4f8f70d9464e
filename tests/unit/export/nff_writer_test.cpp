// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/nff_writer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "core/error.h"
#include "parse_nff/parse_nff.h"
#include "scene/plane.h"
#include "scene/surface_builder.h"
#include "scene/tessellate.h"
#include "support/sanitizers.h"

#ifdef FAROP_HAVE_ZLIB
#include <zlib.h>
#endif

namespace farop {
namespace {

namespace fs = std::filesystem;

struct Written {
  std::string text;
  std::vector<std::string> notes;
};

Written write(const Scene& scene, const NffWriteOptions& options = {}) {
  Written written;
  DiagnosticList list;
  write_nff(
      scene, options, [&](std::string_view piece) { written.text += piece; }, list);
  for (const Diagnostic& d : list.items) {
    EXPECT_EQ(d.severity, Severity::note);
    EXPECT_EQ(d.where.file, options.name);
    written.notes.push_back(d.message);
  }
  return written;
}

Scene parse(std::string_view text) {
  WordReader reader(text, "scene.nff");
  DiagnosticList list;
  std::optional<Scene> scene = parse_nff(reader, list);
  EXPECT_TRUE(scene) << (list.items.empty() ? std::string() : to_text(list.items.back()));
  return scene ? std::move(*scene) : Scene{};
}

Scene loaded(std::string_view text, int detail) {
  Scene scene = parse(text);
  tessellate_scene(scene, Detail{detail, std::nullopt});
  // Surfaces that had nothing but skipped primitives are not written.
  auto& surfaces = scene.root.children.at(0)->surfaces;
  std::erase_if(surfaces, [](const auto& surface) { return surface->polygons.empty(); });
  return scene;
}

// Surfaces are compared bit by bit where operator== would take 0 for -0.
void expect_same_bits(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.root.children.size(), b.root.children.size());
  for (std::size_t o = 0; o < a.root.children.size(); ++o) {
    ASSERT_EQ(a.root.children[o]->surfaces.size(), b.root.children[o]->surfaces.size());
    for (std::size_t s = 0; s < a.root.children[o]->surfaces.size(); ++s) {
      const Surface& x = *a.root.children[o]->surfaces[s];
      const Surface& y = *b.root.children[o]->surfaces[s];
      ASSERT_EQ(x.positions.size(), y.positions.size());
      ASSERT_EQ(x.normals.size(), y.normals.size());
      for (std::size_t v = 0; v < x.positions.size(); ++v) {
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_EQ(std::signbit(x.positions[v][axis]), std::signbit(y.positions[v][axis]));
          if (!x.normals.empty()) {
            ASSERT_EQ(std::signbit(x.normals[v][axis]), std::signbit(y.normals[v][axis]));
          }
        }
      }
    }
  }
}

void expect_round_trip(const Scene& scene) {
  const std::string text = write(scene).text;
  const Scene again = parse(text);
  ASSERT_TRUE(same_content(scene, again)) << text.substr(0, 4000);
  expect_same_bits(scene, again);
  ASSERT_EQ(write(again).text, text);
}

std::shared_ptr<Object> object_with(Surface surface, const M44d& matrix = {}) {
  auto object = std::make_shared<Object>();
  object->to_parent = matrix;
  object->surfaces.push_back(std::make_shared<Surface>(std::move(surface)));
  return object;
}

Surface quad(bool with_normals) {
  SurfaceBuilder builder;
  builder.begin_polygon(with_normals);
  for (const V3d& p : {V3d(0, 0, 0), V3d(1, 0, 0), V3d(1, 1, 0), V3d(0, 1, 0)}) {
    if (with_normals) {
      builder.add_corner(p, V3d(0, 1, 2));
    } else {
      builder.add_corner(p);
    }
  }
  builder.end_polygon();
  return builder.take();
}

TEST(NffWriter, WritesEverythingInTheDocumentedOrder) {
  const char* text =
      "b 0.078 0.361 0.753\n"
      "v\nfrom -1.1 -2.1 2.6\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 512 256\n"
      "l 2 4 4\nl -2 4 3 1 0.5 20\n"
      "f 1 0.85 0.7 0.3 0.6 3.0827 0 0\n"
      "p 4\n2 2 0\n-2 2 0\n-2 -2 0\n2 -2 0\n"
      "f 1 0.605523 0.408284 0.2 0 1e+05 0.8 1.1\n"
      "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 0 0 0\n"
      "p 3\n0 0 0\n1 0 0\n0 1 0\n";
  const Written written = write(parse(text));
  EXPECT_EQ(written.text, text);
  EXPECT_TRUE(written.notes.empty());
}

TEST(NffWriter, SortsWhatAFileHadInAnotherOrder) {
  EXPECT_EQ(
      write(
          parse(
              "f 1 1 1 1 0 0 0 1\np 3 0 0 0 1 0 0 0 1 0\nl 1 2 3\nv hither 2 at 0 0 0 from 0 0 1\nb 0 0 0\n"))
          .text,
      "b 0 0 0\nv\nfrom 0 0 1\nat 0 0 0\nhither 2\nl 1 2 3\nf 1 1 1 1 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\n");
}

TEST(NffWriter, WritesTheShortestNumbersThatReadBackTheSame) {
  EXPECT_EQ(
      write(parse("l 0.1 -0 1e-7\nl 100000 123456789012 0.30000000000000004\nl 1.7976931348623157e308 "
                  "4.9e-324 -1.50\n"))
          .text,
      "l 0.1 -0 1e-07\nl 1e+05 123456789012 0.30000000000000004\nl 1.7976931348623157e+308 5e-324 -1.5\n");
}

TEST(NffWriter, WritesNothingForAnEmptyScene) {
  const Written written = write(parse("f 1 1 1 1 0 0 0 1\n"));
  EXPECT_EQ(written.text, "");
  EXPECT_TRUE(written.notes.empty());
}

TEST(NffWriter, LeavesSurfacesWithoutPolygonsOut) {
  const Scene scene = loaded("f 1 0 0 1 0 0 0 1\ns 0 0 0 1\nf 0 1 0 1 0 0 0 1\np 3 0 0 0 1 0 0 0 1 0\n", 0);
  EXPECT_EQ(write(scene).text, "f 0 1 0 1 0 0 0 1\np 3\n0 0 0\n1 0 0\n0 1 0\n");
}

TEST(NffWriter, MovesPositionsByTheMatricesAndNormalsByTheInverseTranspose) {
  Scene scene;
  M44d scale;
  scale.setScale(V3d(1, 2, 4));
  M44d move;
  move.setTranslation(V3d(10, 0, 0));
  auto outer = std::make_shared<Object>();
  outer->to_parent = move;
  outer->children.push_back(object_with(quad(true), scale));
  scene.root.children.push_back(outer);
  // Shearing does not come out right with the matrix itself: (0,1,2) becomes (0, 1/2, 2/4), not (0, 2, 8).
  EXPECT_EQ(
      write(scene).text,
      "f 1 1 1 1 0 0 0 1\npp 4\n10 0 0 0 0.5 0.5\n11 0 0 0 0.5 0.5\n11 2 0 0 0.5 0.5\n10 2 0 0 0.5 0.5\n");
}

TEST(NffWriter, KeepsNormalsAcrossTheEdgeOfAMirroredObject) {
  Scene scene;
  M44d mirror;
  mirror.setScale(V3d(-1, 1, 1));
  scene.root.children.push_back(object_with(quad(true), mirror));
  const std::string text = write(scene).text;
  EXPECT_NE(text.find("\n-1 0 0 0 1 2\n"), std::string::npos) << text;
}

TEST(NffWriter, WritesZeroNormalsForAFlattenedObject) {
  Scene scene;
  M44d flat;
  flat.setScale(V3d(1, 1, 0));
  scene.root.children.push_back(object_with(quad(true), flat));
  EXPECT_NE(write(scene).text.find("\n1 1 0 0 0 0\n"), std::string::npos);
}

TEST(NffWriter, WritesInstancesOncePerPlace) {
  Scene scene;
  const auto shared = object_with(quad(false));
  for (const double x : {0.0, 5.0}) {
    auto place = std::make_shared<Object>();
    place->to_parent.setTranslation(V3d(x, 0, 0));
    place->children.push_back(shared);
    scene.root.children.push_back(place);
  }
  EXPECT_EQ(write(scene).text,
            "f 1 1 1 1 0 0 0 1\np 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nf 1 1 1 1 0 0 0 1\np 4\n5 0 0\n6 0 0\n6 1 "
            "0\n5 1 0\n");
}

TEST(NffWriter, WritesAveragedNormalsAsPatches) {
  Scene scene;
  Surface surface = quad(false);
  average_normals(surface);
  scene.root.children.push_back(object_with(std::move(surface)));
  EXPECT_EQ(write(scene).text,
            "f 1 1 1 1 0 0 0 1\npp 4\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n");
}

TEST(NffWriter, PrefersGivenNormalsToAverages) {
  Scene scene;
  Surface surface = quad(true);
  average_normals(surface);
  scene.root.children.push_back(object_with(std::move(surface)));
  EXPECT_NE(write(scene).text.find("\n0 1 0 0 1 2\n"), std::string::npos);
}

TEST(NffWriter, SplitsPolygonsWhereAsked) {
  NffWriteOptions options;
  std::vector<std::vector<V3d>> asked;
  options.triangulate = [&](std::span<const V3d> corners, std::vector<std::array<std::uint32_t, 3>>& out) {
    EXPECT_TRUE(out.empty());
    asked.emplace_back(corners.begin(), corners.end());
    for (std::uint32_t i = 2; i < corners.size(); ++i) out.push_back({0, i - 1, i});
  };
  const Scene scene = parse(
      "f 1 1 1 1 0 0 0 1\np 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\np 3\n0 0 1\n1 0 1\n0 1 1\n"
      "pp 4\n0 0 0 0 0 1\n1 0 0 0 0 2\n1 1 0 0 0 3\n0 1 0 0 0 4\n");
  EXPECT_EQ(
      write(scene, options).text,
      "f 1 1 1 1 0 0 0 1\np 3\n0 0 0\n1 0 0\n1 1 0\np 3\n0 0 0\n1 1 0\n0 1 0\np 3\n0 0 1\n1 0 1\n0 1 1\n"
      "pp 3\n0 0 0 0 0 1\n1 0 0 0 0 2\n1 1 0 0 0 3\npp 3\n0 0 0 0 0 1\n1 1 0 0 0 3\n0 1 0 0 0 4\n");
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(asked[0], (std::vector<V3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
}

TEST(NffWriter, TriangulatesInWorldCoordinates) {
  NffWriteOptions options;
  V3d last(0, 0, 0);
  options.triangulate = [&](std::span<const V3d> corners, auto& out) {
    last = corners[2];
    out.push_back({0, 1, 2});
  };
  Scene scene;
  M44d move;
  move.setTranslation(V3d(10, 20, 30));
  scene.root.children.push_back(object_with(quad(false), move));
  EXPECT_EQ(write(scene, options).text, "f 1 1 1 1 0 0 0 1\np 3\n10 20 30\n11 20 30\n11 21 30\n");
  EXPECT_EQ(last, V3d(11, 21, 30));
}

TEST(NffWriter, SaysOncePerKindWhatItLeavesOut) {
  Scene scene = parse(
      "v from 0 0 1 at 0 0 0 hither 1 yon 9 resolution 4 2\n"
      "f 1 1 1 1 0 0 0 1 0.5\np 3 0 0 0 1 0 0 0 1 0\nf 1 1 1 1 0 0 0 1 0.6\np 3 0 0 0 1 0 0 0 1 0\n");
  scene.view.fit = Fit::both;
  NffWriteOptions options;
  options.name = "copy.nff";
  const Written written = write(scene, options);
  EXPECT_EQ(written.text.find("yon"), std::string::npos);
  EXPECT_EQ(written.notes,
            (std::vector<std::string>{
                "the far plane (yon) is not written: NFF's is infinitely far",
                "pixels that are not square are not written: NFF readers take the angle for the vertical one",
                "ambient coefficients (Ka) other than 0.3 are not written: NFF has none"}));
}

TEST(NffWriter, WritesNoViewWithoutFromAndAt) {
  Scene scene;
  scene.view.resolution = {512, 512};
  scene.view.from = V3d(0, 0, 1);
  const Written written = write(scene);
  EXPECT_EQ(written.text, "");
  EXPECT_EQ(written.notes,
            std::vector<std::string>{"view parameters are not written: NFF has no view without from and at"});
}

TEST(NffWriter, RefusesScenesThatAreNotTessellated) {
  try {
    write(parse("f 1 1 1 1 0 0 0 1\ns 0 0 0 1\n"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::internal);
  }
}

TEST(NffWriter, RefusesCoordinatesThatOverflowOnTheirWayToWorldSpace) {
  Scene scene;
  M44d scale;
  scale.setScale(V3d(1e308, 1e308, 1e308));
  auto outer = std::make_shared<Object>();
  outer->to_parent = scale;
  outer->children.push_back(object_with(quad(false), scale));
  scene.root.children.push_back(outer);
  try {
    write(scene);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::input);
  }
}

TEST(NffWriter, WritesFilesThatAppearWithTheCommit) {
  const fs::path path = fs::path(testing::TempDir()) / "farop_nff_writer_test.nff";
  fs::remove(path);
  const Scene scene = parse("l 1 2 3\n");
  DiagnosticList list;
  {
    OutputFile file(path.string());
    write_nff(scene, {}, file, list);
    EXPECT_FALSE(fs::exists(path));
    file.commit();
  }
  std::ifstream in(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "l 1 2 3\n");
  fs::remove(path);
}

// ------------------------------------------------------------------------------------------------- round
// trips

TEST(NffRoundTrip, KeepsTheVertexNumbersOfSurfacesThatMixPolygonsAndPatches) {
  expect_round_trip(
      parse("f 1 1 1 1 0 0 0 1\npp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\np 3\n0 1 0\n1 0 0\n0 0 0\n"
            "pp 3\n0 0 0 0 0 1\n0 1 0 0 0 -1\n-0 0 0 0 -0 1\np 4\n-0 0 0\n1 0 0\n1 1 0\n0 1 0\n"));
}

/// Small scenes of everything that NFF has, with few different numbers, so that vertices often meet.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {}

  std::string text() {
    std::string text;
    if (chance(2)) text += fmt::format("b {} {} {}\n", unit(), unit(), unit());
    if (chance(2)) text += view();
    for (int i = static_cast<int>(random_() % 3); i > 0; --i) {
      text += fmt::format("l {}{}\n", vector(),
                          chance(2) ? fmt::format(" {} {} {}", unit(), number(), unit()) : "");
    }
    for (int i = static_cast<int>(random_() % 12); i > 0; --i) text += entity();
    return text;
  }

 private:
  bool chance(unsigned one_in) { return random_() % one_in == 0; }

  double number() {
    switch (random_() % 6) {
      case 0:
        return -0.0;
      case 1:
        return std::ldexp(static_cast<double>(random_()) - 2147483648.0,
                          static_cast<int>(random_() % 60) - 60);
      case 2:
        return static_cast<double>(random_() % 1000000) / 1e5;
      default:
        return static_cast<double>(random_() % 5) - 2;
    }
  }
  double unit() { return static_cast<double>(random_() % 1001) / 1000; }
  double radius() { return static_cast<double>(1 + random_() % 1000) / 250; }
  std::string vector() { return fmt::format("{} {} {}", number(), number(), number()); }

  std::string view() {
    std::string text = fmt::format("v\nfrom {} 100\nat {} {} 1\n", fmt::format("{} {}", number(), number()),
                                   number(), number());
    if (chance(2)) text += fmt::format("up {}\n", vector());
    if (chance(2)) text += fmt::format("angle {}\n", 1 + 178 * unit());
    if (chance(2)) text += fmt::format("hither {}\n", unit());
    if (chance(2)) text += fmt::format("resolution {} {}\n", 1 + random_() % 32767, 1 + random_() % 32767);
    return text;
  }

  std::string entity() {
    switch (random_() % 7) {
      case 0:
        return fmt::format("s {} {}\n", vector(), (chance(3) ? -1 : 1) * radius());
      case 1: {
        const double sign = chance(3) ? -1 : 1;
        return fmt::format("c {} {} {} {}\n", vector(), sign * radius(), vector(),
                           chance(3) ? 0.0 : sign * radius());
      }
      case 2:
      case 3:
        return fmt::format("f {} {} {} {} {} {} {} {}\n", unit(), unit(), unit(), unit(), unit(),
                           100 * unit(), unit(), 1 + unit());
      default: {
        const bool normals = chance(2);
        const auto count = 3 + random_() % (chance(10) ? 40 : 3);
        std::string text = fmt::format("{} {}\n", normals ? "pp" : "p", count);
        for (auto i = count; i > 0; --i) text += vector() + (normals ? " " + vector() : "") + "\n";
        return text;
      }
    }
  }

  std::mt19937 random_;
};

TEST(NffRoundTrip, KeepsEveryBitOfRandomScenes) {
  for (int seed = 1; seed <= test::rounds(4000); ++seed) {
    const std::string text = RandomScene(static_cast<unsigned>(seed)).text();
    expect_round_trip(loaded(text, seed % 3));
    if (HasFatalFailure() || HasNonfatalFailure()) FAIL() << "seed " << seed << "\n" << text;
  }
}

TEST(NffRoundTrip, OfMovedAndAveragedScenesIsStableFromTheSecondOn) {
  for (unsigned seed = 1; seed <= 500; ++seed) {
    Scene scene = loaded(RandomScene(seed).text(), 1);
    M44d turn;
    turn.setEulerAngles(V3d(0.1 * seed, 0.2, 0.3));
    M44d scale;
    scale.setScale(V3d(1, 0.5, seed % 2 == 0 ? 3 : -3));
    scene.root.children[0]->to_parent = scale * turn;
    for (const auto& surface : scene.root.children[0]->surfaces) {
      if (seed % 3 == 0) average_normals(*surface);
    }
    const std::string first = write(scene).text;
    ASSERT_EQ(write(parse(first)).text, first) << "seed " << seed;
  }
}

class NffRoundTripOfReferenceFile : public testing::TestWithParam<const char*> {};

TEST_P(NffRoundTripOfReferenceFile, KeepsEveryBit) {
#ifdef FAROP_HAVE_ZLIB
  const fs::path path =
      fs::path(FAROP_SOURCE_DIR) / "../shared/data/spd" / (std::string(GetParam()) + ".nff.gz");
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const gzFile file = gzopen(path.c_str(), "rb");
  ASSERT_NE(file, nullptr);
  std::string text;
  char block[1 << 16];
  for (int got = 0; (got = gzread(file, block, sizeof block)) > 0;)
    text.append(block, static_cast<std::size_t>(got));
  gzclose(file);
  expect_round_trip(loaded(text, 1));
#else
  GTEST_SKIP() << "built without zlib";
#endif
}

INSTANTIATE_TEST_SUITE_P(Spd, NffRoundTripOfReferenceFile,
                         testing::Values("balls-1", "balls-4", "balls-1-t", "gears-1", "gears-4", "jacks-1",
                                         "jacks-2", "jacks-1-t", "lattice-2", "lattice-12", "lattice-1-t",
                                         "mount-2", "mount-6", "mount-2-t", "nurbtst-1", "rings-1", "rings-7",
                                         "rings-1-t", "sample-1", "sample-1-t", "shells-1", "shells-5",
                                         "sombrero-1", "sombrero-2", "teapot-2", "teapot-6", "tetra-2",
                                         "tetra-6", "tree-2", "tree-11", "tree-2-t"),
                         [](const auto& name) {
                           std::string text = name.param;
                           for (char& c : text) c = c == '-' ? '_' : c;
                           return text;
                         });

}  // namespace
}  // namespace farop
