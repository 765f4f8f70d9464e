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

/// The header, word by word: magic number, width, height, maximum, one white space, then bytes.
class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path), file_(path, std::ios::binary) {
    if (!file_) fail("cannot be opened", "does the program write it?");
  }

  Framebuffer read() {
    const std::string magic = word();
    if (magic != "P6") {
      fail(fmt::format("begins with '{}', expected P6, a binary PPM", printable(magic, 8)),
           magic == "P3" ? "P3 is the text form: write P6 and bytes" : "");
    }
    Framebuffer picture;
    picture.width = number("width", k_max_resolution);
    picture.height = number("height", k_max_resolution);
    const int maximum = number("maximum", 65535);
    if (maximum != 255) fail(fmt::format("has the maximum {}, expected 255", maximum));
    const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
    const std::size_t expected = row * static_cast<std::size_t>(picture.height);
    expect_bytes(expected);
    picture.rgb.resize(expected);
    for (int y = picture.height - 1; y >= 0; --y) {
      file_.read(reinterpret_cast<char*>(&picture.rgb[3 * picture.pixel(0, y)]),
                 static_cast<std::streamsize>(row));
    }
    if (!file_) fail("cannot be read to its end");
    return picture;
  }

 private:
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

  void expect_bytes(std::size_t expected) {
    const std::streampos here = file_.tellg();
    file_.seekg(0, std::ios::end);
    const auto found = static_cast<std::uint64_t>(file_.tellg() - here);
    file_.seekg(here);
    if (found != expected) {
      fail(fmt::format("has {} bytes behind its header, expected {}: 3 a pixel", found, expected));
    }
  }

  std::string path_;
  std::ifstream file_;
};

}  // namespace

Framebuffer read_ppm(const std::string& path) {
  return Reader(path).read();
}

}  // namespace farop
