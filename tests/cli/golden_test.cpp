// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures that were looked at once and must stay as they are: tests/golden/CASE/{cmd,out.png}. Commands find
// the case's folder as $CASE, the scenes that ship as $SCENES, and leave out.png or, to save time, out.ppm.
//
// Metric: at most 0.02 % of the pixels may differ by more than one step of 8 bits (0.004), none by more than
// 0.25. Another C library may round a sine or a power in its last bit, which can move a corner by 1/256
// pixel; everything else is exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/shell.h"

namespace farop::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> golden_cases() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(FAROP_GOLDEN_FOLDER)) {
    if (entry.is_directory()) names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class Golden : public testing::TestWithParam<std::string> {};

TEST_P(Golden, PictureIsAsCommitted) {
  const fs::path golden = fs::path(FAROP_GOLDEN_FOLDER) / GetParam();
  const TemporaryFolder folder;
  const Outcome drawn =
      shell(folder, "CASE='" + golden.string() + "'; SCENES='" FAROP_SOURCE_DIR "/spd_scenes'\n" +
                        read_file(golden / "cmd"));
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const std::string out = fs::exists(folder / "out.ppm") ? "out.ppm" : "out.png";
  const Outcome compared = shell(folder, "farop compare '" + (golden / "out.png").string() + "' " + out +
                                             " -o diff.png --fail 0.004 --failpercent 0.02 --hardfail 0.25");
  EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
  if (compared.status != 0) {
    const fs::path kept = fs::temp_directory_path() / ("farop-golden-" + GetParam());
    fs::create_directories(kept);
    for (const std::string& name : {out, std::string("diff.png")}) {
      fs::copy_file(folder / name, kept / name, fs::copy_options::overwrite_existing);
    }
    ADD_FAILURE() << "the picture drawn and its differences are in " << kept;
  }
}

INSTANTIATE_TEST_SUITE_P(Pictures, Golden, testing::ValuesIn(golden_cases()), [](const auto& test) {
  std::string name = test.param;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace farop::test
