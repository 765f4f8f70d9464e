// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/plugin_library.h"

#include <dlfcn.h>
#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cfenv>
#include <cstring>

#include "core/diagnostics.h"

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace farop {
namespace {

/// A library of a rasterizer is some kilobytes; with debug symbols and a language's run time some megabytes.
constexpr off_t k_max_library_bytes = off_t{512} << 20;
constexpr std::size_t k_max_name = 64;
constexpr std::size_t k_max_summary = 200;

constexpr std::uint32_t k_known_wishes = FAROP_WANT_TRIANGLES | FAROP_WANT_NORMALS |
                                         FAROP_WANT_EYE_POSITIONS | FAROP_WANT_VERTEX_IDS |
                                         FAROP_WANT_MATERIAL | FAROP_DRAWS_ELSEWHERE;

#if defined(__x86_64__)
constexpr Elf64_Half k_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half k_machine = EM_AARCH64;
#elif defined(__riscv)
constexpr Elf64_Half k_machine = EM_RISCV;
#elif defined(__powerpc64__)
constexpr Elf64_Half k_machine = EM_PPC64;
#elif defined(__s390x__)
constexpr Elf64_Half k_machine = EM_S390;
#else
#error "name this machine's ELF number"
#endif

PluginLibrary failed(LoadFailure failure, std::string message, std::string hint = {}) {
  PluginLibrary library;
  library.failure = failure;
  library.message = std::move(message);
  library.hint = std::move(hint);
  return library;
}

/// "2.0" for 0x20000.
std::string version_text(std::uint32_t version) {
  return fmt::format("{}.{}", version >> 16, version & 0xFFFFu);
}

unsigned float_control() {
#if defined(__SSE__)
  return _mm_getcsr() & 0xFFC0u;  // masks, rounding, flush-to-zero, denormals-are-zero; not the sticky flags
#else
  return static_cast<unsigned>(std::fegetround());
#endif
}

/// Up to its end, limit + 1 at most.
std::size_t length_of(const char* text, std::size_t limit) {
  plugin_text_in_hand = text;
  std::size_t length = 0;
  // Byte by byte: strnlen() may look beyond the limit, and be ended for that.
  while (length <= limit && static_cast<const volatile char*>(text)[length] != '\0') ++length;
  plugin_text_in_hand = nullptr;
  return length;
}

/// Text of a rasterizer, at most `limit` bytes, safe to print; empty when it is NULL.
std::string text_of(const char* text, std::size_t limit) {
  return text == nullptr ? std::string() : printable({text, length_of(text, limit)}, limit);
}

/// Short ids, [a-z0-9_-]+: they are typed on command lines.
bool is_valid_name(const char* name) {
  if (name == nullptr) return false;
  const std::size_t length = length_of(name, k_max_name);
  if (length == 0 || length > k_max_name) return false;
  for (std::size_t i = 0; i < length; ++i) {
    const char c = name[i];
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-')) return false;
  }
  return true;
}

/// A descriptor that closes itself.
struct OpenFile {
  explicit OpenFile(const std::string& path)
      : descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {}
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int descriptor;
};

}  // namespace

const char* volatile plugin_text_in_hand = nullptr;

std::string status_text(farop_status status) {
  switch (status) {
    case FAROP_OK:
      return "done (FAROP_OK)";
    case FAROP_E_MEMORY:
      return "out of memory (FAROP_E_MEMORY)";
    case FAROP_E_UNSUPPORTED:
      return "a request it cannot serve (FAROP_E_UNSUPPORTED)";
    case FAROP_E_INVALID:
      return "it says that the host broke the contract (FAROP_E_INVALID)";
    case FAROP_E_INTERNAL:
      return "an internal failure (FAROP_E_INTERNAL)";
    default:
      return fmt::format("status {}, which is none of FAROP_OK and FAROP_E_*", status);
  }
}

PluginLibrary inspect_plugin_file(const std::string& path) {
  struct stat status {};
  // Asked before opening: opening a device can do things.
  if (::stat(path.c_str(), &status) != 0) {
    return failed(
        LoadFailure::file, fmt::format("cannot be opened: {}", std::strerror(errno)),
        errno == ENOENT ? "check the path; `farop plugins` lists rasterizers that are found by name" : "");
  }
  if (!S_ISREG(status.st_mode)) {
    return failed(LoadFailure::file, S_ISDIR(status.st_mode)
                                         ? "is a folder, expected a shared library (.so)"
                                         : "is no regular file, expected a shared library (.so)");
  }
  if (status.st_size > k_max_library_bytes) {
    return failed(LoadFailure::file,
                  fmt::format("has {} bytes, more than the {} that a shared library may have here",
                              status.st_size, k_max_library_bytes));
  }
  const OpenFile file(path);
  if (file.descriptor < 0) {
    return failed(LoadFailure::file, fmt::format("cannot be opened: {}", std::strerror(errno)));
  }
  Elf64_Ehdr header{};
  const ssize_t got = ::read(file.descriptor, &header, sizeof header);
  const char* const build = "build it as a shared library: cc -shared -fPIC ...";
  if (got < EI_NIDENT || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
    return failed(LoadFailure::file, "is not a shared library (no ELF file)", build);
  }
  if (header.e_ident[EI_CLASS] != ELFCLASS64) {
    return failed(LoadFailure::file, "is a 32-bit file, this farop is a 64-bit program",
                  "build it without -m32");
  }
  if (got < static_cast<ssize_t>(sizeof header)) return failed(LoadFailure::file, "is cut short");
  if (header.e_machine != k_machine) {
    return failed(LoadFailure::file, fmt::format("is built for another machine (ELF machine {}, this is {})",
                                                 header.e_machine, k_machine));
  }
  if (header.e_type != ET_DYN) {
    return failed(LoadFailure::file, "is not a shared library (an executable or an object file)", build);
  }
  const auto bytes = static_cast<std::uint64_t>(status.st_size);
  const std::uint64_t headers_bytes = std::uint64_t{header.e_phnum} * header.e_phentsize;
  if (header.e_phoff > bytes || headers_bytes > bytes - header.e_phoff) {
    return failed(LoadFailure::file, "is cut short: its headers lie behind its end");
  }
  return {};
}

PluginLibrary check_plugin_table(const farop_rasterizer* table) {
  if (table == nullptr) return failed(LoadFailure::refused, "refuses to be loaded");
  if (table->abi_version >> 16 != FAROP_ABI_MAJOR) {
    return failed(
        LoadFailure::version,
        fmt::format("built for rasterizer interface {}, this farop speaks {}.x",
                    version_text(table->abi_version), FAROP_ABI_MAJOR),
        "rebuild it against the farop/rasterizer.h of this installation (`farop plugins --abi` prints its "
        "folder)");
  }
  constexpr std::size_t first_version_bytes = offsetof(farop_rasterizer, end_frame) + sizeof table->end_frame;
  if (table->struct_size < first_version_bytes) {
    return failed(LoadFailure::contract,
                  fmt::format("its table has struct_size {}, version 1.0 has {}", table->struct_size,
                              first_version_bytes),
                  "set struct_size to sizeof(farop_rasterizer)");
  }
  if (table->begin_frame == nullptr || table->polygon == nullptr || table->end_frame == nullptr) {
    return failed(LoadFailure::contract,
                  fmt::format("its table has no {}", table->begin_frame == nullptr ? "begin_frame"
                                                     : table->polygon == nullptr   ? "polygon"
                                                                                   : "end_frame"),
                  "begin_frame, polygon and end_frame are required");
  }
  if ((table->wants & ~k_known_wishes) != 0) {
    return failed(LoadFailure::contract,
                  fmt::format("it wants something that this farop does not know (bits {:#x})",
                              table->wants & ~k_known_wishes),
                  "set wants to FAROP_WANT_* words of the farop/rasterizer.h of this installation");
  }
  if (!is_valid_name(table->name)) {
    return failed(LoadFailure::contract,
                  fmt::format("its name '{}' is not 1 to {} of the characters a-z 0-9 _ -",
                              text_of(table->name, 40), k_max_name));
  }
  PluginLibrary library;
  library.table = table;
  library.name = table->name;
  library.summary = text_of(table->summary, k_max_summary);
  return library;
}

PluginLibrary open_plugin(const std::string& path, HostServices& services) {
  const unsigned float_before = float_control();
  void* const handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* reason = ::dlerror();
    return failed(
        LoadFailure::file,
        fmt::format("cannot be loaded: {}", printable(reason == nullptr ? "no reason given" : reason, 400)));
  }
  void* const symbol = ::dlsym(handle, FAROP_ENTRY_SYMBOL);
  if (symbol == nullptr) {
    return failed(LoadFailure::symbol, "does not export farop_rasterizer_entry",
                  "is the function there, extern \"C\" in C++, and not hidden (FAROP_EXPORT)?");
  }
  const auto entry = reinterpret_cast<decltype(&farop_rasterizer_entry)>(symbol);
  PluginLibrary library = check_plugin_table(entry(services.host()));
  if (library.failure == LoadFailure::refused) {
    const std::string words = services.last_words();
    if (!words.empty()) library.message += ": " + words;
  }
  if (float_control() != float_before) {
    library.warning =
        "loading it changed the rounding mode or switched denormal numbers off: do not link it with "
        "-ffast-math";
#if defined(__SSE__)
    _mm_setcsr((_mm_getcsr() & ~0xFFC0u) | float_before);
#endif
  }
  return library;
}

}  // namespace farop
