// SPDX-License-Identifier: GPL-3.0-or-later
// Screen polygons -> flat file, the text that rasterizers elsewhere read.
//
// Not for keeping scenes: a flat file has whole pixels, lit colours and no materials. Use the NFF writer for
// that.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>

#include "core/output_file.h"
#include "core/screen_polygon.h"

namespace farop {

/// Writes one frame as a flat file (farop.md section 4; the layout is in flat_format.h), numbers exactly as
/// the batches hold them. One block of memory, whatever the scene: the number of polygons, which stands in
/// front of them, is filled in at the end; an output that cannot be written twice (a pipe) is collected in an
/// unlinked temporary file in TMPDIR first. A file and a pipe get the same bytes.
///
/// The output file outlives the writer; the caller commits it after end_frame().
/// Throws Error(ExitStatus::surroundings) when an output cannot be written or there are more than
/// k_max_flat_polygons polygons.
class FlatWriter : public ScreenPolygonSink {
 public:
  explicit FlatWriter(OutputFile& output);

  void begin_frame(const ScreenFrame& frame) override;
  void polygons(const ScreenPolygonBatch& batch) override;
  void end_frame() override;

  std::uint64_t polygon_count() const { return polygon_count_; }

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  void put(std::int64_t value, char separator);
  template <class... Integers>
  void put_line(Integers... values);
  void make_room_for_line();
  void flush();
  void fill_in_count();
  void copy_collected();

  OutputFile& output_;
  std::unique_ptr<std::FILE, CloseFile> collected_;  ///< only where the output is not seekable
  std::unique_ptr<char[]> block_;
  std::size_t used_ = 0;
  std::uint64_t count_offset_ = 0;  ///< of the number of polygons in the file
  std::uint64_t polygon_count_ = 0;
};

}  // namespace farop
