// SPDX-License-Identifier: GPL-3.0-or-later
#include "isolate/isolated_rasterizer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/diagnostics.h"
#include "isolate/control_group.h"
#include "isolate/crash_words.h"
#include "isolate/frame_memory.h"
#include "isolate/layers.h"
#include "isolate/protocol.h"
#include "isolate/runner_process.h"
#include "isolate/shared_memory.h"
#include "plugin/plugin_library.h"
#include "plugin/polygon_chunk.h"

namespace farop {

using namespace isolate;

namespace {

/// Polygons go over as soon as there is this much of them: little at first, so that the runner has something
/// to do, then more and more, as every chunk costs some system calls.
constexpr std::size_t k_first_batch_bytes = std::size_t{16} << 10, k_batch_bytes = std::size_t{256} << 10;
constexpr std::ptrdiff_t k_max_own_memories = 2;
constexpr std::int64_t k_least_leak = 128 << 10;  ///< bytes per frame that are worth a word

std::string file_name(const std::string& path) {
  return printable(std::filesystem::path(path).filename().string(), 80);
}

/// Several lines of output, safe to print.
std::string printable_lines(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    out += printable(std::string_view(text).substr(begin, end - begin), k_max_output);
    if (end < text.size()) out += '\n';
    begin = end + 1;
  }
  return out;
}

std::string last_line(const std::string& text) {
  std::size_t end = text.size();
  while (end > 0 && (text[end - 1] == '\n' || text[end - 1] == '\r')) --end;
  const std::size_t before = end == 0 ? std::string::npos : text.rfind('\n', end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return printable(std::string_view(text).substr(begin, end - begin), 300);
}

PluginFinding load_finding(LoadFailure failure, std::string message, std::string hint) {
  PluginFinding finding;
  finding.fatal = true;
  finding.message = std::move(message);
  finding.hint = std::move(hint);
  switch (failure) {
    case LoadFailure::symbol:
      finding.verdict = "abi.symbol";
      break;
    case LoadFailure::version:
    case LoadFailure::refused:  // "this host will not do"
      finding.verdict = "abi.version";
      break;
    case LoadFailure::contract:
      // Names, functions that are not there; else a table of another version.
      finding.verdict = finding.message.starts_with("its name")            ? "abi.name"
                        : finding.message.starts_with("its table has no ") ? "abi.symbol"
                                                                           : "abi.version";
      break;
    default:
      finding.verdict = "abi.load";
  }
  return finding;
}

/// The file as it is now, in memory that nobody can change: what is looked at is what is loaded.
SharedMemory copy_of_library(const std::string& path) {
  const PluginLibrary look = inspect_plugin_file(path);
  if (look.failure != LoadFailure::none) {
    throw PluginFailure(file_name(path), load_finding(look.failure, look.message, look.hint));
  }
  const OwnedDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw PluginFailure(file_name(path), load_finding(LoadFailure::file, "cannot be opened", {}));
  }
  SharedMemory copy("farop-rasterizer", static_cast<std::uint64_t>(status.st_size));
  std::vector<std::byte> block(std::size_t{1} << 16);
  for (std::uint64_t at = 0; at < copy.bytes();) {
    const ssize_t got = ::pread(file.get(), block.data(), block.size(), static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) {
      throw PluginFailure(file_name(path),
                          load_finding(LoadFailure::file,
                                       got < 0 ? fmt::format("cannot be read: {}", std::strerror(errno))
                                               : "changed while it was read",
                                       {}));
    }
    const std::size_t size = std::min<std::size_t>(static_cast<std::size_t>(got), copy.bytes() - at);
    copy.write(at, std::span(block).first(size));
    at += size;
  }
  copy.make_constant();
  return copy;
}

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::uint64_t random_cookie() {
  std::random_device device;
  return (std::uint64_t{device()} << 32) | device();
}

}  // namespace

