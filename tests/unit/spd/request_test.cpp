// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "nff_text.h"

namespace farop::test {
namespace {

/// The error of a request that must fail before it prints.
Error usage_error_of(const SpdRequest& r) {
  try {
    write_spd(r, [](std::string_view) { ADD_FAILURE() << "printed something"; });
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), ExitStatus::usage);
    EXPECT_FALSE(error.hint().empty());
    EXPECT_THROW(spd_counts(r), Error);
    return error;
  }
  ADD_FAILURE() << "no error";
  return {ExitStatus::ok, ""};
}

TEST(UnknownScene, IsAUsageErrorThatNamesTheScenes) {
  const Error error = usage_error_of(request("teapod"));
  EXPECT_EQ(std::string(error.what()), "unknown scene 'teapod'");
  EXPECT_NE(error.hint().find("teapot"), std::string::npos);
  EXPECT_NE(error.hint().find("solid-cylinder"), std::string::npos);
  usage_error_of(request(""));
  usage_error_of(request("Gears"));
}

TEST(Sizes, BelowOneAreUsageErrorsInEveryScene) {
  for (const SpdSceneInfo& scene : spd_scenes())
    for (const int size : {0, -1, std::numeric_limits<int>::min()})
      usage_error_of(request(std::string(scene.name), size));
}

TEST(Sizes, AboveTheLargestAreUsageErrors) {
  for (const SpdSceneInfo& scene : spd_scenes()) {
    if (scene.size_ignored) continue;
    for (const int size : {scene.max_size + 1, std::numeric_limits<int>::max()}) {
      const Error error = usage_error_of(request(std::string(scene.name), size));
      EXPECT_NE(error.hint().find(std::to_string(scene.max_size)), std::string::npos);
    }
  }
}

TEST(Sizes, AreIgnoredWhereASceneHasOneSizeOnly) {
  for (const SpdSceneInfo& scene : spd_scenes()) {
    if (!scene.size_ignored) continue;
    const std::string name(scene.name);
    EXPECT_TRUE(printed(request(name, std::numeric_limits<int>::max())) == printed(request(name))) << name;
  }
}

TEST(Resolutions, OutOfRangeAreUsageErrors) {
  for (const int resolution : {0, -3, 1025, std::numeric_limits<int>::max()})
    usage_error_of(request("balls", 1, true, resolution));
}

TEST(Output, ComesInBoundedBlocksOfWholeEntities) {
  for (const SpdRequest& r :
       {request("gears", 4), request("balls", 4), request("balls", 2, true), request("teapot", 8)}) {
    int blocks = 0;
    write_spd(r, [&blocks](std::string_view block) {
      ++blocks;
      ASSERT_LE(block.size(), 100000u);
      ASSERT_EQ(block.back(), '\n');
      // A corner line begins with a digit or a minus.
      ASSERT_NE(std::string_view("bpscfl").find(block.front()), std::string_view::npos);
    });
    EXPECT_GT(blocks, 1);
  }
}

TEST(Output, StopsWithWhatTheReceiverThrows) {
  int blocks = 0;
  const auto full_disk = [&blocks](std::string_view) {
    ++blocks;
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(write_spd(request("tetra", 13), full_disk), std::runtime_error);
  EXPECT_EQ(blocks, 1);
}

TEST(Progress, GrowsToTheTotalOfAllObjects) {
  for (const SpdRequest& r :
       {request("gears"), request("rings", 3, true), request("sample"), request("teapot", 20)}) {
    const SpdCounts counts = spd_counts(r);
    const std::uint64_t objects = counts.polygons + counts.patches + counts.spheres + counts.cones;
    std::uint64_t last = 0;
    int calls = 0;
    write_spd(
        r, [](std::string_view) {},
        [&](std::uint64_t done, std::uint64_t total) {
          EXPECT_GE(done, last);
          EXPECT_EQ(total, objects);
          last = done;
          ++calls;
        });
    EXPECT_EQ(last, objects) << r.name;
    EXPECT_GT(calls, 1) << r.name;
  }
}

TEST(Layout, IsBackgroundViewLightsThenSurfacesAndObjects) {
  EXPECT_TRUE(
      printed(request("gears", 1))
          .starts_with(
              "b 0.078 0.361 0.753\nv\nfrom -1.1 -2.1 2.6\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\n"
              "resolution 512 512\nl 2 4 4\nl -2 4 3\nl 2 -2.5 2.5\nl -1 -4 2\nl -1.111 -2.121 2.626\n"
              "f 1 0.85 0.7 0.3 0.6 3.0827 0 0\np 4\n2 2 0\n-2 2 0\n-2 -2 0\n2 -2 0\n"
              "f 1 0.605523 0.408284 0.2 0 100000 0.8 1.1\np 144\n0.994453 -0.0329894 1\n"));
  EXPECT_TRUE(
      printed(request("tetra", 1))
          .ends_with(
              "f 1 0.2 0.2 1 0 100000 0 0\np 3\n-1 -1 1\n-1 1 -1\n1 -1 -1\np 3\n1 1 1\n1 -1 -1\n-1 1 -1\n"
              "p 3\n1 -1 -1\n1 1 1\n-1 -1 1\np 3\n-1 1 -1\n-1 -1 1\n1 1 1\n"));
}

TEST(Layout, PutsAConeOnOneLine) {
  EXPECT_NE(printed(request("tree", 1)).find("\nc 0 0 0 0.15 0 0 1 0.1005\ns 0 0 1 0.1005\n"),
            std::string::npos);
}

TEST(Layout, HasNoCommentsBlankLinesOrCarriageReturnsAndEndsWithALineEnd) {
  for (const SpdSceneInfo& scene : spd_scenes()) {
    const std::string text = printed(request(std::string(scene.name), 1));
    EXPECT_EQ(text.find_first_of("#\r\t"), std::string::npos) << scene.name;
    EXPECT_EQ(text.find("\n\n"), std::string::npos) << scene.name;
    EXPECT_EQ(text.find(" \n"), std::string::npos) << scene.name;
    EXPECT_EQ(text.back(), '\n') << scene.name;
  }
}

TEST(Shine, IsPrintedForTheHalfAnglesOfTheScenes) {
  const auto has = [](const char* scene, const char* fill) {
    return printed(request(scene, 1)).find(fill) != std::string::npos;
  };
  EXPECT_TRUE(has("mount", "f 1 1 1 0.1 0.1 101.148 0.9 1.5\n"));          // 6.7 degrees
  EXPECT_TRUE(has("shells", "f 1 0.8 0.4 0.8 0.2 45.2776 0 1\n"));         // 10
  EXPECT_TRUE(has("jacks", "f 0.737 0.561 0.561 0.7 0.7 11.1434 0 1\n"));  // 20
  EXPECT_TRUE(has("teapot", "f 1 1 1 0.5 0.5 4.81884 0 0\n"));             // 30
  EXPECT_TRUE(has("balls", "f 1 0.9 0.7 0.5 0.5 3.0827 0 1\n"));           // 37
  EXPECT_TRUE(has("sombrero", "f 1 0.1 0.1 0.8 0 2.60078 0 1\n"));         // 40
}

}  // namespace
}  // namespace farop::test
