// SPDX-License-Identifier: GPL-3.0-or-later
// What the judge and the runner say to each other: fixed-size messages and two shared records.
//
// judge   this process: has the scene, owns the memory and the clocks, believes nothing but pixels
// warden  the runner program as it is started: builds the walls, starts the runner, sweeps up behind it
// runner  its child: loads the rasterizer and calls it
//
// Whatever comes from the runner may have been written by the rasterizer: the judge checks every field. Only
// the warden's messages can be trusted; no code of the rasterizer ever runs in that process.
#pragma once

#include <cstddef>
#include <cstdint>

namespace farop::isolate {

/// Descriptors of the program when it starts. The runner keeps 0 to 3 once the rasterizer is loaded.
enum Descriptor : int {
  k_control_fd = 3,   ///< SOCK_SEQPACKET between judge and runner
  k_warden_fd = 4,    ///< SOCK_SEQPACKET between judge and warden; in the runner: to the warden
  k_library_fd = 5,   ///< the library, a sealed memfd
  k_settings_fd = 6,  ///< Settings and the options after them, a sealed memfd
  k_black_box_fd = 7,
  k_ring_fd = 8,  ///< k_ring_slots memories for chunks, one after another
  k_end_fd = 9
};

/// Bits of Settings::layers and Hello::layers, in the order they are put up.
enum Layer : std::uint32_t {
  k_limits = 1u << 0,
  k_namespaces = 1u << 1,
  k_landlock = 1u << 2,
  k_seccomp = 1u << 3,
  k_all_layers = 15
};
constexpr int k_layer_count = 4;

constexpr int k_ring_slots = 4;
constexpr std::uint64_t k_slot_bytes = std::uint64_t{1} << 20;
constexpr std::uint64_t k_guard_bytes = std::uint64_t{16} << 20;  ///< no-man's-land on either side
constexpr std::uint64_t k_apron_bytes = std::uint64_t{64} << 10;  ///< random bytes beside the frame
constexpr std::size_t k_max_text = 4096;
constexpr std::size_t k_max_log_bytes = std::size_t{64} << 10;  ///< lines taken per frame

enum class Mode : std::uint32_t { draw, probe };

struct Settings {
  std::uint32_t magic = 0;
  Mode mode = Mode::draw;
  std::uint32_t layers = 0;   ///< those to put up
  std::uint32_t threads = 1;  ///< that the rasterizer may have, its first one included
  std::uint32_t check = 0;    ///< a PluginCheck stands before the rasterizer
  std::uint32_t reserved = 0;
  std::uint64_t memory_bytes = 0;   ///< private memory of the runner
  std::uint64_t cookie = 0;         ///< in every message of the runner
  std::uint64_t fresh_memory = 0;   ///< byte that malloc fills memory with; 0: as it comes
  std::uint64_t options_bytes = 0;  ///< "key\0value\0" ... behind this record
};
constexpr std::uint32_t k_settings_magic = 0x464A5231;

// ---- judge to runner ------------------------------------------------------------------------------------

enum class RequestKind : std::uint32_t {
  load = 1,     ///< -> loaded
  create,       ///< -> done
  begin_frame,  ///< with the frame's memory when `new_memory`; -> done
  chunk,        ///< `slot`, or a memory of its own that comes along; -> done
  end_frame,    ///< -> done
  quit,         ///< destroy() and exit
};

/// slot of a chunk that brings its memory along.
constexpr std::uint32_t k_no_slot = 0xFFFFFFFFu;

struct Request {
  RequestKind kind = RequestKind::quit;
  std::uint32_t serial = 0;  ///< 1, 2, 3 ...
  std::uint32_t slot = 0;
  std::uint32_t new_memory = 0;
  std::uint64_t map_bytes = 0;  ///< of the memory that comes along, whole pages
  std::uint64_t offset = 0;     ///< of the first pixel, or of the packed chunk, within its memory
  std::uint64_t bytes = 0;      ///< of the packed chunk
  std::uint32_t memory = 0;     ///< which of the two frame memories
  std::int32_t width = 0, height = 0, subpixel_bits = 0, z_near = 0, z_far = 0;
  std::uint32_t max_vertices = 0, number = 0;
  std::int64_t row_bytes = 0;
  std::uint8_t background[4] = {};
  std::uint32_t reserved = 0;
};

// ---- runner to judge ------------------------------------------------------------------------------------

constexpr std::uint64_t k_not_counted = ~std::uint64_t{0};

enum class ReplyKind : std::uint32_t { hello = 1, loaded, done, log, finding };

/// Warnings of Reply::warnings.
enum ReplyWarning : std::uint32_t {
  k_changed_float = 1u << 0,    ///< rounding mode, flush-to-zero, exception masks
  k_changed_mask = 1u << 1,     ///< signal mask
  k_changed_handler = 1u << 2,  ///< a signal handler
  k_changed_flags = 1u << 3,    ///< alignment check or direction flag
  k_all_warnings = 15
};

/// First and, for `done`, only part of every message of the runner.
struct Reply {
  ReplyKind kind = ReplyKind::done;
  std::uint32_t serial = 0;
  std::uint64_t cookie = 0;
  std::int32_t status = 0;    ///< farop_status; LoadFailure for `loaded`; level for `log`
  std::uint32_t polygon = 0;  ///< last one called, for a chunk
  // Of `done`: inside the rasterizer.
  std::uint64_t begun = 0;  ///< CLOCK_MONOTONIC, nanoseconds
  std::uint64_t nanoseconds = 0, user_nanoseconds = 0, system_nanoseconds = 0;
  std::uint64_t cycles = k_not_counted, instructions = k_not_counted;
  std::uint32_t warnings = 0;
  std::uint32_t memory_refused = 0;  ///< no room below the limit when the call failed
};

/// `hello`: what stands. error[i] is an errno, 0 where it stands or was not asked for.
struct Hello {
  Reply reply;
  std::uint32_t layers = 0;
  std::int32_t error[k_layer_count] = {};
  std::int32_t landlock_abi = 0;
  std::uint32_t watched = 0;         ///< refused calls are recorded by the warden
  std::uint32_t unchanged_root = 0;  ///< could not give up being root
};

/// `loaded`
struct Loaded {
  Reply reply;
  std::uint32_t abi_version = 0, wants = 0;
  char name[72] = {};
  char summary[232] = {};
  char message[1024] = {};
  char hint[512] = {};
  char warning[256] = {};
};

/// `log`
struct LogLine {
  Reply reply;
  std::uint32_t length = 0;
  char text[k_max_text] = {};
};

/// `finding`: of a PluginCheck. Comes before the answer to the call that it belongs to.
struct CheckFinding {
  Reply reply;  ///< polygon: within the frame
  std::uint32_t of_host = 0;
  std::uint32_t has_polygon = 0;
  char verdict[32] = {};
  char message[256] = {};
};

/// What the runner ends with when its side of the conversation is broken.
constexpr int k_exit_control = 99;
/// What it ends with when it cannot map what the judge sent.
constexpr int k_exit_memory = 98;
/// Before anything of the rasterizer is there: what could not be set up.
constexpr int k_exit_black_box = 91, k_exit_ring = 92, k_exit_handover = 93;

// ---- warden to judge ------------------------------------------------------------------------------------

enum class WardenKind : std::uint32_t { started = 1, refused, ended, failed };

/// What a refused system call was after.
enum class Deed : std::uint32_t {
  process,        ///< start one
  program,        ///< start one
  network,        ///< a socket
  write_file,     ///< open for writing, remove, rename ...
  signal,         ///< to another process
  other_process,  ///< look into one
  kernel,         ///< something only administrators do
  code,           ///< make code
  threads,        ///< one more than allowed
  memory,         ///< shared with others
  control,        ///< descriptors that are not its own
  count
};

struct WardenMessage {
  WardenKind kind = WardenKind::failed;
  std::int32_t pid = 0;       ///< started: of the runner, as the warden sees it
  Deed deed = Deed::process;  ///< refused
  std::int32_t call = 0;      ///< refused: number of the system call
  std::uint32_t polygon = 0;  ///< refused: the black box's at that time
  std::uint32_t fatal = 0;    ///< refused: the runner was killed for it
  std::int32_t wait_status = 0;
  std::int32_t error = 0;  ///< failed: errno
  std::uint64_t cpu_nanoseconds = 0;
  std::uint64_t peak_bytes = 0;
  char what[32] = {};  ///< failed: which call; refused: its name
};

/// Judge to warden, one byte.
enum WardenOrder : char { k_kill = 'k', k_loaded = 'l' };

// ---- the black box --------------------------------------------------------------------------------------

/// What the runner was doing.
enum class Phase : std::uint32_t { start, load, create, begin_frame, polygon, end_frame, destroy, idle };

/// Where an address lies that could not be accessed.
enum class Region : std::uint32_t {
  unknown,
  before_frame,  ///< `offset` < 0 from the first pixel
  after_frame,   ///< `offset` from the first pixel, at or behind the end of the last row
  frame,         ///< within the frame: the mapping was taken away
  old_frame,     ///< a frame whose end_frame() has returned
  after_input,   ///< behind the vertices; `offset` from their end
  input,         ///< vertices and what belongs to them
  old_input,     ///< those of a call that has returned
  stack,
  text  ///< a name or summary of the table that has no end
};

constexpr std::size_t k_max_trace = 32;
constexpr std::size_t k_trace_text = 96;

/// Shared page for the time after a crash. Hints: the rasterizer can write what it likes here.
struct BlackBox {
  volatile std::uint32_t current = 0;  ///< polygon
  volatile Phase phase = Phase::start;
  std::uint32_t signal = 0;  ///< 0: the crash handler did not run
  std::int32_t code = 0;
  std::uint64_t address = 0, program_counter = 0, stack_pointer = 0;
  std::uint32_t writing = 0;  ///< 0 reading, 1 writing, 2 unknown, 3 executing
  Region region = Region::unknown;
  std::int64_t offset = 0;
  std::uint32_t memory_refused = 0;
  std::uint32_t other_thread = 0;  ///< than the one that calls the rasterizer
  std::uint32_t trace_count = 0;
  char thrown[96] = {};  ///< type of the C++ exception that nobody caught
  char trace[k_max_trace][k_trace_text] = {};
};
/// BlackBox::thrown when it was pthread_exit() that left.
constexpr const char* k_thread_exit = "pthread_exit()";
constexpr std::uint64_t k_black_box_bytes = 4096;
static_assert(sizeof(BlackBox) <= k_black_box_bytes);

}  // namespace farop::isolate
