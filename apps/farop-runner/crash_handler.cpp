// SPDX-License-Identifier: GPL-3.0-or-later
#include "crash_handler.h"

#include <cxxabi.h>
#include <elf.h>
#include <execinfo.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "plugin/plugin_library.h"

namespace farop::isolate {

KnownMemories g_known;

namespace {

constexpr std::array k_signals = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS, SIGXCPU};
constexpr std::size_t k_stack_bytes = 256 * 1024;
constexpr std::uintptr_t k_stack_gap = 1 << 20;  // what the kernel keeps free below a growing stack

struct Symbol {
  std::uint64_t value = 0, size = 0;
  std::string name;
};
struct Module {
  std::uintptr_t begin = 0, end = 0, base = 0;
  bool rasterizer = false;
  std::array<char, 48> name{};
};

BlackBox* g_box = nullptr;
std::uint64_t g_memory_bytes = 0;
std::uintptr_t g_stack_top = 0;
std::vector<Symbol> g_symbols;
std::array<Module, 48> g_modules;
std::size_t g_module_count = 0;
std::array<struct sigaction, k_signals.size()> g_handlers;
sigset_t g_mask;

void put_text(char* to, std::size_t& at, std::size_t limit, std::string_view text) {
  for (const char c : text) {
    if (at + 1 < limit) to[at++] = c;
  }
  to[at] = '\0';
}

void put_hex(char* to, std::size_t& at, std::size_t limit, std::uint64_t value) {
  std::array<char, 16> digits{};
  std::size_t count = 0;
  do {
    digits[count++] = "0123456789abcdef"[value % 16];
    value /= 16;
  } while (value != 0);
  put_text(to, at, limit, "0x");
  while (count > 0) put_text(to, at, limit, {&digits[--count], 1});
}

const Module* module_of(std::uintptr_t address) {
  for (std::size_t i = 0; i < g_module_count; ++i) {
    if (address >= g_modules[i].begin && address < g_modules[i].end) return &g_modules[i];
  }
  return nullptr;
}

/// "fill_row+0x1c", "libc.so.6+0x9a3fc", "0x7f..." for code that belongs to nobody.
void put_place(char* to, std::uintptr_t address) {
  std::size_t at = 0;
  const Module* module = module_of(address);
  if (module == nullptr) return put_hex(to, at, k_trace_text, address);
  const std::uint64_t offset = address - module->base;
  if (module->rasterizer) {
    const auto next = std::upper_bound(g_symbols.begin(), g_symbols.end(), offset,
                                       [](std::uint64_t value, const Symbol& s) { return value < s.value; });
    if (next != g_symbols.begin() && offset < (next - 1)->value + (next - 1)->size) {
      put_text(to, at, k_trace_text - 16, (next - 1)->name);
      put_text(to, at, k_trace_text, "+");
      return put_hex(to, at, k_trace_text, offset - (next - 1)->value);
    }
  }
  put_text(to, at, k_trace_text - 20, module->rasterizer ? "rasterizer" : module->name.data());
  put_text(to, at, k_trace_text, "+");
  put_hex(to, at, k_trace_text, offset);
}

struct Registers {
  std::uintptr_t counter = 0, stack = 0;
  std::uint32_t writing = 2;
};

Registers registers_of(const ucontext_t& context) {
  Registers r;
#if defined(__x86_64__)
  r.counter = static_cast<std::uintptr_t>(context.uc_mcontext.gregs[REG_RIP]);
  r.stack = static_cast<std::uintptr_t>(context.uc_mcontext.gregs[REG_RSP]);
  if (context.uc_mcontext.gregs[REG_TRAPNO] == 14) {  // page fault
    const auto error = context.uc_mcontext.gregs[REG_ERR];
    r.writing = (error & 16) != 0 ? 3 : (error & 2) != 0 ? 1 : 0;
  }
#elif defined(__aarch64__)
  r.counter = context.uc_mcontext.pc;
  r.stack = context.uc_mcontext.sp;
#endif
  return r;
}

bool in_reserve(const KnownMemory& memory, std::uintptr_t address) {
  return memory.first != 0 && address >= memory.first && address < memory.end;
}

void look_up(std::uintptr_t address, std::uintptr_t stack) {
  rlimit limit{};
  ::getrlimit(RLIMIT_STACK, &limit);
  const std::uintptr_t reach = limit.rlim_cur == RLIM_INFINITY ? std::uintptr_t{1} << 30 : limit.rlim_cur;
  const bool at_pointer = address + 4096 > stack && address < stack + 256;
  const bool main_stack = address < g_stack_top && address > g_stack_top - reach - 2 * k_stack_gap &&
                          address < g_stack_top - reach + 4 * k_stack_gap;
  if (main_stack || (at_pointer && address < g_stack_top && module_of(address) == nullptr)) {
    g_box->region = Region::stack;
    return;
  }
  // Its name may be read up to some hundred bytes.
  const auto text = reinterpret_cast<std::uintptr_t>(plugin_text_in_hand);
  if (text != 0 && address >= text && address - text < 1024) {
    g_box->region = Region::text;
    return;
  }
  const auto signed_distance = [](std::uintptr_t to, std::uintptr_t from) {
    return static_cast<std::int64_t>(to - from);
  };
  const auto& [frame, old_frames, chunks] = g_known;
  if (in_reserve(frame, address)) {
    g_box->offset = signed_distance(address, frame.begin);
    g_box->region = g_box->offset < 0                                          ? Region::before_frame
                    : static_cast<std::uint64_t>(g_box->offset) >= frame.bytes ? Region::after_frame
                                                                               : Region::frame;
    return;
  }
  for (const KnownMemory& old : old_frames) {
    if (!in_reserve(old, address)) continue;
    g_box->offset = signed_distance(address, old.begin);
    g_box->region = Region::old_frame;
    return;
  }
  for (const KnownMemory& chunk : chunks) {
    if (!in_reserve(chunk, address)) continue;
    g_box->offset = signed_distance(address, chunk.begin + chunk.bytes);
    g_box->region = g_box->offset >= 0 ? Region::after_input : chunk.live ? Region::input : Region::old_input;
    return;
  }
}

int note_module(dl_phdr_info* info, std::size_t, void* path) {
  if (g_module_count == g_modules.size()) return 1;
  Module& module = g_modules[g_module_count];
  const std::string_view name = info->dlpi_name == nullptr ? "" : info->dlpi_name;
  module.base = info->dlpi_addr;
  module.begin = ~std::uintptr_t{0}, module.end = 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    if (info->dlpi_phdr[i].p_type != PT_LOAD) continue;
    const std::uintptr_t begin = info->dlpi_addr + info->dlpi_phdr[i].p_vaddr;
    module.begin = std::min(module.begin, begin);
    module.end = std::max<std::uintptr_t>(module.end, begin + info->dlpi_phdr[i].p_memsz);
  }
  module.rasterizer = path != nullptr && name == static_cast<const char*>(path);
  std::size_t at = 0;
  put_text(module.name.data(), at, module.name.size(),
           name.empty() ? "farop-runner" : name.substr(name.find_last_of('/') + 1));
  ++g_module_count;
  return 0;
}

