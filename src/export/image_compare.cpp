// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/image_compare.h"

#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/diagnostics.h"
#include "core/error.h"
#include "core/math.h"
#include "export/image_buffer_internal.h"
#include "export/image_writer.h"

namespace farop {
namespace {

std::string size_text(const std::string& path, const OIIO::ImageSpec& spec) {
  std::string text = fmt::format("{} has {} x {} pixels", printable(path, 4096), spec.width, spec.height);
  if (spec.x != 0 || spec.y != 0) text += fmt::format(" at {}, {}", spec.x, spec.y);
  return text + fmt::format(" of {} channel{}", spec.nchannels, spec.nchannels == 1 ? "" : "s");
}

void expect_same_size(const std::string& path_a, const OIIO::ImageBuf& a, const std::string& path_b,
                      const OIIO::ImageBuf& b) {
  if (a.roi() == b.roi()) return;
  throw Error(ExitStatus::input,
              fmt::format("pictures differ in size: {}, {}", size_text(path_a, a.spec()),
                          size_text(path_b, b.spec())),
              "only pictures of equal size and number of channels are compared");
}

CompareVerdict verdict_of(const OIIO::ImageBufAlgo::CompareResults& found,
                          const CompareThresholds& thresholds, std::uint64_t pixels) {
  const auto allowed = [pixels](double percent) { return percent / 100 * static_cast<double>(pixels); };
  if (static_cast<double>(found.nfail) > allowed(thresholds.fail_percent) ||
      found.maxerror > thresholds.hard_fail || !std::isfinite(found.maxerror)) {
    return CompareVerdict::fail;
  }
  if (static_cast<double>(found.nwarn) > allowed(thresholds.warn_percent) ||
      found.maxerror > thresholds.hard_warn) {
    return CompareVerdict::warn;
  }
  return CompareVerdict::ok;
}

/// |a - b| times `scale` as a picture, row 0 at the bottom.
Framebuffer difference_picture(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, double scale) {
  const OIIO::ROI roi = a.roi();
  const int channels = roi.nchannels();
  Framebuffer picture;
  picture.width = roi.width(), picture.height = roi.height();
  picture.rgb.resize(3 * static_cast<std::size_t>(roi.npixels()));
  std::vector<float> row_a(static_cast<std::size_t>(roi.width()) * static_cast<std::size_t>(channels)),
      row_b(row_a);
  for (int y = 0; y < picture.height; ++y) {
    OIIO::ROI row = roi;
    row.ybegin = roi.yend - 1 - y, row.yend = row.ybegin + 1;
    a.get_pixels(row, OIIO::TypeDesc::FLOAT, row_a.data());
    b.get_pixels(row, OIIO::TypeDesc::FLOAT, row_b.data());
    for (int x = 0; x < picture.width; ++x) {
      std::uint8_t* rgb = &picture.rgb[3 * picture.pixel(x, y)];
      for (int c = 0; c < channels; ++c) {
        const std::size_t i =
            static_cast<std::size_t>(x) * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c);
        const double difference = scale * std::abs(double{row_a[i]} - double{row_b[i]});
        // A difference that is no number is shown as the largest one.
        const double level = std::isfinite(difference) ? std::min(difference, 1.0) : 1.0;
        const auto byte = static_cast<std::uint8_t>(round_half_up(255 * level));
        if (c < 3 && channels > 1) {
          rgb[c] = byte;
        } else {
          for (int k = 0; k < 3; ++k) rgb[k] = std::max(rgb[k], byte);
        }
      }
    }
  }
  return picture;
}

}  // namespace

CompareResult compare_images(const std::string& path_a, const std::string& path_b,
                             const CompareThresholds& thresholds, const std::string& difference_path) {
  if (!difference_path.empty()) check_image_path(difference_path);
  const OIIO::ImageBuf a = load_image_buffer(path_a);
  const OIIO::ImageBuf b = load_image_buffer(path_b);
  expect_same_size(path_a, a, path_b, b);
  const auto found = OIIO::ImageBufAlgo::compare(a, b, static_cast<float>(thresholds.fail),
                                                 static_cast<float>(thresholds.warn));
  // Not found.error: it is also set where pixels differ.
  if (a.has_error() || b.has_error()) {
    throw Error(ExitStatus::input,
                fmt::format("{}, {}: cannot compare: {}", printable(path_a, 4096), printable(path_b, 4096),
                            one_line(a.has_error() ? a.geterror() : b.geterror(), "no reason is given")));
  }
  CompareResult result;
  const OIIO::ImageSpec& spec = a.spec();
  result.width = spec.width, result.height = spec.height, result.channels = spec.nchannels;
  result.max_error = found.maxerror;
  if (found.maxerror != 0) {
    result.max_x = found.maxx - spec.x, result.max_row = found.maxy - spec.y;
    result.max_channel = spec.channel_name(found.maxc);
  }
  result.mean_error = found.meanerror;
  result.rms_error = found.rms_error;
  result.psnr = found.PSNR;
  result.warn_pixels = found.nwarn, result.fail_pixels = found.nfail;
  result.verdict = verdict_of(found, thresholds, spec.image_pixels());
  if (found.maxerror > 0 && std::isfinite(found.maxerror)) result.difference_scale = 1 / found.maxerror;
  if (!difference_path.empty())
    write_image(difference_path, difference_picture(a, b, result.difference_scale));
  return result;
}

}  // namespace farop
