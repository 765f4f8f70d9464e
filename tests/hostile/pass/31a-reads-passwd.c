// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens /etc/passwd, /etc/hostname and the C library's configuration and says so.
// Why:  libraries open files in passing, so opening fails without a verdict; nothing of it may show anywhere.
// also: limit.syscall
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_read("/etc/passwd");
  hostile_read("/etc/hostname");
  hostile_read("/etc/nsswitch.conf");
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