PluginFailure::PluginFailure(const std::string& name, PluginFinding finding)
    : Error(ExitStatus::plugin, fmt::format("rasterizer '{}': {}", name, finding.message), finding.hint),
      finding_(std::move(finding)) {}

class IsolatedRasterizer::Judge {
 public:
  Judge(const std::string& path, const IsolationOptions& options, const PluginDrawing& drawing)
      : path_(path),
        options_(options),
        drawing_(drawing),
        runner_(options.runner.empty() ? find_runner() : options.runner),
        library_(copy_of_library(path)),
        frames_{FrameMemory(FrameMemory::Touches::end, options.seed),
                FrameMemory(FrameMemory::Touches::begin, ~options.seed)} {
    start();
  }

  ~Judge() {
    if (!process_) return;
    try {
      if (process_->is_alive()) {
        Request quit;
        quit.kind = RequestKind::quit;
        process_->send(quit);
        process_->end_gently();
      }
    } catch (const Error&) {  // it was about to go anyway
    }
    process_.reset();  // before its group
  }

  // ---- frames -------------------------------------------------------------------------------------------

  void begin_frame(const ScreenFrame& frame) {
    if (!process_) start();
    // Of a frame that was given up half-way, by whoever feeds us.
    while (!outstanding_.empty()) attend(true);
    has_picture_ = false;
    const auto begun = std::chrono::steady_clock::now();
    frame_begun_ = begun;
    const std::uint32_t number = frames_begun_++;
    frame_ = plugin_frame(frame, drawing_.background);
    frame_.number = number;
    frame_.row_bytes = 3 * std::int64_t{frame_.width};
    y_down_ = frame.y_down;
    has_frame_ = true;
    log_bytes_ = 0;
    last_words_.clear(), last_error_.clear();

    Request request;
    request.kind = RequestKind::begin_frame;
    // Large frames have one memory, not two that take turns.
    constexpr std::int64_t large = std::int64_t{64} << 20;
    const bool is_large = 3 * std::int64_t{frame_.width} * frame_.height > large;
    if (is_large)
      frames_[1] = FrameMemory(FrameMemory::Touches::begin, ~options_.seed), knows_memory_[1] = false;
    memory_in_use_ = request.memory = is_large ? 0 : number % 2;
    int memory = -1;
    if (draws_here()) {
      FrameMemory& store = frames_[request.memory];
      const bool is_new = store.prepare(frame_);
      if (is_new || !knows_memory_[request.memory]) {
        memory = store.memory().fd();
        request.new_memory = 1;
        request.map_bytes = store.memory().bytes();
        knows_memory_[request.memory] = true;
      }
      request.offset = store.offset();
      request.bytes = store.bytes();
    }
    request.width = frame_.width, request.height = frame_.height;
    request.subpixel_bits = frame_.subpixel_bits;
    request.z_near = frame_.z_near, request.z_far = frame_.z_far;
    request.max_vertices = frame_.max_vertices;
    request.number = number;
    request.row_bytes = frame_.row_bytes;
    std::memcpy(request.background, frame_.background, sizeof request.background);
    chunk_->begin_frame(frame.resolution.color);
    batch_bytes_ = k_first_batch_bytes;
    process_->start_clocks(options_.limits);
    ask(request, memory);
  }

  void polygons(const ScreenPolygonBatch& batch) {
    need_frame();
    if (options_.guard_every_polygon) return polygons_one_by_one(batch);
    chunk_->append(batch);
    if (chunk_->packed_bytes() < batch_bytes_) return;
    flush();
    batch_bytes_ = std::min(2 * batch_bytes_, k_batch_bytes);
  }

