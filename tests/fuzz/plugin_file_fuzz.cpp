// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the first look at a rasterizer's file: what was accepted is an ELF file whose headers
// lie within it, and what was not comes with words.
#include <elf.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>

#include "plugin/plugin_library.h"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int file = ::memfd_create("plugin_file_fuzz", MFD_CLOEXEC);
  static const std::string path = "/proc/self/fd/" + std::to_string(file);
  require(::ftruncate(file, 0) == 0);
  require(::pwrite(file, data, size, 0) == static_cast<ssize_t>(size));
  const farop::PluginLibrary library = farop::inspect_plugin_file(path);
  if (library.failure != farop::LoadFailure::none) {
    require(!library.message.empty());
    return 0;
  }
  Elf64_Ehdr header;
  require(size >= sizeof header);
  std::memcpy(&header, data, sizeof header);
  require(std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 && header.e_type == ET_DYN);
  require(header.e_phoff <= size);
  require(std::size_t{header.e_phnum} * header.e_phentsize <= size - header.e_phoff);
  return 0;
}
