// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "nff_text.h"

namespace farop::test {
namespace {

class CommittedScene : public testing::TestWithParam<const char*> {};

TEST_P(CommittedScene, IsWhatTheGeneratorPrintsByteForByte) {
  const std::string path = std::string(FAROP_SOURCE_DIR "/spd_scenes/") + GetParam() + ".nff";
  std::ifstream file(path, std::ios::binary);
  ASSERT_TRUE(file) << path;
  std::ostringstream content;
  content << file.rdbuf();
  EXPECT_TRUE(content.str() == printed(request(GetParam()))) << path << " is out of date";
}

INSTANTIATE_TEST_SUITE_P(Solids, CommittedScene,
                         testing::Values("hollow-cube", "solid-torus", "solid-cylinder"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace farop::test
