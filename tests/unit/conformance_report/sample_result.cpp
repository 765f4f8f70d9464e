// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_result.h"

namespace farop::conformance_report {
namespace {

using namespace conformance;

void put(Framebuffer& f, int x, int y, const Color& c) {
  for (std::size_t i = 0; i < 3; ++i) f.rgb[3 * f.pixel(x, y) + i] = c[i];
}

Example triangle() {
  Example e;
  e.frame = {12, 10, 512, 256};
  e.polygons = {{{1, 1, 10, 200, 80, 40, 0}, {10, 2, 100, 200, 80, 40, 0}, {3, 8, 300, 200, 80, 40, 0}}};
  e.flat = "12 10 512 256\n3\n1 1 10 200 80 40\n10 2 100 200 80 40\n3 8 300 200 80 40\n";
  e.command = "farop check --case 'a.scr' '<script>'";
  e.from_case = "cov/tri4#17@1";
  const Color paint{200, 80, 40};
  e.expected = {12, 10, std::vector<std::uint8_t>(360), {}};
  e.owners.assign(120, -1);
  for (int y = 2; y < 6; ++y) {
    for (int x = 3; x < 6; ++x) put(e.expected, x, y, paint), e.owners[e.expected.pixel(x, y)] = 0;
  }
  e.got = e.expected;
  put(e.got, 3, 3, {}), put(e.got, 7, 4, paint);
  e.pixels = {{3, 3, paint, {}, "missing", 0, -1, {{"z", 1207, 7, 172}}},
              {7, 4, {}, paint, "extra", -1, 0, {}}};
  e.wrong_pixels = 2;
  return e;
}

}  // namespace

CheckResult sample_result() {
  CheckResult r;
  r.plugin = {"library",     "./a\x1b.so", "<script>alert(1)</script>", "says \"&'\" and \x07", "00ff",
              {"triangles"}, "1.0"};
  r.run.program_version = "0.1.0", r.run.level = "default", r.run.corpus_hash = "0123456789abcdef";
  r.run.output = "<b>bold\x1b[31m</b></script>\n", r.run.command = "farop check './a.so'";
  r.summary = {"fail", 50, 4, 2, 0, 1, 120, 2, 0, 3, {}};
  r.rule_fingerprint.table = {{"left", 12, 12}, {"right", 3, 12}};
  Finding missing{"cov.missing",
                  "",
                  Severity::error,
                  "2 pixels of <1> polygon",
                  "Look & see.",
                  2,
                  2,
                  2,
                  {"cov/tri4#17@1"},
                  {triangle()},
                  {},
                  {}};
  Finding crash{"crash.segv",   "", Severity::error, "It crashed.", "", 1, 0, 0, {"smoke/quad#0@1"}, {},
                {"fill()\x01"}, 3u};
  r.findings = {missing, crash};
  r.families = {{"smoke", 1, 1, 0, 0, 0, 0, 0, 1.5, ""}, {"cov", 0, 1, 0, 1, 120, 2, 0, 2.5, ""}};
  r.cases = {{"smoke/empty#0@1", "Nothing.", CaseStatus::passed, "", {}, 10, 0, 0, 0.5},
             {"smoke/quad#0@1", "A square.", CaseStatus::failed, "", {"crash.segv"}, 0, 0, 0, 1},
             {"cov/tri4#17@1", "A triangle.", CaseStatus::failed, "", {"cov.missing"}, 120, 2, 0, 2},
             {"cov/size#0@1", "A frame.", CaseStatus::skipped, "=1+1 \x02 \"too\" large", {}, 0, 0, 0, 0}};
  r.perf = {{"fill", {64, 128, 256}, {1e-4, 2e-4, 4.2e-4}, {5e-5, 1e-4, 2e-4}, 1.02, 0.98, 1.07, 2, 1.9, 2.2},
            {"<b>", {1}, {1}, {}, 0, 0, 0, 0, 0, 0}};
  r.summary.precision = {0.7, 0.5, "within 1", "nearest"};
  r.notes = {"A note."};
  return r;
}

}  // namespace farop::conformance_report
