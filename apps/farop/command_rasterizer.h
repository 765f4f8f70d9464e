// SPDX-License-Identifier: GPL-3.0-or-later
// A user's program in any language as a rasterizer: it reads a flat file and writes a PPM.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/color.h"
#include "core/framebuffer.h"
#include "core/output_file.h"
#include "core/screen_polygon.h"
#include "export/flat_writer.h"

namespace farop::app {

/// A folder of its own in the system's temporary folder, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// `command` is a shell command; {flat} and {ppm} in it stand for the two files (quoted). It runs when the
/// frame ends, with standard input closed and standard output going to standard error, which is ours to use
/// for data. Throws Error(usage) for a command without the two words, Error(plugin) when it fails or what it
/// left is no picture of the expected size, Error(surroundings) when files cannot be written.
class CommandRasterizer : public ScreenPolygonSink {
 public:
  /// samples  degree of super-sampling: the program draws so many times as large, the host averages.
  CommandRasterizer(std::string command, int samples);
  ~CommandRasterizer() override;

  void begin_frame(const ScreenFrame& frame) override;
  void polygons(const ScreenPolygonBatch& batch) override { writer_->polygons(batch); }
  void end_frame() override;
  Framebuffer take();

 private:
  void run() const;
  std::filesystem::path flat_file() const { return folder_.path() / "polygons.scr"; }
  std::filesystem::path ppm_file() const { return folder_.path() / "picture.ppm"; }

  std::string command_;
  int samples_;
  TemporaryFolder folder_;
  ScreenFrame frame_;
  std::unique_ptr<OutputFile> flat_;
  std::unique_ptr<FlatWriter> writer_;
  Framebuffer picture_;
};

}  // namespace farop::app
