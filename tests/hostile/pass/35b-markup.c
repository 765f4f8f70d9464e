// SPDX-License-Identifier: GPL-3.0-or-later
// Does: prints script elements, CDATA ends, attribute breaks, JSON and CSV fragments.
// Why:  each ends up in a report of a format that has its own way of being broken.
#include "../hostile.h"

static const char* const lines[] = {
    "<script>document.title='hostile'</script>",
    "<img src=x onerror=alert(1)>",
    "\"><svg onload=alert(1)>",
    "]]></system-out><failure/>",
    "</textarea></style></script>",
    "\",\"status\":\"pass\",\"x\":\"",
    "{\"summary\":{\"failed\":0}}",
    "=cmd|' /C calc'!A0",
    "&amp;&#x3C;&lt;",
    "' OR 1=1 --",
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
  table->summary = "\"><img src=x onerror=alert(1)>";
  return table;
}
