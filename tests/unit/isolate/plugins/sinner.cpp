// SPDX-License-Identifier: GPL-3.0-or-later
// Draws one pixel per corner, and on polygon 2 of the frame that the option "frame" names (0) does what the
// option "sin" says. "sinner-load" does it while it is loaded.
#include <farop/rasterizer.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace {

const farop_host* g_host;
const farop_frame* g_frame;
farop_frame g_copy;
farop_frame g_first;  // of frame 0
const farop_vertex* g_kept;
volatile int g_sink;
volatile int* volatile g_null;
volatile int g_zero;

std::string option(const char* key) {
  const char* value = g_host->option(g_host, key);
  return value == nullptr ? "" : value;
}

__attribute__((noinline)) int deep(volatile char* above) {
  volatile char here[4096];
  here[0] = above == nullptr ? 0 : above[0];
  return deep(here) + here[0];
}

void* idle(void*) {
  return nullptr;
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-result"

farop_status sin_of(const farop_polygon* p) {
  const std::string sin = option("sin");
  const farop_frame& f = g_copy;
  std::uint8_t* const end = f.pixels + f.row_bytes * (f.height - 1) + 3 * f.width;
  if (sin == "segv") *g_null = 1;
  if (sin == "read-null") g_sink = *g_null;
  if (sin == "wild") *reinterpret_cast<volatile int*>(0x123456789000) = 1;
  if (sin == "fpe") g_sink = 100 / g_zero;
  if (sin == "ill") __builtin_trap();
  if (sin == "abort") {
    std::fputs("sinner: about to abort\n", stderr);
    std::abort();
  }
  if (sin == "stack") g_sink = deep(nullptr);
  if (sin == "exit") std::exit(0);
  if (sin == "_exit") _exit(7);
  if (sin == "pthread_exit") pthread_exit(nullptr);
  if (sin == "throw") throw std::runtime_error("thrown");
  if (sin == "loop") {
    for (;;) g_sink = g_sink + 1;
  }
  if (sin == "pause") {
    for (;;) ::pause();
  }
  if (sin == "stop") ::raise(SIGSTOP);
  if (sin == "kill-self") ::kill(::getpid(), SIGKILL);
  if (sin == "status") {
    g_host->log(g_host, FAROP_LOG_ERROR, "sinner: told to fail");
    return FAROP_E_UNSUPPORTED;
  }
  if (sin == "before") f.pixels[-3] = static_cast<std::uint8_t>(~f.pixels[-3]);
  if (sin == "after") end[f.row_bytes] = static_cast<std::uint8_t>(~end[f.row_bytes]);
  if (sin == "stride") {
    for (int i = 0; i < 4; ++i)
      f.pixels[3 * f.width + i] = static_cast<std::uint8_t>(~f.pixels[3 * f.width + i]);
  }
  if (sin == "far") end[200000] = 1;
  if (sin == "input") const_cast<farop_vertex*>(p->vertices)[0].x = 0;
  if (sin == "read-beyond") {
    for (int i = 0; i < 100000; ++i) g_sink = g_sink + p->vertices[i].x;
  }
  if (sin == "read-one-beyond") g_sink = p->vertices[p->vertex_count].x;
  if (sin == "old-input-soon") g_sink = g_kept->x;
  if (sin == "old-frame") g_first.pixels[0] = 1;
  if (sin == "old-input") g_sink = g_kept->x;
  if (sin == "fork") {
    if (::fork() >= 0) _exit(0);
  }
  if (sin == "thread") {
    pthread_t thread{};
    if (pthread_create(&thread, nullptr, idle, nullptr) == 0) pthread_join(thread, nullptr);
  }
  if (sin == "exec") ::execl("/bin/true", "true", nullptr);
  if (sin == "socket") ::socket(AF_INET, SOCK_STREAM, 0);
  if (sin == "ptrace") ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  if (sin == "write-file") ::open("/tmp/farop-sinner", O_CREAT | O_WRONLY, 0600);
  if (sin == "code") {
    void* page =
        ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (page != MAP_FAILED) _exit(50);
  }
  if (sin == "kill-parent") ::kill(::getppid(), SIGUSR1);
  if (sin == "memory") {
    for (;;) {
      char* block = static_cast<char*>(std::malloc(1 << 20));
      std::memset(block, 1, 1 << 20);
    }
  }
  if (sin == "print") {
    const std::string line(4096, 'x');
    for (int i = 0; i < 4096; ++i) std::fwrite(line.data(), 1, line.size(), stdout);
  }
  if (sin == "close") {
    for (int fd = 0; fd < 64; ++fd) ::close(fd);
  }
  if (sin == "forge") {
    char message[4096] = {};
    iovec part{message, sizeof message};
    msghdr header{};
    header.msg_iov = &part, header.msg_iovlen = 1;
    for (int fd = 3; fd < 16; ++fd) ::sendmsg(fd, &header, MSG_DONTWAIT);
  }
  if (sin == "write-control") ::write(3, "done", 4);
  if (sin == "unmap")
    ::munmap(reinterpret_cast<void*>(reinterpret_cast<std::uintptr_t>(f.pixels) & ~4095ul), 1 << 16);
  if (sin == "float") {
#if defined(__x86_64__)
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
  }
  if (sin == "handler") {
    ::signal(SIGSEGV, SIG_IGN);
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, nullptr);
  }
  if (sin == "log-forever") {
    for (;;) g_host->log(g_host, FAROP_LOG_INFO, "again");
  }
  if (sin == "print-forever") {
    for (;;) std::puts("again");
  }
  if (sin == "log") {
    for (int i = 0; i < 10000; ++i)
      g_host->log(g_host, FAROP_LOG_INFO, "a line of words that is not needed by anybody");
  }
  if (sin == "call") ::syscall(std::atol(option("number").c_str()), -1L, -1L, -1L, -1L, -1L, -1L);
  if (sin == "every-call") {
    const std::string skipped = " " + option("skip") + " ";
    for (int n = 0; n < 520; ++n) {
      if (skipped.find(" " + std::to_string(n) + " ") != std::string::npos) continue;
      errno = 0;
      const long result = ::syscall(n, -1L, -1L, -1L, -1L, -1L, -1L);
      std::printf("%d %d\n", n, result == -1 ? errno : 0);
    }
    std::fflush(stdout);
  }
  // What a wall should stop, told by the exit status when it did not.
  if (sin == "read-file") {
    if (::open("/etc/passwd", O_RDONLY) >= 0) _exit(51);
  }
  if (sin == "much-memory") {
    void* much = ::mmap(nullptr, 300 << 20, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (much != MAP_FAILED) _exit(52);
  }
  if (sin == "signal-outside") {
    if (::kill(std::atoi(option("victim").c_str()), 0) == 0) _exit(53);
  }
  if (sin == "leave-child") {
    if (::fork() == 0) {
      ::setsid();
      if (::fork() == 0) {
        for (int fd = 0; fd < 64; ++fd) ::close(fd);
        for (int i = 0; i < 600; ++i) ::sleep(1);
      }
      _exit(0);
    }
  }
  return FAROP_OK;
}

#pragma GCC diagnostic pop

farop_status create(const farop_host*, void**) {
  return FAROP_OK;
}

farop_status begin_frame(void*, const farop_frame* frame) {
  g_copy = *frame;
  if (frame->number == 0) g_first = *frame;
  return FAROP_OK;
}

farop_status polygon(void*, const farop_polygon* p) {
  const std::uint32_t frame = static_cast<std::uint32_t>(std::atoi(option("frame").c_str()));
  if (p->index == 2 && g_copy.number == frame) {
    const farop_status status = sin_of(p);
    if (status < 0) return status;
  }
  for (std::uint32_t i = 0; i < p->vertex_count; ++i) {
    const farop_vertex& v = p->vertices[i];
    std::uint8_t* pixel =
        g_copy.pixels + (v.y >> g_copy.subpixel_bits) * g_copy.row_bytes + 3 * (v.x >> g_copy.subpixel_bits);
    pixel[0] = v.r, pixel[1] = v.g, pixel[2] = v.b;
  }
  if (g_copy.number == 0) g_kept = p->vertices;
  return FAROP_OK;
}

farop_status end_frame(void*) {
  if (option("sin") == "hang-at-end-frame" && g_copy.number == 0) {
    for (;;) ::pause();
  }
  return FAROP_OK;
}

void destroy(void*) {
  if (option("sin") == "hang-in-destroy") {
    for (;;) ::pause();
  }
}

}  // namespace

extern "C" const farop_rasterizer* farop_rasterizer_entry(const farop_host* host) {
  static const farop_rasterizer table = {sizeof table, FAROP_ABI_VERSION, "sinner",    "",      0,        0,
                                         create,       destroy,           begin_frame, polygon, end_frame};
  g_host = host;
  const std::string sin = option("load-sin");
  if (sin == "segv") *g_null = 1;
  if (sin == "exit") std::exit(0);
  if (sin == "loop") {
    for (;;) g_sink = g_sink + 1;
  }
  if (sin == "null") return nullptr;
  return &table;
}
