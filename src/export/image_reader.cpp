// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/image_reader.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/diagnostics.h"
#include "core/error.h"
#include "core/limits.h"
#include "export/image_buffer_internal.h"

namespace farop {
namespace {

constexpr const char* k_damaged = "it is cut short or damaged";

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ExitStatus::input,
              fmt::format("{}: cannot read the picture: {}", printable(path, 4096), reason));
}

}  // namespace

std::string one_line(const std::string& message, const std::string& otherwise) {
  const std::size_t last = message.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return otherwise;
  std::string text = message.substr(0, last + 1);
  std::ranges::replace(text, '\n', ' ');
  return printable(text, 400);
}

// Reads by ImageInput, not by ImageBuf's own cache: that would not notice a file that was replaced meanwhile.
OIIO::ImageBuf load_image_buffer(const std::string& path) {
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
  if (input == nullptr) fail(path, one_line(OIIO::geterror(), "it is of no known format"));
  const OIIO::ImageSpec spec = input->spec();
  if (spec.width > k_max_resolution || spec.height > k_max_resolution || spec.depth > 1) {
    fail(path, fmt::format("it has {} x {} x {} pixels, at most {} x {} are taken", spec.width, spec.height,
                           spec.depth, k_max_resolution, k_max_resolution));
  }
  if (spec.deep) fail(path, "its pixels have several depths, expected a flat picture");
  // Memory that is not initialised is not used either: a small file that announces a huge picture fails while
  // reading.
  OIIO::ImageBuf buffer(spec, OIIO::InitializePixels::No);
  if (!input->read_image(0, 0, 0, spec.nchannels, spec.format, buffer.localpixels())) {
    fail(path, one_line(input->geterror(), k_damaged));
  }
  return buffer;
}

Image read_image(const std::string& path) {
  const OIIO::ImageBuf buffer = load_image_buffer(path);
  Image image;
  image.width = buffer.spec().width;
  image.height = buffer.spec().height;
  image.channels = buffer.spec().channelnames;
  image.values.resize(buffer.spec().image_pixels() * image.channels.size());
  if (!buffer.get_pixels(buffer.roi(), OIIO::TypeDesc::FLOAT, image.values.data())) {
    fail(path, one_line(buffer.geterror(), k_damaged));
  }
  return image;
}

}  // namespace farop
