// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/image_writer.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "core/diagnostics.h"
#include "core/error.h"
#include "core/output_file.h"
#include "export/image_buffer_internal.h"
#include "export/ppm_writer.h"

namespace farop {
namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

constexpr const char* k_image_hint = "there are .ppm .png .exr .tif .jpg .bmp .tga .webp .hdr .gif .dpx";
constexpr const char* k_depth_hint = "depths are floating-point numbers: use .exr or .tif";

/// Lower case, without the dot; empty where there is none.
std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

/// The formats, by OpenImageIO's names, that the tests find right from a single pixel up. All are encoded in
/// memory: encoders that open the file themselves do not all notice a full disk (PNG), or end the whole
/// program there (JPEG). Of OpenImageIO 2.4's others, small pictures in JPEG 2000 cannot be read again, in
/// IFF they come back black, both without an error; SGI headers hold stray memory.
constexpr std::array<std::string_view, 10> k_formats{"png",   "openexr", "tiff", "jpeg", "bmp",
                                                     "targa", "webp",    "hdr",  "gif",  "dpx"};

/// The encoder for an extension, or null.
std::unique_ptr<ImageOutput> encoder_for(const std::string& extension) {
  if (extension.empty()) return nullptr;
  std::unique_ptr<ImageOutput> encoder = ImageOutput::create("x." + extension);
  if (encoder == nullptr) {
    OIIO::geterror();  // fetched, or OpenImageIO prints it when the program ends
    return nullptr;
  }
  const bool known = std::ranges::find(k_formats, encoder->format_name()) != k_formats.end();
  return known ? std::move(encoder) : nullptr;
}

std::unique_ptr<ImageOutput> require_encoder(const std::string& path) {
  const std::string extension = extension_of(path);
  std::unique_ptr<ImageOutput> encoder = encoder_for(extension);
  if (encoder != nullptr) return encoder;
  const std::string found = extension.empty() ? "a file name without an extension"
                                              : fmt::format("the extension '.{}'", printable(extension));
  throw Error(
      ExitStatus::usage,
      fmt::format("{}: {} does not name a picture format that can be written", printable(path, 4096), found),
      k_image_hint);
}

/// Pixels in memory as OpenImageIO takes them, top row first: the rows of a framebuffer run upwards.
struct Rows {
  const void* top = nullptr;
  OIIO::stride_t step = 0;  ///< bytes from a row to the one below it
};

template <typename Component>
Rows rows_of(const std::vector<Component>& components, int height) {
  const std::size_t row = components.size() / static_cast<std::size_t>(height);
  return {components.data() + components.size() - row, -static_cast<OIIO::stride_t>(row * sizeof(Component))};
}

/// The bytes of the picture file.
std::vector<unsigned char> encode(ImageOutput& encoder, const std::string& path, ImageSpec spec,
                                  const TypeDesc& type, const Rows& rows) {
  const std::string_view format = encoder.format_name();
  if (format == "openexr" || format == "tiff")
    spec.attribute("DateTime", "");                                   // else the time of day is written
  if (format == "jpeg") spec.attribute("jpeg:subsampling", "4:4:4");  // a pixel keeps its own colour
  OIIO::Filesystem::IOVecOutput bytes;
  // The file name is for messages only.
  const bool done = encoder.set_ioproxy(&bytes) && encoder.open(path, spec) &&
                    encoder.write_image(type, rows.top, OIIO::AutoStride, rows.step) && encoder.close();
  if (!done) {
    throw Error(
        ExitStatus::usage,
        fmt::format("{}: a picture of {} x {} pixels cannot be written as {}: {}", printable(path, 4096),
                    spec.width, spec.height, format, one_line(encoder.geterror(), "no reason is given")),
        k_image_hint);
  }
  return std::move(bytes.buffer());
}

void write_encoded(const std::string& path, ImageOutput& encoder, const ImageSpec& spec, const TypeDesc& type,
                   const Rows& rows) {
  OutputFile file(path);  // opened first: a folder that cannot be written to is found before the work
  const std::vector<unsigned char> bytes = encode(encoder, path, spec, type, rows);
  file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  file.commit();
}

}  // namespace

void check_image_path(const std::string& path) {
  if (!is_ppm_path(path)) require_encoder(path);
}

void write_image(const std::string& path, const Framebuffer& picture) {
  if (is_ppm_path(path)) return write_ppm(path, picture);
  const std::unique_ptr<ImageOutput> encoder = require_encoder(path);
  const std::string_view format = encoder->format_name();
  const bool floats = format == "openexr" || format == "hdr";
  const ImageSpec spec(picture.width, picture.height, 3, floats ? TypeDesc::FLOAT : TypeDesc::UINT8);
  write_encoded(path, *encoder, spec, TypeDesc::UINT8, rows_of(picture.rgb, picture.height));
}

void check_depth_path(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == "exr" || extension == "tif" || extension == "tiff") return;
  throw Error(ExitStatus::usage,
              fmt::format("{}: a depth picture is an EXR or a TIFF", printable(path, 4096)), k_depth_hint);
}

void write_depth(const std::string& path, const Framebuffer& picture) {
  check_depth_path(path);
  ImageSpec spec(picture.width, picture.height, 1, TypeDesc::FLOAT);
  spec.channelnames = {"Z"};
  spec.z_channel = 0;
  write_encoded(path, *require_encoder(path), spec, TypeDesc::FLOAT, rows_of(picture.depth, picture.height));
}

}  // namespace farop
