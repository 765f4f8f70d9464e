// SPDX-License-Identifier: GPL-3.0-or-later
// Does: prints terminal escape sequences: title, clear, colours, clipboard, hyperlink, answer-back.
// Why:  a terminal obeys them; the one who reads the report has not asked for that.
#include "../hostile.h"

static const char* const lines[] = {
    "\033[2J\033[H\033[31mcleared\033[0m",
    "\033]0;title\007",
    "\033]52;c;ZWNobyBoaQ==\007",
    "\033]8;;file:///etc/passwd\033\\link",
    "\033[c\033[6n\033[5n",
    ("\x9B"
     "31m"),
    "\033P$q\"p\033\\",
    "\u202Eright to left",
};

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
    hostile.host->log(hostile.host, FAROP_LOG_WARNING, lines[i]);
    dprintf(STDOUT_FILENO, "%s\n", lines[i]);
    dprintf(STDERR_FILENO, "%s\n", lines[i]);
  }
  return FAROP_OK;
}

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  static const struct hostile_hooks hooks = {.before = deed};
  farop_rasterizer* table = hostile_start(host, &hooks);
  table->summary = "\033[31mred\033[0m";
  return table;
}
