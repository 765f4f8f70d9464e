// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <memory>

#include "command_line.h"
#include "core/output_file.h"
#include "picture_library.h"
#include "session.h"

namespace farop::app {
namespace {

struct CompareOptions {
  std::vector<std::string> pictures;
  std::string output;
  CompareThresholds thresholds;
};

std::string report_text(const CompareResult& r) {
  const double pixels = static_cast<double>(r.width) * r.height;
  const auto share = [&](std::uint64_t n) { return 100.0 * static_cast<double>(n) / pixels; };
  std::string out = fmt::format("size         {} x {}, {} channels\n", r.width, r.height, r.channels);
  out += fmt::format("max error    {:.6g}", r.max_error);
  if (r.max_error > 0)
    out += fmt::format("  at column {}, row {} from the top, channel {}", r.max_x, r.max_row, r.max_channel);
  out += fmt::format("\nmean error   {:.6g}\nRMS error    {:.6g}\n", r.mean_error, r.rms_error);
  out += std::isinf(r.psnr) ? "PSNR         infinite\n" : fmt::format("PSNR         {:.4g} dB\n", r.psnr);
  out += fmt::format("over --warn  {} pixels ({:.4g} %)\nover --fail  {} pixels ({:.4g} %)\n", r.warn_pixels,
                     share(r.warn_pixels), r.fail_pixels, share(r.fail_pixels));
  const char* verdict = r.verdict == CompareVerdict::ok     ? "PASS"
                        : r.verdict == CompareVerdict::warn ? "WARNING"
                                                            : "FAILURE";
  return out + fmt::format("{}\n", verdict);
}

void run(Session& session, const CompareOptions& options) {
  if (!options.output.empty()) check_picture_path(options.output);
  const CompareResult result = picture_library().compare_images(options.pictures[0], options.pictures[1],
                                                                options.thresholds, options.output);
  if (!options.output.empty()) {
    session.report.outputs.push_back(options.output);
    session.console.summary("{}: differences, {:.4g} times as large", options.output,
                            result.difference_scale);
  }
  OutputFile file("-");
  file.write(report_text(result));
  file.commit();
  if (result.verdict == CompareVerdict::fail) throw Error(ExitStatus::input, "");
}

}  // namespace

void add_compare(CommandLine& line) {
  const auto options = std::make_shared<CompareOptions>();
  CLI::App& command = line.add_command(
      "compare", "two pictures: how different, and where; 1 when it fails",
      {{"farop compare mine.ppm theirs.ppm -o difference.png", "numbers, and a picture of the differences"},
       {"farop compare mine.ppm theirs.ppm --fail 0.004 --failpercent 0.1",
        "one step of 8 bits allowed, more in 0.1 % of the pixels"}},
      [options](Session& session) { run(session, *options); });
  command.add_option("pictures", options->pictures, "the two pictures")
      ->required()
      ->expected(2)
      ->type_name("A B")
      ->group("Input");
  add_output_option(command, options->output, "picture of the differences, scaled to be seen");
  const auto threshold = [&](const char* name, double& value, const char* help, const char* type) {
    command.add_option(name, value, help)
        ->check(CLI::NonNegativeNumber)
        ->type_name(type)
        ->group("Comparison");
  };
  CompareThresholds& t = options->thresholds;
  threshold("--fail", t.fail, "difference that makes a pixel fail, 0..1 [1e-6]", "V");
  threshold("--failpercent", t.fail_percent, "so many per cent of the pixels may fail [0]", "P");
  threshold("--hardfail", t.hard_fail, "no pixel may differ more than this [no limit]", "V");
  threshold("--warn", t.warn, "difference that makes a pixel warn [1e-6]", "V");
  threshold("--warnpercent", t.warn_percent, "so many per cent of the pixels may warn [0]", "P");
  line.add_report_options(command);
}

}  // namespace farop::app