  void end_frame() {
    need_frame();
    flush();
    Request request;
    request.kind = RequestKind::end_frame;
    ask(request);
    while (!outstanding_.empty()) attend(true);
    if (draws_here()) {
      for (PluginFinding& finding : frames_[memory_in_use_].fetch(frame_)) add(std::move(finding));
    }
    look_at_output();
    look_at_memory();
    has_frame_ = false;
    has_picture_ = true;
    judge_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - frame_begun_).count();
  }

  Framebuffer take() const {
    if (!has_picture_ || !draws_here()) {
      throw Error(ExitStatus::internal, "a picture was asked for before there was one");
    }
    return average_blocks(frame_, drawing_.samples, y_down_);
  }

  bool draws_here() const { return (description_.wants & FAROP_DRAWS_ELSEWHERE) == 0; }
  const PluginDescription& description() const { return description_; }
  const std::vector<PluginFinding>& findings() const { return findings_; }

  RunnerReport report() const {
    RunnerReport report;
    report.runner = runner_times_;
    report.judge = judge_seconds_;
    report.cpu = cpu_before_ + (process_ ? process_->cpu_seconds() : 0);
    report.peak_bytes = peak_bytes_;
    report.out = printable_lines(process_ ? process_->out().text : out_);
    report.err = printable_lines(process_ ? process_->err().text : err_);
    report.layers = layers_;
    return report;
  }

 private:
  struct Outstanding {
    std::uint32_t serial = 0;
    RequestKind kind = RequestKind::load;
    std::uint32_t slot = k_no_slot;
    SharedMemory memory;  ///< of a chunk that brings its own
    WritableView view;
    std::uint64_t offset = 0, bytes = 0;  ///< of the packed chunk
    double asked = 0;                     ///< seconds on the steady clock
  };

  // ---- start --------------------------------------------------------------------------------------------

  void start() {
    black_box_ = SharedMemory("farop-black-box", k_black_box_bytes);
    ring_ = SharedMemory("farop-polygons", k_slot_bytes * k_ring_slots);
    ring_view_ = WritableView(ring_);
    knows_memory_ = {};
    for (FrameMemory& memory : frames_) memory.distrust();
    slot_busy_ = {};
    frames_begun_ = 0;
    has_frame_ = false;
    serial_ = 0;
    outstanding_.clear();
    memory_history_.clear();
    hello_.reset();
    loaded_.reset();

    RunnerProcess::Start start;
    start.runner = runner_;
    start.library = &library_;
    start.black_box = &black_box_;
    start.ring = &ring_;
    start.settings.layers = wanted_layers(options_);
    const int threads = options_.limits.threads;
    start.settings.threads = threads <= 1 ? 1 : static_cast<std::uint32_t>(threads) + 1;
    start.settings.memory_bytes = options_.limits.memory_bytes;
    start.settings.check = options_.check ? 1 : 0;
    start.settings.cookie = random_cookie();
    start.settings.fresh_memory = options_.fresh_memory;
    start.options = &options_.plugin_options;
    // Nothing of the rasterizer runs before the runner has introduced itself: when it fails so early the
    // machine was short of something, and may not be the next time.
    for (int tries = 3; !hello_; --tries) {
      try {
        process_ = std::make_unique<RunnerProcess>(start);
        process_->start_clocks(options_.limits);
        while (!hello_) attend(true);
      } catch (const Error& error) {
        if (tries == 1 || error.status() != ExitStatus::internal) throw;
      }
    }
    layers_ = layers_of(*hello_, start.settings.layers);
    if (options_.isolation == Isolation::strict) {
      for (const IsolationLayer& layer : layers_) {
        if (layer.holds) continue;
        const std::string why = fmt::format("layer {} is missing: {}", layer.id, layer.why);
        drop_process();
        throw Error(ExitStatus::surroundings, "--isolation strict cannot be had: " + why,
                    layer.how_to_enable.empty() ? "`farop doctor` shows what this machine offers"
                                                : layer.how_to_enable);
      }
    }
    std::error_code error;
    if ((hello_->layers & k_namespaces) == 0 && !std::filesystem::exists("/proc/self/fd", error)) {
      drop_process();
      throw Error(ExitStatus::surroundings, "rasterizers cannot be loaded without /proc", "mount /proc");
    }
    join_group(start.settings);
    process_->start_clocks(options_.limits);  // now that the runner is known
    Request load;
    load.kind = RequestKind::load;
    ask(load);
    while (!loaded_) attend(true);
    take_description(*loaded_);
    process_->loaded();
    chunk_.emplace(description_.wants);
    process_->start_clocks(options_.limits);
    Request create;
    create.kind = RequestKind::create;
    ask(create);
    while (!outstanding_.empty()) attend(true);
  }

  /// Before anything of the rasterizer is there.
  void join_group(const Settings& settings) {
    if (!wants_group(options_)) {
      layers_.push_back(control_group_layer(false, "not asked for"));
      return;
    }
    group_.emplace(ControlGroup::Limits{settings.memory_bytes, settings.threads}, options_.group_root);
    const pid_t runner = process_->runner_pid();
    if (group_->there() && runner > 0 && group_->add(runner)) {
      layers_.push_back(control_group_layer(true, ""));
      return;
    }
    layers_.push_back(control_group_layer(false, group_->why()));
    group_.reset();
  }

  template <std::size_t Size>
  static std::string text(const char (&from)[Size]) {
    return printable({from, ::strnlen(from, Size)}, Size);
  }

  void take_description(const Loaded& loaded) {
    const auto failure = static_cast<LoadFailure>(loaded.reply.status);
    if (failure != LoadFailure::none) {
      const std::string words = text(loaded.message);
      fail(load_finding(failure, words.empty() ? "cannot be loaded" : words, text(loaded.hint)));
    }
    description_.name = text(loaded.name);
    description_.summary = text(loaded.summary);
    description_.abi_version = loaded.abi_version;
    description_.wants = loaded.wants;
    if (const std::string warning = text(loaded.warning); !warning.empty()) {
      PluginFinding finding;
      finding.verdict = "abi.float-state";
      finding.warning = true;
      finding.message = warning;
      add(std::move(finding));
    }
  }

  // ---- conversation -------------------------------------------------------------------------------------

  Outstanding& ask(Request& request, int memory = -1) {
    request.serial = ++serial_;
    Outstanding& waiting = outstanding_.emplace_back();
    waiting.serial = request.serial;
    waiting.kind = request.kind;
    waiting.asked = steady_seconds();
    process_->send(request, memory);  // if nobody listens any more, attend() learns why
    return waiting;
  }

  void need_frame() const {
    if (!process_ || !has_frame_) throw Error(ExitStatus::internal, "polygons for a frame that is lost");
  }

  void polygons_one_by_one(const ScreenPolygonBatch& batch) {
    const auto part = [](const auto& from, const ScreenPolygonRecord& polygon, auto& to) {
      if (from.empty()) return;
      const auto first = from.begin() + polygon.first_vertex;
      to.assign(first, first + polygon.vertex_count);
    };
    for (const ScreenPolygonRecord& polygon : batch.polygons) {
      ScreenPolygonBatch one;
      one.polygons.push_back(polygon);
      one.polygons.front().first_vertex = 0;
      part(batch.vertices, polygon, one.vertices);
      part(batch.normals, polygon, one.normals);
      part(batch.eye_positions, polygon, one.eye_positions);
      part(batch.vertex_ids, polygon, one.vertex_ids);
      chunk_->append(one);
      flush();
    }
  }

  /// Hands what has been gathered to the runner.
  void flush() {
    while (attend(false)) {
    }
    if (chunk_->empty()) return;
    const std::uint64_t bytes = chunk_->packed_bytes();
    Request request;
    request.kind = RequestKind::chunk;
    request.bytes = bytes;
    if (bytes > k_slot_bytes) {
      while (own_memories() >= k_max_own_memories) attend(true);
      SharedMemory memory("farop-polygons", whole_pages(bytes));
      WritableView view(memory);
      request.slot = k_no_slot;
      request.map_bytes = memory.bytes();
      request.offset = memory.bytes() - bytes;
      chunk_->pack(view.bytes().subspan(request.offset));
      Outstanding& waiting = ask(request, memory.fd());
      waiting.offset = request.offset, waiting.bytes = bytes;
      waiting.memory = std::move(memory), waiting.view = std::move(view);
    } else {
      while (slot_busy_[next_slot_]) attend(true);
      request.slot = next_slot_;
      request.offset = k_slot_bytes - bytes;  // the vertices end where no-man's-land begins
      chunk_->pack(slot_memory(request.slot).subspan(request.offset));
      Outstanding& waiting = ask(request);
      waiting.slot = request.slot, waiting.offset = request.offset, waiting.bytes = bytes;
      slot_busy_[next_slot_] = true;
      next_slot_ = (next_slot_ + 1) % k_ring_slots;
    }
    chunk_->clear();
  }

  /// Chunks on their way that are too large for the ring.
  std::ptrdiff_t own_memories() const {
    return std::count_if(outstanding_.begin(), outstanding_.end(), [](const Outstanding& o) {
      return o.kind == RequestKind::chunk && o.slot == k_no_slot;
    });
  }

  std::span<std::byte> slot_memory(std::uint32_t slot) const {
    return ring_view_.bytes().subspan(slot * k_slot_bytes, k_slot_bytes);
  }

  /// One thing that happens. False: nothing did.
  bool attend(bool wait) {
    std::optional<RunnerEvent> event = process_->next(wait);
    look_at_refusals();
    if (!event) {
      if (wait) throw Error(ExitStatus::internal, "waiting for a runner that has ended");
      return false;
    }
    std::visit([this](const auto& what) { on(what); }, *event);
    return true;
  }

  void on(const Reply& reply) {
    if (outstanding_.empty() || reply.serial != outstanding_.front().serial ||
        outstanding_.front().kind == RequestKind::load) {
      return breach("an answer that nobody asked for");
    }
    const Outstanding done = std::move(outstanding_.front());
    outstanding_.pop_front();
    if (done.slot != k_no_slot) slot_busy_[done.slot] = false;
    note_time(done, reply);
    note_warnings(reply.warnings & k_all_warnings);
    if (reply.status < 0) on_status(done, reply);
  }

  void on(const Hello& hello) {
    if (hello_) return breach("it introduced itself twice");
    hello_ = hello;
  }

  void on(const Loaded& loaded) {
    if (loaded_ || outstanding_.empty() || outstanding_.front().kind != RequestKind::load) {
      return breach("it said twice that it was loaded");
    }
    outstanding_.pop_front();
    loaded_ = loaded;
  }

  void on(const LogLine& line) {
    const std::size_t length = std::min<std::size_t>(line.length, sizeof line.text);
    log_bytes_ += length + 1;
    if (log_bytes_ > k_max_log_bytes) {
      return warn_once("limit.output", "it logged more than 64 KiB in one frame; the rest is not shown",
                       "log what went wrong, not what went right");
    }
    const std::string words = printable({line.text, length}, k_max_text);
    last_words_ = words;
    if (line.reply.status >= FAROP_LOG_ERROR) last_error_ = words;
    if (options_.log) {
      const auto level = std::clamp<farop_log_level>(line.reply.status, FAROP_LOG_DEBUG, FAROP_LOG_ERROR);
      options_.log(level, words);
    }
  }

  /// Hints, as all that comes from there.
  void on(const CheckFinding& found) {
    if (!options_.check) return breach("a finding of a check that nobody asked for");
    PluginFinding finding;
    finding.warning = true;
    finding.of_host = found.of_host != 0;
    finding.verdict = text(found.verdict);
    finding.message = text(found.message);
    if (found.has_polygon != 0) finding.polygon = found.reply.polygon;
    constexpr std::size_t most = 64;
    if (findings_.size() < most && said_.insert(finding.verdict + finding.message).second) {
      add(std::move(finding));
    }
  }

  void on(const ProtocolBreach& what) { breach(what.what); }

  void on(const RunnerEnded& ended) {
    const Circumstances c = circumstances();
    std::optional<PluginFinding> finding = finding_of_end(ended.wait_status, c);
    // Killed by the warden for what it tried.
    for (PluginFinding& refused : findings_) {
      if (!finding && refused.fatal) finding = refused;
    }
    const bool before_load = !hello_;
    const bool was_killed = WIFSIGNALED(ended.wait_status) && WTERMSIG(ended.wait_status) == SIGKILL;
    if (was_killed && group_ && group_->killed_for_memory() > 0) finding = finding_of_memory(c);
    drop_process();
    if (before_load) {
      throw Error(ExitStatus::internal,
                  fmt::format("farop-runner ended at once (wait status {:#x})", ended.wait_status),
                  "is it of this version of farop?");
    }
    if (!finding) {
      throw Error(ExitStatus::surroundings, fmt::format("rasterizer '{}' was killed from outside", name()),
                  "did the machine run out of memory?");
    }
    throw PluginFailure(name(), std::move(*finding));
  }

  void on(const TimedOut& over) {
    if (!hello_) {
      drop_process();
      throw Error(ExitStatus::surroundings, "farop-runner does not come up");
    }
    fail(finding_of_time(over.cpu, over.seconds, circumstances()));
  }

  void breach(const std::string& what) {
    PluginFinding finding;
    finding.fatal = true;
    finding.verdict = "abi.protocol";
    finding.message = "it interfered with the conversation between farop and its runner: " + what;
    finding.hint = "use only descriptors that you have opened";
    fail(std::move(finding));
  }

  /// The rasterizer says that it failed. The runner lives on; the frame is lost.
  void on_status(const Outstanding& request, const Reply& reply) {
    PluginFinding finding;
    const char* function = "polygon";
    if (request.kind == RequestKind::create) function = "create";
    if (request.kind == RequestKind::begin_frame) function = "begin_frame";
    if (request.kind == RequestKind::end_frame) function = "end_frame";
    std::string number;
    if (request.kind == RequestKind::chunk) {
      finding.polygon = reply.polygon;
      number = fmt::format(" number {}", reply.polygon);
    }
    const std::string& words = last_error_.empty() ? last_words_ : last_error_;
    finding.verdict = reply.memory_refused != 0 ? "limit.memory" : "abi.status";
    finding.message = fmt::format("{}{} failed: {}{}", function, number, status_text(reply.status),
                                  words.empty() ? "" : ": " + words);
    has_frame_ = false;
    if (request.kind == RequestKind::create) {
      finding.fatal = true;
      drop_process();
    } else {
      forget_outstanding();
    }
    throw PluginFailure(name(), std::move(finding));
  }

  /// After a failure the runner leaves the rest of the frame unanswered.
  void forget_outstanding() {
    outstanding_.clear();
    slot_busy_ = {};
  }

  void drop_process() {
    if (!process_) return;
    const RunnerEnded ended = process_->end();
    look_at_refusals();
    look_at_output();
    cpu_before_ += static_cast<double>(ended.cpu_nanoseconds) * 1e-9;
    peak_bytes_ = std::max(peak_bytes_, ended.peak_bytes);
    out_ = process_->out().text;
    err_ = process_->err().text;
    process_.reset();
    if (group_) {
      peak_bytes_ = std::max(peak_bytes_, group_->peak_bytes().value_or(0));
      group_.reset();
    }
    has_frame_ = false;
  }

  [[noreturn]] void fail(PluginFinding finding) {
    drop_process();
    throw PluginFailure(name(), std::move(finding));
  }

  // ---- evidence -----------------------------------------------------------------------------------------

  Circumstances circumstances() {
    box_ = BlackBox();
    if (!black_box_.read(0, std::as_writable_bytes(std::span(&box_, 1)))) box_ = BlackBox();
    Circumstances c;
    c.box = &box_;
    if (draws_here() && frame_.struct_size != 0) c.frame = &frame_;
    c.memory_bytes = options_.limits.memory_bytes;
    c.last_error_line = process_ ? last_line(process_->err().text) : "";
    for (const IsolationLayer& layer : layers_)
      c.walled = c.walled || (layer.id.front() == 'D' && layer.holds);
    if (box_.phase == Phase::polygon) {
      for (const Outstanding& waiting : outstanding_) find_polygon(waiting, c);
    }
    return c;
  }

  /// Corners of the black box's polygon from our own memory.
  void find_polygon(const Outstanding& waiting, Circumstances& c) const {
    if (waiting.kind != RequestKind::chunk) return;
    const std::span<std::byte> memory =
        waiting.slot == k_no_slot ? waiting.view.bytes() : slot_memory(waiting.slot);
    const auto view = PolygonChunk::unpack(memory.subspan(waiting.offset, waiting.bytes));
    if (!view || box_.current < view->first_index ||
        box_.current - view->first_index >= view->polygons.size())
      return;
    const ChunkPolygon& polygon = view->polygons[box_.current - view->first_index];
    c.corners = polygon.vertex_count;
    if (polygon.vertex_count > 0) c.first_corner = view->vertices[polygon.first_vertex];
  }

  /// Whatever the runner says of its times, they lie between the question and its answer.
  void note_time(const Outstanding& request, const Reply& reply) {
    const auto seconds = [](std::uint64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-9; };
    const auto count = [](std::uint64_t events) {
      return events == k_not_counted ? std::optional<std::uint64_t>() : events;
    };
    const double now = steady_seconds();
    const double begun = std::clamp(seconds(reply.begun), request.asked, now);
    const double elapsed = std::min(seconds(reply.nanoseconds), now - begun);
    const StageTime taken{elapsed, seconds(reply.user_nanoseconds), seconds(reply.system_nanoseconds),
                          count(reply.cycles), count(reply.instructions)};
    const auto note = [&](StageTime& sum, const char* name) {
      sum += taken;
      if (drawing_.trace != nullptr) {
        drawing_.trace->add({name, begun, begun + elapsed, TraceTrack::rasterizer});
      }
    };
    if (request.kind == RequestKind::create) note(runner_times_.create, "create");
    if (request.kind == RequestKind::begin_frame) note(runner_times_.begin_frame, "begin_frame");
    if (request.kind == RequestKind::chunk) note(runner_times_.polygon, "polygon");
    if (request.kind == RequestKind::end_frame) note(runner_times_.end_frame, "end_frame");
  }

  void note_warnings(std::uint32_t warnings) {
    if ((warnings & k_changed_float) != 0) {
      warn_once("abi.float-state", "it left another rounding mode or switched denormal numbers off",
                "return with the floating-point settings as you found them; do not link with -ffast-math");
    }
    if ((warnings & k_changed_flags) != 0) {
      warn_once("abi.cpu-flags", "it left the direction, trap or alignment flag set", "");
    }
    if ((warnings & (k_changed_mask | k_changed_handler)) != 0) {
      warn_once("abi.signals", "it changed signal handlers or blocked signals",
                "a rasterizer needs no signals");
    }
  }

  void look_at_refusals() {
    if (!process_) return;
    for (const WardenMessage& refusal : process_->take_refusals()) add(finding_of_refusal(refusal));
  }

  void look_at_output() {
    if (!process_) return;
    if (std::max(process_->out().bytes, process_->err().bytes) > k_max_output) {
      warn_once("limit.output", "it printed more than 64 KiB; the rest is not shown", "printing takes time");
    }
  }

  /// Memory that grows by the same amount from frame to frame of one size.
  void look_at_memory() {
    const std::optional<std::uint64_t> bytes = process_->data_bytes();
    const std::pair<int, int> size{frame_.width, frame_.height};
    if (!bytes || size != memory_size_) memory_history_.clear();
    memory_size_ = size;
    if (!bytes) return;
    memory_history_.push_back(static_cast<std::int64_t>(*bytes));
    if (memory_history_.size() < 5) return;
    if (memory_history_.size() > 5) memory_history_.pop_front();
    std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = 0;
    for (std::size_t i = 1; i < memory_history_.size(); ++i) {
      const std::int64_t growth = memory_history_[i] - memory_history_[i - 1];
      least = std::min(least, growth), most = std::max(most, growth);
    }
    if (least < k_least_leak || most > 2 * least) return;
    warn_once("memory.leak",
              fmt::format("its memory grows from frame to frame: {} KiB each",
                          (memory_history_.back() - memory_history_.front()) / 4 / 1024),
              "free in end_frame() or destroy() what begin_frame() and polygon() allocate");
  }

  void add(PluginFinding finding) { findings_.push_back(std::move(finding)); }

  void warn_once(const std::string& verdict, const std::string& message, const std::string& hint) {
    if (!said_.insert(verdict).second) return;
    PluginFinding finding;
    finding.verdict = verdict;
    finding.warning = true;
    finding.message = message;
    finding.hint = hint;
    add(std::move(finding));
  }

  std::string name() const { return description_.name.empty() ? file_name(path_) : description_.name; }

  std::string path_;
  IsolationOptions options_;
  PluginDrawing drawing_;
  std::string runner_;
  SharedMemory library_, black_box_, ring_;
  WritableView ring_view_;
  std::array<FrameMemory, 2> frames_;
  std::uint32_t memory_in_use_ = 0;
  std::array<bool, 2> knows_memory_{};  ///< the runner has it already
  std::unique_ptr<RunnerProcess> process_;
  std::optional<Hello> hello_;
  std::optional<Loaded> loaded_;
  PluginDescription description_;
  std::vector<IsolationLayer> layers_;
  std::optional<ControlGroup> group_;

  std::optional<PolygonChunk> chunk_;
  std::size_t batch_bytes_ = k_first_batch_bytes;
  std::deque<Outstanding> outstanding_;
  std::array<bool, k_ring_slots> slot_busy_{};
  std::uint32_t next_slot_ = 0;
  std::uint32_t serial_ = 0;

  farop_frame frame_{};
  bool y_down_ = false;
  bool has_frame_ = false;    ///< begun, not ended
  bool has_picture_ = false;  ///< ended
  std::uint32_t frames_begun_ = 0;
  std::chrono::steady_clock::time_point frame_begun_;

  std::deque<std::int64_t> memory_history_;
  std::pair<int, int> memory_size_;
  std::string last_words_, last_error_;
  std::size_t log_bytes_ = 0;
  BlackBox box_;
  std::vector<PluginFinding> findings_;
  std::set<std::string> said_;
  PluginTimes runner_times_;
  double judge_seconds_ = 0, cpu_before_ = 0;
  std::uint64_t peak_bytes_ = 0;
  std::string out_, err_;
};

IsolatedRasterizer::IsolatedRasterizer(const std::string& library, const IsolationOptions& options,
                                       const PluginDrawing& drawing)
    : judge_(std::make_unique<Judge>(library, options, drawing)) {}
IsolatedRasterizer::~IsolatedRasterizer() = default;

const PluginDescription& IsolatedRasterizer::description() const {
  return judge_->description();
}

PolygonWants IsolatedRasterizer::wants() const {
  farop_rasterizer table{};
  table.wants = judge_->description().wants;
  return polygon_wants(table);
}

void IsolatedRasterizer::begin_frame(const ScreenFrame& frame) {
  judge_->begin_frame(frame);
}

void IsolatedRasterizer::polygons(const ScreenPolygonBatch& batch) {
  judge_->polygons(batch);
}

void IsolatedRasterizer::end_frame() {
  judge_->end_frame();
}

bool IsolatedRasterizer::draws_here() const {
  return judge_->draws_here();
}

Framebuffer IsolatedRasterizer::take() {
  return judge_->take();
}

const std::vector<PluginFinding>& IsolatedRasterizer::findings() const {
  return judge_->findings();
}

RunnerReport IsolatedRasterizer::report() const {
  return judge_->report();
}

}  // namespace farop
