// SPDX-License-Identifier: GPL-3.0-or-later
// The interface of farop/rasterizer.h round a class with begin(frame), polygon(polygon) and end().
#pragma once

#include <new>

#include "canvas.h"

#define FAROP_TEXT_OF(number) #number
#define FAROP_TEXT(number) FAROP_TEXT_OF(number)

template <class Rasterizer>
struct Entry {
  static inline const farop_host* host = nullptr;

  static farop_status create(const farop_host* given, void** self) {
    host = given;
    *self = new (std::nothrow) Rasterizer;
    return *self != nullptr ? FAROP_OK : FAROP_E_MEMORY;
  }
  static void destroy(void* self) { delete static_cast<Rasterizer*>(self); }

  static farop_status begin_frame(void* self, const farop_frame* frame) {
    if (frame->subpixel_bits != 0) {
      host->log(host, FAROP_LOG_ERROR, "whole pixels only");
      return FAROP_E_UNSUPPORTED;
    }
    return guarded([&] { static_cast<Rasterizer*>(self)->begin(*frame); });
  }
  static farop_status polygon(void* self, const farop_polygon* polygon) {
    return guarded([&] { static_cast<Rasterizer*>(self)->polygon(*polygon); });
  }
  static farop_status end_frame(void* self) {
    return guarded([&] { static_cast<Rasterizer*>(self)->end(); });
  }

  /// For farop_rasterizer_entry().
  static const farop_rasterizer* table(const char* summary, std::uint32_t wants) {
    static const farop_rasterizer table = {sizeof table,
                                           FAROP_ABI_VERSION,
                                           "mutant_" FAROP_TEXT(MUTANT),
                                           summary,
                                           wants,
                                           0,
                                           create,
                                           destroy,
                                           begin_frame,
                                           polygon,
                                           end_frame};
    return &table;
  }

 private:
  template <class Work>
  static farop_status guarded(const Work& work) {
    try {
      work();
      return FAROP_OK;
    } catch (const std::bad_alloc&) {
      return FAROP_E_MEMORY;
    }
  }
};
