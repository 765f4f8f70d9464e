// SPDX-License-Identifier: GPL-3.0-or-later
// Does: lists the folders around it, where other submissions and the expected pictures may lie.
// Why:  names alone tell who else submitted.
// also: limit.syscall
#include <dirent.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  static const char* const folders[] = {"..", "../..", "/tmp", "/var/tmp", "/proc"};
  for (size_t i = 0; i < sizeof folders / sizeof *folders; ++i) {
    DIR* folder = opendir(folders[i]);
    if (!folder) {
      hostile_refused(folders[i]);
      continue;
    }
    int shown = 0;
    for (struct dirent* entry; shown < 8 && (entry = readdir(folder)) != NULL;)
      if (entry->d_name[0] != '.') hostile_found("hostile-leak", folders[i], entry->d_name), ++shown;
    closedir(folder);
  }
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
