// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/ppm_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "core/diagnostics.h"
#include "core/error.h"
#include "core/limits.h"

namespace farop {
namespace {

/// The two Netpbm formats that are read.
struct Format {
  std::string_view magic, text_magic, name;
  std::size_t components;  ///< of a pixel
};
constexpr Format k_ppm{"P6", "P3", "a binary PPM", 3}, k_pgm{"P5", "P2", "a binary PGM", 1};

/// The header, word by word: magic number, width, height, maximum, one white space, then the samples: a byte
/// each, two (the higher one first) where the maximum exceeds 255.
class Reader {
 public:
  Reader(const std::string& path, const Format& format)
      : path_(path), file_(path, std::ios::binary), format_(format) {
    if (!file_) fail("cannot be opened", "does the program write it?");
    const std::string magic = word();
    if (magic != format_.magic) {
      fail(fmt::format("begins with '{}', expected {}, {}", printable(magic, 8), format_.magic, format_.name),
           magic == format_.text_magic
               ? fmt::format("{} is the text form: write {} and bytes", magic, format_.magic)
               : "");
    }
    width = number("width", k_max_resolution);
    height = number("height", k_max_resolution);
    maximum = number("maximum", 65535);
    expect_bytes();
  }

  /// Calls use(index, value) for every sample in the order of the result: bottom row first.
  template <class Use>
  void read(const Use& use) {
    std::vector<unsigned char> row(row_samples() * sample_bytes());
    for (int y = height - 1; y >= 0; --y) {
      file_.read(reinterpret_cast<char*>(row.data()), static_cast<std::streamsize>(row.size()));
      const std::size_t first = static_cast<std::size_t>(y) * row_samples();
      for (std::size_t i = 0; i < row_samples(); ++i) {
        const unsigned value = maximum > 255 ? row[2 * i] * 256u + row[2 * i + 1] : row[i];
        // Beyond the maximum there is nothing: as bright, or as far, as it goes.
        use(first + i, std::min(value, static_cast<unsigned>(maximum)));
      }
    }
    if (!file_) fail("cannot be read to its end");
  }

  std::size_t samples() const { return row_samples() * static_cast<std::size_t>(height); }

  int width = 0, height = 0, maximum = 0;

 private:
  std::size_t row_samples() const { return format_.components * static_cast<std::size_t>(width); }
  std::size_t sample_bytes() const { return maximum > 255 ? 2 : 1; }

  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
    throw Error(ExitStatus::input, fmt::format("{}: {}", printable(path_, 4096), what), hint);
  }

  /// The next word and the one white space behind it.
  std::string word() {
    std::string text;
    for (int c = file_.get(); c != EOF; c = file_.get()) {
      if (c == '#') {
        while (c != '\n' && c != '\r' && c != EOF) c = file_.get();
      } else if (c != ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\v' && c != '\f') {
        text += static_cast<char>(c);
        if (text.size() > 16) break;
        continue;
      }
      if (!text.empty()) break;
    }
    return text;
  }

  int number(const char* name, int most) {
    const std::string text = word();
    int value = 0;
    for (const char c : text) {
      if (c < '0' || c > '9') value = -1;
      if (value < 0 || value > most) break;
      value = 10 * value + (c - '0');
    }
    if (text.empty() || value < 1 || value > most) {
      fail(fmt::format("has the {} '{}', expected 1..{}", name, printable(text, 20), most));
    }
    return value;
  }

  void expect_bytes() {
    const std::size_t expected = samples() * sample_bytes();
    const std::streampos here = file_.tellg();
    file_.seekg(0, std::ios::end);
    const auto found = static_cast<std::uint64_t>(file_.tellg() - here);
    file_.seekg(here);
    if (found != expected) {
      fail(fmt::format("has {} bytes behind its header, expected {}: {} a pixel", found, expected,
                       format_.components * sample_bytes()),
           maximum > 255 ? "a maximum above 255 means two bytes a component, the higher one first" : "");
    }
  }

  std::string path_;
  std::ifstream file_;
  const Format& format_;
};

}  // namespace

Framebuffer read_ppm(const std::string& path) {
  Reader reader(path, k_ppm);
  Framebuffer picture;
  picture.width = reader.width, picture.height = reader.height;
  picture.rgb.resize(reader.samples());
  const auto maximum = static_cast<unsigned>(reader.maximum);
  reader.read([&](std::size_t at, unsigned value) {
    picture.rgb[at] = static_cast<std::uint8_t>((2 * 255 * value + maximum) / (2 * maximum));
  });
  return picture;
}

DepthPicture read_depth_pgm(const std::string& path) {
  Reader reader(path, k_pgm);
  DepthPicture picture{reader.width, reader.height, reader.maximum, {}};
  picture.z.resize(reader.samples());
  reader.read([&](std::size_t at, unsigned value) { picture.z[at] = static_cast<std::uint16_t>(value); });
  return picture;
}

}  // namespace farop
