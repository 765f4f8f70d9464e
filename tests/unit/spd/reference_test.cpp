// SPDX-License-Identifier: GPL-3.0-or-later
// Compares with the output of the original programs.
#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "nff_text.h"

namespace farop::test {
namespace {

struct ReferenceFile {
  const char* scene;
  int size;
  bool tessellated;
};

constexpr ReferenceFile k_files[] = {
    {"balls", 1, false},   {"balls", 4, false},    {"balls", 1, true},     {"gears", 1, false},
    {"gears", 4, false},   {"jacks", 1, false},    {"jacks", 2, false},    {"jacks", 1, true},
    {"lattice", 2, false}, {"lattice", 12, false}, {"lattice", 1, true},   {"mount", 2, false},
    {"mount", 6, false},   {"mount", 2, true},     {"nurbtst", 1, false},  {"rings", 1, false},
    {"rings", 7, false},   {"rings", 1, true},     {"sample", 1, false},   {"sample", 1, true},
    {"shells", 1, false},  {"shells", 5, false},   {"sombrero", 1, false}, {"sombrero", 2, false},
    {"teapot", 2, false},  {"teapot", 6, false},   {"tetra", 2, false},    {"tetra", 6, false},
    {"tree", 2, false},    {"tree", 11, false},    {"tree", 2, true},
};

std::string unpacked(const std::filesystem::path& path) {
  gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr) throw std::runtime_error("cannot open " + path.string());
  std::string text;
  std::array<char, 65536> block;
  int bytes = 0;
  while ((bytes = gzread(file, block.data(), block.size())) > 0)
    text.append(block.data(), static_cast<std::size_t>(bytes));
  gzclose(file);
  if (bytes < 0) throw std::runtime_error("damaged file " + path.string());
  return text;
}

struct ReferenceLine {
  const char* scene;
  int size;
  bool tessellated;
  std::size_t line;  ///< from 1
  const char* text;
};

// Taken from the same files, so that something of them is compared wherever the tests run.
constexpr ReferenceLine k_lines[] = {
    {"balls", 4, false, 4600, "s -0.651197 -0.0978007 -0.243606 0.00617284"},
    {"balls", 4, false, 7395, "s 0.401567 -0.506323 -0.222222 0.00617284"},
    {"balls", 1, true, 500, "0.156374 0.387957 0.575357 -0.694747 0.694747 0.186157"},
    {"gears", 4, false, 30001, "-0.279287 0.508769 0.75"},
    {"gears", 4, false, 60002, "0.731691 0.505053 0.15"},
    {"jacks", 2, false, 60, "s 0.640856 -0.257671 -0.1963 0.075"},
    {"jacks", 1, true, 1100, "-0.05176 -0.630019 0.23557 -0.460088 0.173335 -1.23938"},
    {"lattice", 12, false, 9000, "c 0.5 0.916667 0.593646 0.00520833 0.5 0.916667 0.656354 0.00520833"},
    {"lattice", 1, true, 2000, "-0.173687 1.17369 0.953461 -0.694747 0.694747 -0.186157"},
    {"mount", 6, false, 14001, "0.6875 -0.25 0.332899"},
    {"mount", 6, false, 28003, "0 0.5 0.473574"},
    {"mount", 2, true, 1000, "-0.780841 0.871503 1.0487 -0.186157 -0.694747 0.694747"},
    {"nurbtst", 1, false, 3000, "1.40417 0.159513 -0.680604 0.521003 0.806462 -0.279599"},
    {"nurbtst", 1, false, 6005, "0.282299 -0.609405 -3.04973 -0.888999 0.391217 0.237972"},
    {"rings", 7, false, 4001, "c 4.71231 16.5642 -5 0.07412 5.28769 16.0747 -5.79195 0.07412"},
    {"rings", 7, false, 9200, "s 5.24681 17.7447 6 0.07412"},
    {"rings", 1, true, 9000, "-0.298352 2.2905 0.791951 -0.143798 0.989607 0"},
    {"sample", 1, false, 2001, "-0.75 0.580948 1.1619 0.5 -0.387298 -0.774597"},
    {"sample", 1, false, 3503, "0 -2 0"},
    {"sample", 1, true, 3403, "1.48803 0.244017 -1.98803 -0.666667 0.666667 -0.333333"},
    {"shells", 5, false, 3000, "s -0.250533 -0.137092 -0.571178 0.285589"},
    {"sombrero", 1, false, 3333, "-0.645161 -2.66947 -0.387097"},
    {"sombrero", 2, false, 20000, "1.20635 -3.2144 0.952381"},
    {"teapot", 2, false, 503, "-1.95 -0.225 0.75 7.83687e-17 -1 2.61229e-17"},
    {"teapot", 6, false, 4444, "-2.48875 -0.2 1.01872 -0.433172 -0.735531 -0.520919"},
    {"teapot", 6, false, 8000, "0.58575 0.58575 2.55 0.104474 0.104474 0.989025"},
    {"tetra", 6, false, 10000, "0.3125 -0.1875 -0.5"},
    {"tree", 11, false, 5000, "s -0.836146 -0.364501 2.60335 0.00183195"},
    {"tree", 11, false, 8200, "s -0.307026 0.526091 3.0908 0.00273426"},
    {"tree", 2, true, 2001, "0.55685 -0.115961 1.90167 -0.694747 0.694747 0.186157"},
};

TEST(SingleLines, OfTheOriginalProgramsAgree) {
  for (const ReferenceLine& expected : k_lines) {
    const std::string text = printed(request(expected.scene, expected.size, expected.tessellated));
    const auto lines = lines_of(text);
    ASSERT_GE(lines.size(), expected.line) << expected.scene;
    const auto ours = words_of(lines[expected.line - 1]), theirs = words_of(expected.text);
    EXPECT_TRUE(std::ranges::equal(ours, theirs, agree))
        << expected.scene << " line " << expected.line << ": " << lines[expected.line - 1] << ", expected "
        << expected.text;
  }
}

class Reference : public testing::TestWithParam<ReferenceFile> {};

TEST_P(Reference, AgreesNumberForNumber) {
  const auto [scene, size, tessellated] = GetParam();
  const std::string name =
      std::string(scene) + "-" + std::to_string(size) + (tessellated ? "-t" : "") + ".nff.gz";
  const std::filesystem::path path = std::filesystem::path(FAROP_SOURCE_DIR "/../shared/data/spd") / name;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "reference file " << name << " is not here";

  const std::string our_text = printed(request(scene, size, tessellated));
  const std::string their_text = unpacked(path);
  const auto ours = words_of(our_text), theirs = words_of(their_text);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i)
    ASSERT_TRUE(agree(ours[i], theirs[i])) << "word " << i << ": " << ours[i] << ", expected " << theirs[i];
}

INSTANTIATE_TEST_SUITE_P(Files, Reference, testing::ValuesIn(k_files), [](const auto& test) {
  const ReferenceFile& file = test.param;
  return std::string(file.scene) + "_" + std::to_string(file.size) + (file.tessellated ? "_t" : "");
});

}  // namespace
}  // namespace farop::test
