// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/ppm_writer.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>

#include "core/output_file.h"

namespace farop {
namespace {

/// Rows are written in blocks that stay in the cache.
constexpr std::size_t k_ppm_block = std::size_t{1} << 17;

bool is_special_file(const std::string& path) {
  std::error_code ec;
  const std::filesystem::file_type type = std::filesystem::status(path, ec).type();
  using std::filesystem::file_type;
  return type == file_type::fifo || type == file_type::character || type == file_type::block ||
         type == file_type::socket;
}

}  // namespace

bool is_ppm_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return path == "-" || extension == ".ppm" || extension == ".pnm" || is_special_file(path);
}

void write_ppm(const std::string& path, const Framebuffer& picture) {
  OutputFile file(path);
  const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
  std::string block;
  block.reserve(k_ppm_block + row);
  block += fmt::format("P6\n{} {}\n255\n", picture.width, picture.height);
  for (int y = picture.height - 1; y >= 0; --y) {
    block.append(reinterpret_cast<const char*>(&picture.rgb[3 * picture.pixel(0, y)]), row);
    if (block.size() < k_ppm_block && y > 0) continue;
    file.write(block);
    block.clear();
  }
  file.commit();
}

}  // namespace farop
