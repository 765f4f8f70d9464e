// SPDX-License-Identifier: GPL-3.0-or-later
// Does: prints NUL bytes, invalid UTF-8 and an unfinished line.
// Why:  text from a plug-in is data: shown, not believed.
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  static const char junk[] =
      "\0nul\0 \xC3\x28 \xF0\x9F\x92 \xED\xA0\x80 \xC0\xAF \xFF\xFE \r\b\x7F no newline";
  hostile.host->log(hostile.host, FAROP_LOG_INFO, "\xC3\x28 \xFF\n two\nlines\r");
  if (write(STDOUT_FILENO, junk, sizeof junk - 1) < 0 || write(STDERR_FILENO, junk, sizeof junk - 1) < 0)
    return FAROP_OK;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
