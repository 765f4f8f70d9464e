// SPDX-License-Identifier: GPL-3.0-or-later
// Does: unmaps the frame and draws on.
// Why:  it hurts itself; the judge has a mapping of its own.
// also: frame.blank, limit.syscall, pass
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  uintptr_t first;
  size_t bytes;
  hostile_frame_pages(&first, &bytes);
  munmap((void*)first, bytes);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
