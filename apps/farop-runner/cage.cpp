// SPDX-License-Identifier: GPL-3.0-or-later
#include "cage.h"

#include <farop/rasterizer.h>
#include <fcntl.h>
#include <malloc.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/hardware_counters.h"
#include "core/statistics.h"
#include "crash_handler.h"
#include "plugin/host_services.h"
#include "plugin/plugin_check.h"
#include "plugin/plugin_library.h"
#include "plugin/plugin_rasterizer.h"
#include "plugin/polygon_chunk.h"
#include "walls.h"

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace farop::isolate {
namespace {

constexpr std::uint64_t k_any_page = std::uint64_t{64} << 10;  ///< a multiple of the page of any machine

std::uint64_t to_nanoseconds(double seconds) {
  return static_cast<std::uint64_t>(std::max(seconds, 0.0) * 1e9);
}

void put_times(Reply& reply, const StageTime& begun, const StageTime& ended) {
  const StageTime taken = time_between(begun, ended);
  reply.begun = to_nanoseconds(begun.elapsed);
  reply.nanoseconds = to_nanoseconds(taken.elapsed);
  reply.user_nanoseconds = to_nanoseconds(taken.user);
  reply.system_nanoseconds = to_nanoseconds(taken.system);
  reply.cycles = taken.cycles.value_or(k_not_counted);
  reply.instructions = taken.instructions.value_or(k_not_counted);
}

/// The processor's settings that a rasterizer has to leave alone.
struct FloatState {
  std::uint32_t sse = 0;
  std::uint16_t x87 = 0;
};

FloatState float_state() {
  FloatState state;
#if defined(__x86_64__)
  state.sse = _mm_getcsr() & 0xFFC0u;  // masks, rounding, flush-to-zero, denormals-are-zero
  asm volatile("fnstcw %0" : "=m"(state.x87));
#endif
  return state;
}

FloatState g_float;
std::uint32_t g_warnings = 0;
const farop_rasterizer* g_table = nullptr;
decltype(farop_rasterizer::polygon) g_polygon = nullptr;  ///< the table's, or that of the check before it

/// Puts the processor's settings back after every call, so that a polygon is drawn alike whatever an earlier
/// one has left behind.
inline void settle() {
#if defined(__x86_64__)
  std::uint64_t flags = 0;
  asm volatile("pushfq\n\tpopq %0" : "=r"(flags));
  constexpr std::uint64_t changed = (1u << 18) | (1u << 10) | (1u << 8);  // alignment, direction, trap
  if ((flags & changed) != 0) {
    asm volatile("pushq %0\n\tpopfq" : : "r"(flags & ~changed) : "cc", "memory");
    g_warnings |= k_changed_flags;
  }
  const FloatState now_set = float_state();
  if (now_set.sse != g_float.sse) {
    _mm_setcsr((_mm_getcsr() & ~0xFFC0u) | g_float.sse);
    g_warnings |= k_changed_float;
  }
  if (now_set.x87 != g_float.x87) {
    asm volatile("fldcw %0" : : "m"(g_float.x87));
    g_warnings |= k_changed_float;
  }
#endif
}

/// On the stack below a call of the rasterizer. A C++ exception that nobody catches ends the process where it
/// was thrown, with the stack as it was; only pthread_exit() unwinds without asking, and is stopped here.
class Barrier {
 public:
  Barrier() = default;
  Barrier(const Barrier&) = delete;
  Barrier& operator=(const Barrier&) = delete;
  ~Barrier() {
    if (!passed_) die_of_thread_exit();
  }
  void pass() { passed_ = true; }

 private:
  bool passed_ = false;
};

farop_status call_polygon(void* self, const farop_polygon* polygon) {
  Barrier barrier;
  const farop_status status = g_polygon(self, polygon);
  barrier.pass();
  settle();
  return status;
}

/// Any other call.
template <class Call>
auto behind_barrier(const Call& call) {
  Barrier barrier;
  auto result = call();
  barrier.pass();
  return result;
}

template <std::size_t Size>
void put(char (&to)[Size], const std::string& text) {
  const std::size_t length = std::min(text.size(), Size - 1);
  std::memcpy(to, text.data(), length);
  to[length] = '\0';
}

/// Of one of the two frames that take turns.
struct FrameMemory {
  int fd = -1;
  std::uint64_t bytes = 0;
  std::uintptr_t mapped = 0;  ///< where its pages lie; 0: nowhere
};

class Cage {
 public:
  Cage(const Settings& settings, const char* options, int namespaces)
      : settings_(settings), namespaces_(namespaces), services_(options_of(settings, options), logger()) {}

  [[noreturn]] void run() {
    put_up_walls();
    if (settings_.fresh_memory != 0) ::mallopt(M_PERTURB, static_cast<int>(settings_.fresh_memory & 0xFFu));
    if (settings_.mode == Mode::probe) probe();
    for (;;) {
      Request request;
      std::optional<int> memory;
      receive(request, memory);
      serve(request, memory);
      if (memory) ::close(*memory);
    }
  }

 private:
  static std::map<std::string, std::string> options_of(const Settings& settings, const char* text) {
    std::map<std::string, std::string> options;
    const char* const end = text + settings.options_bytes;
    const auto next = [&] {
      std::string word(text, ::strnlen(text, static_cast<std::size_t>(end - text)));
      text = std::min(text + word.size() + 1, end);
      return word;
    };
    while (text < end) {
      const std::string key = next();
      options[key] = next();
    }
    return options;
  }

  PluginLog logger() {
    return [this](farop_log_level level, const std::string& line) {
      // The judge shows no more than that; the line that goes beyond tells it so.
      if (log_bytes_ > k_max_log_bytes) return;
      log_bytes_ += line.size() + 1;
      LogLine message;
      message.reply = reply(ReplyKind::log, 0);
      message.reply.status = level;
      message.length = static_cast<std::uint32_t>(std::min(line.size(), sizeof message.text));
      std::memcpy(message.text, line.data(), message.length);
      send(&message, sizeof message);
    };
  }

  // ---- walls --------------------------------------------------------------------------------------------

  void put_up_walls() {
    ::setsid();
    const auto asked = [&](Layer layer) { return (settings_.layers & layer) != 0; };
    map_shared_memory();
    HardwareCounters::of_process();  // opening them is not allowed later; reading is
    install_crash_handler(box_, asked(k_limits) ? settings_.memory_bytes : 0);
    g_float = float_state();
    Hello hello;
    const auto stands = [&](Layer layer, int index, int error) {
      if (error == 0) hello.layers |= layer;
      hello.error[index] = error;
    };
    if (asked(k_namespaces)) stands(k_namespaces, 1, namespaces_);
    if (asked(k_limits)) stands(k_limits, 0, limit_resources(settings_.memory_bytes, settings_.threads));
    if (settings_.layers != 0) hello.unchanged_root = give_up_privileges() != 0 && ::geteuid() == 0 ? 1 : 0;
    // After the change of user, which clears it. The warden sits outside the process namespace: parent 0.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() == 1) std::_Exit(0);
    if (settings_.layers != 0) ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    if (settings_.layers != 0) ::prctl(PR_SET_DUMPABLE, 0);
    if (asked(k_landlock)) stands(k_landlock, 2, restrict_files(hello.landlock_abi));
    if (asked(k_seccomp)) stands(k_seccomp, 3, filter_first(hello.watched));
    ::close(k_warden_fd);
    watched_ = hello.watched != 0;
    hello.reply = reply(ReplyKind::hello, 0);
    layers_ = hello.layers;
    send(&hello, sizeof hello);
  }

  int filter_first(std::uint32_t& watched) {
    int listener = -1;
    int error = filter_calls(settings_.threads, true, listener);
    if (error == 0 && listener >= 0) {
      hand_over(listener);
      watched = 1;
      return 0;
    }
    // An older kernel, or somebody watches already: the calls fail without a word.
    return filter_calls(settings_.threads, false, listener);
  }

  static void hand_over(int descriptor) {
    char byte = 'n';
    iovec part{&byte, 1};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> space{};
    msghdr message{};
    message.msg_iov = &part, message.msg_iovlen = 1;
    message.msg_control = space.data(), message.msg_controllen = space.size();
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET, header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof descriptor);
    std::memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
    // ETOOMANYREFS and the like pass.
    for (int i = 0; ::sendmsg(k_warden_fd, &message, MSG_NOSIGNAL) != 1; ++i) {
      if (i == 200) std::_Exit(k_exit_handover);
      const timespec moment{0, 1000000};
      ::nanosleep(&moment, nullptr);
    }
    ::close(descriptor);
  }

  void map_shared_memory() {
    void* const box =
        ::mmap(nullptr, k_black_box_bytes, PROT_READ | PROT_WRITE, MAP_SHARED, k_black_box_fd, 0);
    if (box == MAP_FAILED) std::_Exit(k_exit_black_box);
    box_ = static_cast<BlackBox*>(box);
    ::close(k_black_box_fd);
    for (int slot = 0; slot < k_ring_slots; ++slot) {
      KnownMemory& memory = g_known.chunks[slot];
      memory = reserve(k_slot_bytes);
      if (!map(memory, k_slot_bytes, PROT_NONE, k_ring_fd, static_cast<off_t>(k_slot_bytes) * slot)) {
        std::_Exit(k_exit_ring);
      }
    }
    ::close(k_ring_fd);
  }

  // ---- memory -------------------------------------------------------------------------------------------

  /// Address space with room for `bytes` between two stretches of no-man's-land.
  static KnownMemory reserve(std::uint64_t bytes) {
    const std::uint64_t all = bytes + 2 * k_guard_bytes;
    void* const memory = ::mmap(nullptr, all, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    KnownMemory known;
    if (memory == MAP_FAILED) return known;
    known.first = reinterpret_cast<std::uintptr_t>(memory);
    known.end = known.first + all;
    known.begin = known.first + k_guard_bytes;
    known.bytes = bytes;
    return known;
  }

  static void* pointer(std::uintptr_t address) { return reinterpret_cast<void*>(address); }

  static bool map(const KnownMemory& memory, std::uint64_t bytes, int access, int fd, off_t offset) {
    return memory.first != 0 && ::mmap(pointer(memory.first + k_guard_bytes), bytes, access,
                                       MAP_SHARED | MAP_FIXED | (access == PROT_NONE ? 0 : MAP_POPULATE), fd,
                                       offset) != MAP_FAILED;
  }

  static void release(KnownMemory& memory) {
    if (memory.first != 0) ::munmap(pointer(memory.first), memory.end - memory.first);
    memory = {};
  }

  /// Takes the last frame away, so that writing to it is noticed. Its pages stay where they are, out of
  /// reach, until their memory is used again: see map_frame().
  void bury_frame() {
    KnownMemory& frame = g_known.frame;
    if (frame.first == 0) return;
    // Where it fails the old mapping stays, which is still outside of the new frame.
    static_cast<void>(::mprotect(pointer(frame.first), frame.end - frame.first, PROT_NONE));
    KnownMemory& place = g_known.old_frames[buried_++ % k_old_frames];
    release_old(place);
    place = frame;
    frame = {};
    // Large frames: fewer of them.
    constexpr std::uint64_t most = std::uint64_t{512} << 20;
    std::uint64_t sum = 0;
    for (unsigned i = 0; i < k_old_frames; ++i) {
      KnownMemory& old = g_known.old_frames[(buried_ - 1 - i) % k_old_frames];
      sum += old.end - old.first;
      if (sum > most && i > 0) release_old(old);
    }
  }

  /// Of a memory that is not used any more: its pages go, its place stays taken.
  static void forget(FrameMemory& store) {
    if (store.mapped == 0) return;
    static_cast<void>(::mmap(pointer(store.mapped), store.bytes, PROT_NONE,
                             MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED, -1, 0));
    store.mapped = 0;
  }

  void release_old(KnownMemory& old) {
    for (FrameMemory& store : memories_) {
      if (store.mapped >= old.first && store.mapped < old.end) store.mapped = 0;
    }
    release(old);
  }

  /// Every frame has an address of its own. The pages that its memory had for an earlier one are moved there,
  /// which costs less than to map it again; behind them stays what nobody may touch.
  static bool map_frame(const KnownMemory& known, FrameMemory& store) {
    const std::uintptr_t place = known.first + k_guard_bytes;
    const std::uintptr_t before = std::exchange(store.mapped, 0);
    bool moved = before != 0 &&
                 ::mremap(pointer(before), store.bytes, store.bytes,
                          MREMAP_MAYMOVE | MREMAP_FIXED | MREMAP_DONTUNMAP, pointer(place)) != MAP_FAILED;
    moved = moved && ::mprotect(pointer(place), store.bytes, PROT_READ | PROT_WRITE) == 0;
    if (!moved && !map(known, store.bytes, PROT_READ | PROT_WRITE, store.fd, 0)) return false;
    store.mapped = place;
    return true;
  }

  // ---- conversation -------------------------------------------------------------------------------------

  Reply reply(ReplyKind kind, std::uint32_t serial) const {
    Reply r;
    r.kind = kind;
    r.serial = serial;
    r.cookie = settings_.cookie;
    return r;
  }

  static void send(const void* message, std::size_t bytes) {
    iovec part{const_cast<void*>(message), bytes};
    msghdr header{};
    header.msg_iov = &part, header.msg_iovlen = 1;
    for (;;) {
      if (::sendmsg(k_control_fd, &header, MSG_NOSIGNAL) >= 0) return;
      const bool passes = errno == EINTR || errno == ENOBUFS || errno == ENOMEM || errno == EAGAIN;
      if (!passes) std::_Exit(errno == EPIPE ? 0 : k_exit_control);
      if (errno != EINTR) ::sched_yield();
    }
  }

  static void receive(Request& request, std::optional<int>& memory) {
    iovec part{&request, sizeof request};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> space{};
    msghdr header{};
    header.msg_iov = &part, header.msg_iovlen = 1;
    header.msg_control = space.data(), header.msg_controllen = space.size();
    ssize_t got = 0;
    do {
      got = ::recvmsg(k_control_fd, &header, MSG_CMSG_CLOEXEC);
    } while (got < 0 && errno == EINTR);
    if (got == 0) std::_Exit(0);  // the judge is gone
    if (got != static_cast<ssize_t>(sizeof request)) std::_Exit(k_exit_control);
    const cmsghdr* const rights = CMSG_FIRSTHDR(&header);
    if (rights == nullptr || rights->cmsg_type != SCM_RIGHTS) return;
    int descriptor = -1;
    std::memcpy(&descriptor, CMSG_DATA(rights), sizeof descriptor);
    memory = descriptor;
  }

  void serve(const Request& request, std::optional<int>& memory) {
    serial_ = request.serial;
    g_warnings = 0;
    switch (request.kind) {
      case RequestKind::load:
        return load();
      case RequestKind::create:
        return answer(Phase::create, [&] {
          if (check_) return check_->create(services_.host());
          return g_table->create == nullptr ? FAROP_OK : g_table->create(services_.host(), &self_);
        });
      case RequestKind::begin_frame:
        return begin_frame(request, memory);
      case RequestKind::chunk:
        return chunk(request, memory);
      case RequestKind::end_frame:
        if (frame_lost_) return;
        return answer(
            Phase::end_frame, [&] { return table_.end_frame(self_); }, [&] { bury_frame(); });
      case RequestKind::quit:
        box_->phase = Phase::destroy;
        if (table_.destroy != nullptr) table_.destroy(self_);
        std::exit(0);
    }
    std::_Exit(k_exit_control);
  }

  /// Calls, puts everything back, says so.
  template <class Call, class After>
  void answer(Phase phase, const Call& call, const After& after) {
    box_->phase = phase;
    const StageTime begun = read_clocks();
    const farop_status status = behind_barrier(call);
    settle();
    const StageTime ended = read_clocks();
    after();
    box_->phase = Phase::idle;
    Reply r = reply(ReplyKind::done, serial_);
    r.warnings = g_warnings | restore_signals();
    r.status = status;
    r.polygon = box_->current;
    put_times(r, begun, ended);
    if (status < 0) {
      r.memory_refused = memory_is_refused() ? 1 : 0;
      frame_lost_ = true;
    }
    send(&r, sizeof r);
  }
  template <class Call>
  void answer(Phase phase, const Call& call) {
    answer(phase, call, [] {});
  }

  void load() {
    read_symbols(k_library_fd);
    const bool inside = (layers_ & k_namespaces) != 0;
    const std::string path = inside ? k_library_inside : "/proc/self/fd/" + std::to_string(k_library_fd);
    box_->phase = Phase::load;
    library_ = behind_barrier([&] { return open_plugin(path, services_); });
    settle();
    box_->phase = Phase::idle;
    restore_signals();
    ::close(k_library_fd);
    if ((layers_ & k_seccomp) != 0 && filter_calls_further(watched_) != 0) std::_Exit(k_exit_control);
    g_table = library_.table;
    if (g_table != nullptr) {
      note_modules(path);
      table_ = *g_table;
      if (settings_.check != 0) put_check_before(*g_table);
      g_polygon = table_.polygon;
      table_.polygon = call_polygon;
    }
    Loaded message;
    message.reply = reply(ReplyKind::loaded, serial_);
    message.reply.status = static_cast<std::int32_t>(library_.failure);
    if (g_table != nullptr) message.abi_version = g_table->abi_version, message.wants = g_table->wants;
    put(message.name, library_.name);
    put(message.summary, library_.summary);
    // The loader names the file that it was given, which means nothing to the user.
    for (std::size_t at; (at = library_.message.find(path + ": ")) != std::string::npos;) {
      library_.message.erase(at, path.size() + 2);
    }
    put(message.message, library_.message);
    put(message.hint, library_.hint);
    put(message.warning, library_.warning);
    send(&message, sizeof message);
  }

  void put_check_before(const farop_rasterizer& table) {
    check_.emplace(table, [this](const ContractFinding& finding) {
      CheckFinding message;
      message.reply = reply(ReplyKind::finding, serial_);
      message.reply.polygon = finding.polygon.value_or(0);
      message.has_polygon = finding.polygon ? 1 : 0;
      message.of_host = finding.of_host ? 1 : 0;
      put(message.verdict, finding.verdict);
      put(message.message, finding.message);
      send(&message, sizeof message);
    });
    table_ = check_->table();
    self_ = check_->self();
  }

  void begin_frame(const Request& request, std::optional<int>& memory) {
    frame_lost_ = false;
    bury_frame();
    services_.forget_words();
    log_bytes_ = 0;
    if (request.memory > 1) std::_Exit(k_exit_control);
    FrameMemory& store = memories_[request.memory];
    if (memory) {
      if (store.fd >= 0) ::close(store.fd);
      forget(store);
      store.fd = *memory;
      store.bytes = request.map_bytes;
      memory.reset();
    }
    farop_frame& frame = frames_[request.number % 2];
    frame = {};
    frame.struct_size = sizeof frame;
    frame.width = request.width, frame.height = request.height;
    frame.subpixel_bits = request.subpixel_bits;
    frame.z_near = request.z_near, frame.z_far = request.z_far;
    frame.max_vertices = request.max_vertices;
    frame.number = request.number;
    frame.row_bytes = request.row_bytes;
    std::memcpy(frame.background, request.background, sizeof frame.background);
    if (store.fd >= 0 && request.bytes != 0) {
      KnownMemory& known = g_known.frame;
      known = reserve(store.bytes);
      if (!map_frame(known, store)) std::_Exit(k_exit_memory);
      known.begin += request.offset;
      known.bytes = request.bytes;
      known.live = true;
      frame.pixels = static_cast<std::uint8_t*>(pointer(known.begin));
      clear_frame(frame);
    }
    answer(Phase::begin_frame, [&] { return table_.begin_frame(self_, &frame); });
  }

  void chunk(const Request& request, std::optional<int>& memory) {
    if (frame_lost_) return;
    const bool own = request.slot == k_no_slot;
    if (!own && request.slot >= k_ring_slots) std::_Exit(k_exit_control);
    KnownMemory& known = g_known.chunks[own ? k_ring_slots : request.slot];
    if (!own && request.offset > k_slot_bytes) std::_Exit(k_exit_control);
    // What lies before the chunk in its slot stays out of reach.
    const std::uint64_t unused = request.offset / k_any_page * k_any_page;
    const auto protect_slot = [&known, unused](int access) {
      ::mprotect(pointer(known.first + k_guard_bytes + unused), k_slot_bytes - unused, access);
    };
    if (own) {
      known = reserve(request.map_bytes);
      if (!memory || !map(known, request.map_bytes, PROT_READ, *memory, 0)) std::_Exit(k_exit_memory);
    } else {
      protect_slot(PROT_READ);
    }
    known.begin = known.first + k_guard_bytes + request.offset;
    known.bytes = request.bytes;
    known.live = true;
    const auto view =
        PolygonChunk::unpack({static_cast<const std::byte*>(pointer(known.begin)), known.bytes});
    if (!view) std::_Exit(k_exit_control);
    answer(
        Phase::polygon, [&] { return play_chunk(table_, self_, *view, &box_->current); },
        [&] {
          known.live = false;
          if (own) {
            release(known);
          } else {
            protect_slot(PROT_NONE);
          }
        });
  }

  // ---- probe --------------------------------------------------------------------------------------------

  /// Tries what each wall should stop. Bits of what was not stopped go to Reply::warnings.
  [[noreturn]] void probe() {
    Reply r = reply(ReplyKind::done, 0);
    const auto open_something = [] {
      const int file = ::open("/etc/passwd", O_RDONLY | O_CLOEXEC);
      if (file >= 0) ::close(file);
      return file >= 0;
    };
    if ((layers_ & k_limits) != 0) {
      void* const much = ::mmap(nullptr, settings_.memory_bytes + 4096, PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
      if (much != MAP_FAILED) r.warnings |= k_limits;
    }
    if ((layers_ & (k_namespaces | k_landlock)) != 0 && open_something()) {
      r.warnings |= layers_ & (k_namespaces | k_landlock);
    }
    if ((layers_ & k_seccomp) != 0) {
      const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
      if (socket >= 0) r.warnings |= k_seccomp;
    }
    send(&r, sizeof r);
    std::_Exit(0);
  }

  Settings settings_;
  int namespaces_;
  std::uint32_t layers_ = 0;
  bool watched_ = false;
  HostServices services_;
  BlackBox* box_ = nullptr;
  PluginLibrary library_;
  farop_rasterizer table_{};  ///< the rasterizer's functions, or those of the check before it
  std::optional<PluginCheck> check_;
  void* self_ = nullptr;
  std::uint32_t serial_ = 0;
  std::atomic<std::size_t> log_bytes_{0};  ///< in this frame; any thread may log
  bool frame_lost_ = true;
  std::array<FrameMemory, 2> memories_;
  std::array<farop_frame, 2> frames_{};
  unsigned buried_ = 0;
};

}  // namespace

void run_cage(const Settings& settings, const char* options, int namespaces) {
  // Lives as long as the process: the rasterizer keeps pointers into it.
  (new Cage(settings, options, namespaces))->run();
}

}  // namespace farop::isolate
