// SPDX-License-Identifier: GPL-3.0-or-later
// script -> NFF -> picture beside script -> picture, as a user makes both: the same where NFF can say it, and
// as far apart as docs/formats/sipp-to-nff.md says where it cannot.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "support/shell.h"

namespace farop::test {
namespace {

namespace fs = std::filesystem;

const fs::path k_source = FAROP_SOURCE_DIR;
const fs::path k_scenes = k_source / "spd_scenes/sipp";

Outcome must(const TemporaryFolder& folder, const std::string& command) {
  const Outcome run = shell(folder, command);
  EXPECT_EQ(run.status, 0) << command << "\n" << run.err;
  return run;
}

/// Share of the pixels, in percent, of which a channel differs by more than one level of 255. Two PPM of one
/// size, as farop writes them.
double percent_apart(const fs::path& a, const fs::path& b) {
  const std::string one = read_file(a), two = read_file(b);
  int width = 0, height = 0, header = 0;
  EXPECT_EQ(std::sscanf(one.c_str(), "P6 %d %d 255%n", &width, &height, &header), 2);
  const std::size_t first = static_cast<std::size_t>(header) + 1, pixels = std::size_t(width) * height;
  EXPECT_EQ(one.size(), first + 3 * pixels);
  EXPECT_EQ(one.substr(0, first), two.substr(0, first));
  if (one.size() != two.size() || pixels == 0) return 100;
  std::size_t apart = 0;
  for (std::size_t at = first; at < one.size(); at += 3) {
    bool far = false;
    for (std::size_t c = at; c < at + 3; ++c) {
      far = far || std::abs(static_cast<std::uint8_t>(one[c]) - static_cast<std::uint8_t>(two[c])) > 1;
    }
    apart += far ? 1 : 0;
  }
  return 100.0 * static_cast<double>(apart) / static_cast<double>(pixels);
}

struct Converted {
  std::string lost;           ///< what the notice names; empty without one
  std::vector<double> apart;  ///< percent_apart() of the pictures, mode by mode
};

/// Converts `script` with `defines`, and compares the pictures in these modes. `more` goes to both drawings,
/// `copied` to that of the copy.
Converted convert(const TemporaryFolder& folder, const std::vector<std::string>& modes,
                  const std::string& script, const std::string& defines, const std::string& more,
                  const std::string& copied) {
  Converted out;
  const Outcome run = must(folder, "farop convert " + script + defines + " -o copy.nff");
  const std::string start = "lost, because NFF cannot say it: ";
  if (const std::size_t at = run.err.find(start); at != std::string::npos) {
    out.lost = run.err.substr(at + start.size(), run.err.find('\n', at) - at - start.size());
    EXPECT_EQ(run.err.find(start, at + 1), std::string::npos) << "one notice, not two";
  }
  for (const std::string& mode : modes) {
    const std::string how = " -q --samples 1 --mode " + mode + more;
    must(folder, "farop render " + script + defines + how + " -o script.ppm && farop render copy.nff" + how +
                     copied + " -o copy.ppm");
    out.apart.push_back(percent_apart(folder / "script.ppm", folder / "copy.ppm"));
  }
  return out;
}

std::string path_of(const std::string& scene) {
  return "'" + (k_scenes / (scene + ".sipp")).string() + "'";
}

/// A script of ours whose directional lights are points, ten units away.
void copy_with_point_lights(const TemporaryFolder& folder, const std::string& scene) {
  std::string text = read_file(k_scenes / (scene + ".sipp"));
  const std::regex light(R"(SippLightSourceCreate \{(-?[0-9.]+) (-?[0-9.]+) (-?[0-9.]+)\} (\{[^}]*\}))");
  std::string out;
  std::smatch m;
  int lights = 0;
  for (; std::regex_search(text, m, light); text = m.suffix(), ++lights) {
    out += m.prefix().str() + "SippLightSourceCreate {" + std::to_string(10 * std::stod(m[1])) + " " +
           std::to_string(10 * std::stod(m[2])) + " " + std::to_string(10 * std::stod(m[3])) + "} " +
           m[4].str() + " POINT";
  }
  EXPECT_EQ(lights, 2);
  write_file(folder / (scene + ".sipp"), out + text);
}

/// Phong shaders with ambient 0.30, one opacity: what NFF says exactly.
TEST(ScriptsAsNff, LookTheSame) {
  const TemporaryFolder folder;
  copy_with_point_lights(folder, "walk");
  copy_with_point_lights(folder, "shapes");
  // Glass that does not overlap glass: two balls, a plate, above a floor of tiles.
  write_file(folder / "glass.sipp",
             "set glass [SippShaderPhong 0.3 0.6 0.8 60 {0.3 0.7 0.6} 0.6]\n"
             "set tile [SippShaderPhong 0.3 0.65 0.2 20 {0.8 0.78 0.7}]\n"
             "foreach {x y size} {-2.2 0 1  2.2 0.4 0.8} {\n  set ball [SippSphere $size 40 $glass]\n"
             "  SippObjectScale $ball {1 1 0.7}\n  SippObjectMove $ball [list $x $y $size]\n"
             "  SippObjectAddSubobj WORLD $ball\n}\n"
             "set plate [SippBlock {1.2 0.1 2} $glass]\nSippObjectMove $plate {0 0.5 1}\n"
             "SippObjectAddSubobj WORLD $plate\n"
             "loop i -5 6 {\n  loop j -5 6 {\n    set t [SippBlock {0.9 0.9 0.2} $tile]\n"
             "    SippObjectMove $t [list $i $j -0.3]\n    SippObjectAddSubobj WORLD $t\n  }\n}\n"
             "SippLightSourceCreate {-3 -5 7} {0.75 0.75 0.75} POINT\nSippBackground {0.3 0.4 0.5}\n"
             "SippCameraParams STDCAMERA {0 -12 5} {0 0 0.5} {0 0 1} 0.3\n"
             "SippRender [SippPixMapCreate] 400 300 PHONG 1\n");
  const std::string far_away = "directional lights (points far away instead)";
  const std::string sides = "that both sides of surfaces are drawn (--two-sided)";
  struct Case {
    std::string script, defines, copied, lost;
  };
  for (const Case& c : {Case{"walk.sipp", " --define frame=3", "", ""},
                        {"walk.sipp", " --define frame=12", "", ""},
                        {"shapes.sipp", "", " --two-sided", sides},
                        {"glass.sipp", "", "", "how opacities of surfaces behind each other add up"},
                        {path_of("walk"), " --define frame=7", "", far_away},
                        {path_of("shapes"), "", " --two-sided", far_away + "; " + sides}}) {
    const Converted converted = convert(folder, {"flat", "gouraud"}, c.script, c.defines, "", c.copied);
    EXPECT_EQ(converted.lost, c.lost) << c.script;
    for (const double percent : converted.apart) EXPECT_LE(percent, 0.1) << c.script << c.defines;
  }
}

/// Rows of the page's table of our scenes: name -> what is lost, how much of the picture.
std::map<std::string, Converted> documented() {
  std::map<std::string, Converted> rows;
  std::ifstream page(k_source / "docs/formats/sipp-to-nff.md");
  const std::regex row(R"(\| `([a-z]+)\.sipp` \| ([0-9.]+) \| (.*) \|)");
  std::smatch m;
  for (std::string line; std::getline(page, line);) {
    if (std::regex_match(line, m, row)) rows[m[1]] = {m[3], {std::stod(m[2])}};
  }
  return rows;
}

TEST(ScriptsAsNff, LoseWhatThePageSaysAndAsMuch) {
  const TemporaryFolder folder;
  const auto rows = documented();
  std::map<std::string, std::string> table;
  bool stale = false;
  for (const auto& entry : fs::directory_iterator(k_scenes)) {
    if (entry.path().extension() != ".sipp") continue;
    const std::string name = entry.path().stem().string();
    const Converted c = convert(folder, {"gouraud"}, path_of(name), "", " --resolution 160x120", "");
    char percent[20];
    std::snprintf(percent, sizeof percent, "%.1f", c.apart[0]);
    table[name] = "| `" + name + ".sipp` | " + percent + " | " + c.lost + " |\n";
    const auto found = rows.find(name);
    // Some pixels of slack, for machines that round otherwise.
    stale = stale || found == rows.end() || found->second.lost != c.lost ||
            std::abs(found->second.apart[0] - c.apart[0]) > 0.3;
  }
  EXPECT_EQ(rows.size(), table.size());
  std::string now;
  for (const auto& [name, line] : table) now += line;
  EXPECT_FALSE(stale) << "the table as it is now:\n" << now;
}

}  // namespace
}  // namespace farop::test