void on_crash(int signal, siginfo_t* info, void* context) {
  BlackBox& box = *g_box;
  if (box.signal == 0) {
    box.signal = static_cast<std::uint32_t>(signal);
    box.code = info->si_code;
    const Registers r = registers_of(*static_cast<const ucontext_t*>(context));
    box.address = reinterpret_cast<std::uintptr_t>(info->si_addr);
    if (signal == SIGSYS) box.address = static_cast<std::uint64_t>(info->si_syscall);
    box.program_counter = r.counter, box.stack_pointer = r.stack, box.writing = r.writing;
    box.memory_refused = memory_is_refused() ? 1 : 0;
    box.other_thread = ::syscall(SYS_gettid) != ::getpid() ? 1 : 0;
    if (signal == SIGSEGV || signal == SIGBUS) look_up(box.address, r.stack);
    // From here on things may go wrong; the essential is written.
    if (g_module_count == 0) ::dl_iterate_phdr(note_module, nullptr);
    put_place(box.trace[0], r.counter);
    box.trace_count = 1;
    if (box.region != Region::stack) {
      std::array<void*, k_max_trace + 8> addresses{};
      const int found = ::backtrace(addresses.data(), static_cast<int>(addresses.size()));
      bool seen = false;
      for (int i = 0; i < found && box.trace_count < k_max_trace; ++i) {
        const auto address = reinterpret_cast<std::uintptr_t>(addresses[static_cast<std::size_t>(i)]);
        // Our own functions at the bottom of the stack are of no interest.
        if (seen && std::strncmp(module_of(address) == nullptr ? "" : module_of(address)->name.data(),
                                 "farop-runner", 12) == 0) {
          break;
        }
        if (seen) put_place(box.trace[box.trace_count++], address - 1);  // within the call
        seen = seen || address == r.counter;
      }
    }
  }
  ::signal(signal, SIG_DFL);
  ::syscall(SYS_tgkill, ::getpid(), ::syscall(SYS_gettid), signal);
}

[[noreturn]] void on_terminate() {
  if (const std::type_info* type = abi::__cxa_current_exception_type(); type != nullptr && g_box != nullptr) {
    std::size_t at = 0;
    char* readable = abi::__cxa_demangle(type->name(), nullptr, nullptr, nullptr);
    put_text(g_box->thrown, at, sizeof g_box->thrown, readable == nullptr ? type->name() : readable);
  }
  std::abort();
}

}  // namespace

