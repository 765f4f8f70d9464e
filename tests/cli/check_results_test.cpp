// SPDX-License-Identifier: GPL-3.0-or-later
// What `farop check` writes beside its text: every result option, as its reader meets it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "support/shell.h"

namespace {

using namespace farop::test;
using Json = nlohmann::json;

/// A rasterizer with its rows in the wrong order, and no other fault: one finding, in the smoke test.
const std::string k_upside_down = FAROP_MUTANTS "/mutant_37.so --family smoke --family colour/flat -q ";

class CheckResults : public testing::Test {
 protected:
  const TemporaryFolder folder;
};

std::string read(const TemporaryFolder& folder, const std::string& name) {
  std::ifstream file(folder / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> lines(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> list;
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}

/// Exit status of the validator of the unit tests, 77 without its tool.
int validated(const TemporaryFolder& folder, const std::string& kind, const std::string& file,
              const std::string& schema) {
  return shell(folder, "python3 " FAROP_REPORT_TESTS "/validate.py " + kind + " " + file + " " + schema)
      .status;
}

TEST_F(CheckResults, AllFilesOfOneRunAgree) {
  const Outcome run =
      shell(folder, "farop check " + k_upside_down +
                        "--report r.html --json r.json --jsonl r.jsonl --junit r.xml --tap r.tap "
                        "--csv r.csv --gradescope g.json");
  ASSERT_EQ(run.status, 1) << run.out << run.err;
  const Json json = Json::parse(read(folder, "r.json"));
  const std::size_t cases = json["cases"].size();
  EXPECT_EQ(json["summary"]["verdict"], "fail");
  EXPECT_EQ(json["summary"]["cases"], cases);
  EXPECT_EQ(json["findings"][0]["verdict"], "frame.flip-y");
  EXPECT_EQ(json["findings"][0]["severity"], "E");
  // One line a case, each whole, with the corpus that it belongs to.
  std::map<std::string, std::string> status;
  for (const std::string& line : lines(read(folder, "r.jsonl"))) {
    const Json one = Json::parse(line);
    EXPECT_EQ(one["corpus"], json["run"]["corpus"]);
    EXPECT_TRUE(status.emplace(one["id"], one["status"]).second) << line;
  }
  EXPECT_EQ(status.size(), cases);
  for (const Json& one : json["cases"]) EXPECT_EQ(status[one["id"]], one["status"]) << one["id"];
  EXPECT_EQ(lines(read(folder, "r.tap"))[1], "1.." + std::to_string(cases));
  EXPECT_EQ(lines(read(folder, "r.csv")).size(), cases + 1);
  EXPECT_EQ(Json::parse(read(folder, "g.json"))["tests"].size(), json["families"].size());
  const std::string page = read(folder, "r.html");
  EXPECT_NE(page.find("frame.flip-y"), std::string::npos);
  EXPECT_LT(page.size(), 3u << 20u) << "a typical failing run";
}

TEST_F(CheckResults, FilesFollowTheirSchemas) {
  ASSERT_EQ(shell(folder, "farop check " + k_upside_down + "--json r.json --junit r.xml").status, 1);
  const int json = validated(folder, "json", "r.json", FAROP_JSON_SCHEMA);
  const int junit = validated(folder, "junit", "r.xml", FAROP_REPORT_TESTS "/junit.xsd");
  if (json == 77 || junit == 77) GTEST_SKIP() << "python3-jsonschema or xmllint is missing";
  EXPECT_EQ(json, 0);
  EXPECT_EQ(junit, 0);
}

TEST_F(CheckResults, TellWhereAndWithWhatTheRunTookPlace) {
  ASSERT_EQ(shell(folder,
                  "cp $(farop plugins | grep -o '/.*trapezoid.so' | head -1) 'my mine.so' && farop check "
                  "'./my mine.so' --family smoke -q --json r.json")
                .status,
            0);
  const Json json = Json::parse(read(folder, "r.json"));
  const std::string sum = shell(folder, "sha256sum 'my mine.so'").out;
  EXPECT_EQ(json["plugin"]["sha256"], sum.substr(0, 64));
  EXPECT_EQ(json["run"]["command"], "farop check './my mine.so' --seed 1 --family smoke");
  for (const char* fact : {"version", "compiler", "system", "processor"})
    EXPECT_FALSE(json["run"][fact].get<std::string>().empty()) << fact;
  const std::string started = json["run"]["time_started"];
  EXPECT_EQ(started.size(), 20u) << started;
  EXPECT_EQ(started[10], 'T');
  EXPECT_EQ(shell(folder, json["run"]["command"].get<std::string>() + " -q").status, 0) << "it repeats";
}

TEST_F(CheckResults, SayHowPreciseARasterizerIs) {
  ASSERT_EQ(
      shell(folder, "farop check internal --family depth/frac --family colour/frac -q --json r.json").status,
      0);
  const Json precision = Json::parse(read(folder, "r.json"))["summary"]["precision"];
  EXPECT_EQ(precision["colour"], "nearest") << precision;
  EXPECT_LE(precision["depth_error"], 0.54) << precision;
  EXPECT_GT(precision["depth_error"], 0.0) << precision;
}

TEST_F(CheckResults, ARunThatIsStoppedLeavesTheLinesOfWhatItHadDone) {
  const Outcome run =
      shell(folder,
            "farop check --cmd 'n=$(cat n 2> /dev/null || echo 0); echo $((n + 1)) > n; [ $n -lt 12 ] || "
            "sleep 5; farop "
            "raster -q {flat} -o {ppm}' --family smoke --family colour -q --jsonl r.jsonl --gradescope "
            "g.json & pid=$!; "
            "for i in $(seq 200); do [ -s r.jsonl ] && break; sleep 0.05; done; kill -KILL $pid; wait $pid");
  EXPECT_NE(run.status, 0);
  const auto found = lines(read(folder, "r.jsonl"));
  ASSERT_FALSE(found.empty());
  for (const std::string& line : found) EXPECT_EQ(Json::parse(line)["status"], "passed") << line;
  EXPECT_EQ(Json::parse(read(folder, "g.json"))["score"], 0) << "Gradescope sees that it did not finish";
}

// What a second look says stands in the lines, too: they are told once it is known.
TEST_F(CheckResults, LinesSayWhatTheReportSaysOfThreadsThatRace) {
  const Outcome run =
      shell(folder,
            "farop check " FAROP_HOSTILE
            "/det.threads/24b-race.so --threads 2 --family det --no-shrink -q --json r.json --jsonl r.jsonl");
  ASSERT_EQ(run.status, 1) << run.out << run.err;
  const Json json = Json::parse(read(folder, "r.json"));
  ASSERT_EQ(json["findings"].size(), 1u) << json["findings"];
  EXPECT_EQ(json["findings"][0]["verdict"], "det.threads");
  const auto found = lines(read(folder, "r.jsonl"));
  ASSERT_EQ(found.size(), json["cases"].size());
  EXPECT_EQ(Json::parse(found[0])["verdicts"], json["cases"][0]["verdicts"]) << found[0];
  EXPECT_EQ(json["cases"][0]["verdicts"], Json::array({"det.threads"}));
}

TEST_F(CheckResults, SpeaksToGithub) {
  const Outcome run =
      shell(folder, "echo before > s.md; GITHUB_STEP_SUMMARY=s.md farop check --github " + k_upside_down);
  EXPECT_EQ(run.status, 1);
  EXPECT_TRUE(run.out.starts_with("::error title=farop check%3A frame.flip-y::")) << run.out;
  EXPECT_NE(run.out.find("\n::notice title=farop check::fail. "), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\nE frame.flip-y"), std::string::npos) << "and says the rest";
  const std::string summary = read(folder, "s.md");
  EXPECT_TRUE(summary.starts_with("before\n## farop check: ")) << summary;
  EXPECT_EQ(shell(folder, "farop check internal --family smoke -q --github").status, 0) << "elsewhere, too";
}

TEST_F(CheckResults, SpeakPortuguese) {
  const Outcome run = shell(folder, "farop check --lang pt --report r.html " + k_upside_down);
  EXPECT_NE(run.out.find("frame.flip-y: as imagens estão de cabeça para baixo"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("casos, "), std::string::npos) << run.out;
  EXPECT_NE(read(folder, "r.html").find("O que está errado"), std::string::npos);
  // One variable for the language that is spoken; that of a new project has its own.
  EXPECT_EQ(shell(folder, "FAROP_LANG=pt farop check " + k_upside_down).out, run.out);
  EXPECT_EQ(shell(folder, "FAROP_LANG=pt farop new mine --lang c -q").status, 0);
  EXPECT_EQ(shell(folder, "FAROP_NEW_LANG=c farop new other -q").status, 0);
  EXPECT_EQ(shell(folder, "farop check internal --lang xx").status, 2);
}

TEST_F(CheckResults, OneOfThemMayGoToStandardOutputAlone) {
  for (const char* option : {"--json -", "--gradescope -"}) {
    const Outcome run = shell(folder, std::string("farop check internal --family smoke ") + option);
    EXPECT_EQ(run.status, 0);
    EXPECT_TRUE(Json::accept(run.out)) << option << run.out;
  }
  EXPECT_EQ(lines(shell(folder, "farop check internal --family smoke --jsonl -").out).size(), 5u);
  EXPECT_TRUE(
      shell(folder, "farop check internal --family smoke --tap -").out.starts_with("TAP version 13\n"));
  EXPECT_TRUE(shell(folder, "farop check internal --family smoke --csv -").out.starts_with("id,family,"));
  EXPECT_TRUE(shell(folder, "farop check internal --family smoke --junit -").out.starts_with("<?xml "));
  EXPECT_TRUE(
      shell(folder, "farop check internal --family smoke --report -").out.starts_with("<!doctype html>"));
}

TEST_F(CheckResults, RefuseWhatCannotBeWritten) {
  EXPECT_EQ(shell(folder, "farop check internal --family smoke --json a --csv a").status, 2);
  EXPECT_EQ(shell(folder, "farop check internal --family smoke --json - --jsonl -").status, 2);
  EXPECT_EQ(shell(folder, "farop check internal --family smoke --github --json -").status, 2);
  for (const char* option : {"--report", "--json", "--jsonl", "--junit", "--tap", "--csv", "--gradescope"}) {
    const Outcome run =
        shell(folder, std::string("farop check internal --family smoke ") + option + " no/such/folder");
    EXPECT_EQ(run.status, 4) << option;
    EXPECT_EQ(run.out, "") << option << ": known before the run";
  }
  EXPECT_EQ(shell(folder, "farop check internal --family smoke --jsonl /dev/full").status, 4);
  EXPECT_EQ(shell(folder, "GITHUB_STEP_SUMMARY=no/such farop check internal --family smoke --github").status,
            4);
}

// Depths of single triangles as a PGM beside each picture: floor of the exact depth plus $1.
constexpr const char* k_depths = R"(
import glob, sys
wrong, extra = int(sys.argv[1]), len(sys.argv) > 2
for name in glob.glob("away/*.scr"):
    words = [int(w) for w in open(name).read().split() if w.lstrip("-").isdigit()]
    width, height, zres, _, polygons, _, corners = words[:7]
    rest = words[9:]
    if polygons != 1 or corners != 3: continue
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (rest[i:i + 3] for i in (0, 6, 12))
    det = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    if det == 0 or zres > 65536: continue
    sx = (bz - az) * (cy - ay) - (cz - az) * (by - ay)
    sy = (cz - az) * (bx - ax) - (bz - az) * (cx - ax)
    with open(name[:-3] + "pgm", "wb") as out:
        out.write(b"P5 %d %d %d\n" % (width, height, zres if extra else zres - 1))
        for y in range(height - 1, -1, -1):
            row = [az + ((x - ax) * sx + (y - ay) * sy) // det + wrong for x in range(width)]
            out.write(b"".join(min(max(z, 0), zres - 1).to_bytes(2 if zres > 256 else 1, "big") for z in row))
)";

TEST_F(CheckResults, DepthsThatComeWithPicturesAreJudged) {
  std::ofstream(folder / "depths.py") << k_depths;
  const std::string family = " --family depth/frac -q --json r.json";
  ASSERT_EQ(shell(folder, "farop check --emit away" + family).status, 0);
  ASSERT_EQ(
      shell(folder, "cd away && for f in *.scr; do farop raster -q $f -o ${f%.scr}.ppm || exit; done").status,
      0);
  EXPECT_EQ(shell(folder, "farop check --images away" + family).status, 0) << "probed";
  EXPECT_EQ(Json::parse(read(folder, "r.json"))["summary"]["precision"]["depth"], "");
  ASSERT_EQ(shell(folder, "python3 depths.py 0").status, 0);
  EXPECT_EQ(shell(folder, "farop check --images away" + family).status, 0) << "exact depths, rounded down";
  EXPECT_EQ(Json::parse(read(folder, "r.json"))["summary"]["precision"]["depth"], "within 1");
  // Three too far: the pictures, and with them the probes, are as right as before.
  ASSERT_EQ(shell(folder, "python3 depths.py 3").status, 0);
  EXPECT_EQ(shell(folder, "farop check --images away" + family).status, 1);
  const Json finding = Json::parse(read(folder, "r.json"))["findings"][0];
  EXPECT_TRUE(finding["verdict"].get<std::string>().starts_with("depth.")) << finding["verdict"];
  const Json pixel = finding["example"]["pixels"][0];
  EXPECT_EQ(pixel["kind"], "depth");
  const double exact =
      pixel["values"][0]["numerator"].get<double>() / pixel["values"][0]["denominator"].get<double>();
  EXPECT_GT(pixel["values"][0]["got"].get<double>(), exact + 1.25);
  // The maximum of the file says what its numbers mean.
  ASSERT_EQ(shell(folder, "python3 depths.py 0 other-maximum").status, 0);
  const Outcome run = shell(folder, "farop check --images away" + family);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.out.find("abi.picture"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("expected 64 x 64 and 511"), std::string::npos) << run.out;
}

TEST_F(CheckResults, PicturesOfAnyMaximumAreRead) {
  std::ofstream(folder / "deep.py") << R"(
import glob
for name in glob.glob("away/*.ppm"):
    data = open(name, "rb").read()
    head, body = data[:data.index(b"255") + 4], data[data.index(b"255") + 4:]
    open(name, "wb").write(head.replace(b"255", b"65535") + b"".join(bytes((b, b)) for b in body))
)";
  const std::string family = " --family smoke --family colour/frac --family colour/cres -q";
  ASSERT_EQ(shell(folder, "farop check --emit away" + family).status, 0);
  ASSERT_EQ(
      shell(folder, "cd away && for f in *.scr; do farop raster -q $f -o ${f%.scr}.ppm || exit; done").status,
      0);
  ASSERT_EQ(shell(folder, "python3 deep.py").status, 0);
  const Outcome run = shell(folder, "farop check --images away" + family);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
}

}  // namespace
