// SPDX-License-Identifier: GPL-3.0-or-later
// Does: names a folder of its own to look for a library in; the library's constructor says that it runs.
// Why:  a second library that nobody has looked at.
// also: pass
// But:  where neither namespaces nor Landlock stand, the loader finds the second library and may load it.
#include "../hostile.h"

__attribute__((visibility("default"))) void farop_hostile_second(
    void);  // from helpers/second.c, beside this plug-in

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  farop_hostile_second();
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