bool memory_is_refused() {
  if (g_memory_bytes == 0) return false;
  const std::size_t probe = std::max<std::uint64_t>(g_memory_bytes / 16, 4096);
  void* const room = ::mmap(nullptr, probe, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) return true;
  ::munmap(room, probe);
  return false;
}

void die_of_thread_exit() {
  std::size_t at = 0;
  put_text(g_box->thrown, at, sizeof g_box->thrown, k_thread_exit);
  std::abort();
}

void install_crash_handler(BlackBox* box, std::uint64_t memory_bytes) {
  g_box = box;
  g_memory_bytes = memory_bytes;
  int here = 0;
  g_stack_top = (reinterpret_cast<std::uintptr_t>(&here) | 0xFFFF) + 1;
  void* stack =
      ::mmap(nullptr, k_stack_bytes + 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (stack != MAP_FAILED) {
    ::mprotect(stack, 4096, PROT_NONE);
    stack_t other{};
    other.ss_sp = static_cast<char*>(stack) + 4096;
    other.ss_size = k_stack_bytes;
    ::sigaltstack(&other, nullptr);
  }
  std::array<void*, 2> first{};
  ::backtrace(first.data(), 2);  // loads what it needs now
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  ::sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < k_signals.size(); ++i) {
    ::sigaction(k_signals[i], &action, nullptr);
    ::sigaction(k_signals[i], nullptr, &g_handlers[i]);
  }
  std::set_terminate(on_terminate);
  ::sigemptyset(&g_mask);
  ::sigprocmask(SIG_SETMASK, &g_mask, nullptr);
}

std::uint32_t restore_signals() {
  std::uint32_t warnings = 0;
  for (std::size_t i = 0; i < k_signals.size(); ++i) {
    struct sigaction now {};
    ::sigaction(k_signals[i], nullptr, &now);
    if (now.sa_sigaction == g_handlers[i].sa_sigaction) continue;
    warnings |= k_changed_handler;
    ::sigaction(k_signals[i], &g_handlers[i], nullptr);
  }
  sigset_t before{};
  ::sigprocmask(SIG_SETMASK, &g_mask, &before);
  for (int signal = 1; signal < 32; ++signal) {
    if (::sigismember(&before, signal) == 1) warnings |= k_changed_mask;
  }
  return warnings;
}

void read_symbols(int library_fd) {
  struct stat status {};
  if (::fstat(library_fd, &status) != 0 || status.st_size < static_cast<off_t>(sizeof(Elf64_Ehdr))) return;
  const auto bytes = static_cast<std::uint64_t>(status.st_size);
  void* const memory = ::mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE, library_fd, 0);
  if (memory == MAP_FAILED) return;
  const char* const file = static_cast<const char*>(memory);
  const auto fits = [&](std::uint64_t at, std::uint64_t size) { return at <= bytes && size <= bytes - at; };
  Elf64_Ehdr header{};
  std::memcpy(&header, file, sizeof header);
  const auto section = [&](std::uint64_t number, Elf64_Shdr& out) {
    const std::uint64_t at = header.e_shoff + number * sizeof out;
    if (number >= header.e_shnum || header.e_shoff > bytes || !fits(at, sizeof out)) return false;
    std::memcpy(&out, file + at, sizeof out);
    return fits(out.sh_offset, out.sh_size);
  };
  constexpr std::size_t most = 100000;
  for (std::uint64_t i = 0; i < header.e_shnum; ++i) {
    Elf64_Shdr table{}, names{};
    if (!section(i, table) || (table.sh_type != SHT_SYMTAB && table.sh_type != SHT_DYNSYM)) continue;
    if (!section(table.sh_link, names)) continue;
    for (std::uint64_t at = 0; at + sizeof(Elf64_Sym) <= table.sh_size && g_symbols.size() < most;
         at += sizeof(Elf64_Sym)) {
      Elf64_Sym symbol{};
      std::memcpy(&symbol, file + table.sh_offset + at, sizeof symbol);
      if (ELF64_ST_TYPE(symbol.st_info) != STT_FUNC || symbol.st_shndx == SHN_UNDEF ||
          symbol.st_name >= names.sh_size) {
        continue;
      }
      const char* const name = file + names.sh_offset + symbol.st_name;
      const std::string text(name,
                             ::strnlen(name, std::min<std::uint64_t>(200, names.sh_size - symbol.st_name)));
      int failed = 0;
      char* const readable = abi::__cxa_demangle(text.c_str(), nullptr, nullptr, &failed);
      g_symbols.push_back({symbol.st_value, symbol.st_size, readable == nullptr ? text : readable});
      std::free(readable);
    }
  }
  ::munmap(memory, bytes);
  std::stable_sort(g_symbols.begin(), g_symbols.end(),
                   [](const Symbol& a, const Symbol& b) { return a.value < b.value; });
}

void note_modules(const std::string& path) {
  g_module_count = 0;
  std::string name = path;
  ::dl_iterate_phdr(note_module, name.data());
}

}  // namespace farop::isolate
