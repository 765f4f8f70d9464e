// SPDX-License-Identifier: GPL-3.0-or-later
// Does: prints what CI services take for commands.
// Why:  a line in the right form sets variables, hides output or fails somebody's job.
#include "../hostile.h"

static const char* const lines[] = {
    "##vso[task.complete result=Succeeded;]DONE",
    "::error file=a.c,line=1::hostile",
    "::set-output name=grade::100",
    "::stop-commands::hostile",
    "##teamcity[buildStatus status='SUCCESS']",
    "section_start:0:hostile\r\033[0K",
    "ok 1 - everything",
    "1..0 # skipped",
    "Bail out!",
    "done 0 pass",
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
  table->summary = "::error::hostile";
  return table;
}
