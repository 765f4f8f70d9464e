// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens /etc/passwd, /etc/hostname and the C library's configuration and says so.
// Why:  opening is refused politely, so the picture may be right; nothing of it may show in any output.
// also: pass
// But:  opening to read is refused without a word, as libraries do it in passing; so a right picture passes.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_read("/etc/passwd");
  hostile_read("/etc/hostname");
  hostile_read("/etc/nsswitch.conf");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
