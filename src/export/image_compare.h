// SPDX-License-Identifier: GPL-3.0-or-later
// Are two pictures the same, and if not, how different? Thresholds are named and meant as in OpenImageIO's
// `idiff`.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace farop {

/// Differences are absolute ones of stored values, 0..1 for integer formats (1/255 = 0.0039 is one step of 8
/// bits). A pixel is over a threshold when any of its channels is.
struct CompareThresholds {
  double fail = 1e-6;                                          ///< a pixel that differs more counts as failed
  double fail_percent = 0;                                     ///< so many per cent of the pixels may fail
  double hard_fail = std::numeric_limits<double>::infinity();  ///< no pixel may differ more than this
  double warn = 1e-6;                                          ///< the same for warnings
  double warn_percent = 0;
  double hard_warn = std::numeric_limits<double>::infinity();
};

enum class CompareVerdict { ok, warn, fail };

struct CompareResult {
  int width = 0, height = 0;
  int channels = 0;
  double max_error = 0;     ///< infinite where one picture has NaN or infinity and the other has not
  int max_x = 0;            ///< column of the first pixel with the largest difference
  int max_row = 0;          ///< its row, counted from the top as picture viewers (and idiff) do
  std::string max_channel;  ///< name of its channel; empty when there is no difference
  double mean_error = 0;    ///< over all values of all channels
  double rms_error = 0;
  double psnr = 0;  ///< peak signal-to-noise ratio, dB; infinite for equal pictures
  std::uint64_t warn_pixels = 0, fail_pixels = 0;
  double difference_scale = 1;  ///< what a difference of 1 is multiplied by in the difference picture
  CompareVerdict verdict = CompareVerdict::ok;
};

/// Compares two picture files. fail when more than fail_percent of the pixels are over `fail` or any is over
/// `hard_fail` or not finite in one picture only; else warn likewise; else ok. (As idiff documents it;
/// idiff 2.4 itself passes over the hard and the warning thresholds as long as no pixel is over `fail`.)
///
/// difference_path  where to write the absolute difference, as write_image() does; empty: nowhere. It is
/// multiplied so
///                  that the largest one becomes white (difference_scale). One channel is shown grey;
///                  channels behind the third (opacity) light up all three colours.
/// Throws Error(ExitStatus::input) when a picture cannot be read or they differ in size or number of
/// channels, and what write_image() throws.
CompareResult compare_images(const std::string& path_a, const std::string& path_b,
                             const CompareThresholds& thresholds, const std::string& difference_path = {});

}  // namespace farop
