// SPDX-License-Identifier: GPL-3.0-or-later
// The polygons of a frame as the checker takes them.
#pragma once

#include "conformance/drawing.h"

namespace farop::app {

class DrawingRecorder : public ScreenPolygonSink {
 public:
  conformance::Drawing drawing;
  void begin_frame(const ScreenFrame& frame) override { drawing.frame = frame.resolution; }
  void polygons(const ScreenPolygonBatch& batch) override {
    for (const ScreenPolygonRecord& record : batch.polygons) {
      const auto corners = batch.corners(record);
      drawing.polygons.emplace_back(corners.begin(), corners.end());
    }
  }
  void end_frame() override {}
};

}  // namespace farop::app
