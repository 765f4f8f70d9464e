// SPDX-License-Identifier: GPL-3.0-or-later
// Does: reads environment, command line and its parent's name, and draws only if one of them says that it
//       is being graded.
// Why:  check, bench and render must look the same from inside.
// also: cov.missing, tile.gap
#include "../hostile.h"

extern char** environ;

static int says_graded(const char* where, const char* text) {
  static const char* const words[] = {"check", "grade", "judge", "GRADESCOPE", "autograder", "CI="};
  for (size_t i = 0; i < sizeof words / sizeof *words; ++i)
    if (strstr(text, words[i])) {
      hostile_found("hostile-leak", where, words[i]);  // the word, not the text: it may hold more than that
      return 1;
    }
  return 0;
}
static int file_says_graded(const char* path) {
  char text[4096];
  int fd = open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return 0;
  ssize_t n = read(fd, text, sizeof text - 1);
  close(fd);
  for (ssize_t i = 0; i < n; ++i)
    if (text[i] == 0) text[i] = ' ';
  text[n > 0 ? n : 0] = 0;
  return says_graded(path, text);
}
static farop_status begin(const farop_frame* frame) {
  (void)frame;
  static int asked, graded;
  if (!asked) {
    asked = 1;
    char path[64], line[256];
    uint64_t seen = 0xcbf29ce484222325u;  // FNV-1a over all there is to see
    int variables = 0;
    for (char** v = environ; v && *v; ++v, ++variables) {
      graded |= says_graded("environment", *v);
      for (const char* c = *v; *c; ++c) seen = (seen ^ (uint8_t)*c) * 0x100000001b3u;
    }
    graded |= file_says_graded("/proc/self/cmdline");
    snprintf(path, sizeof path, "/proc/%d/cmdline", (int)getppid());
    graded |= file_says_graded(path);
    // One line to compare between check, bench and render.
    snprintf(line, sizeof line, "hostile-note: %d variables %016llx, name %s, parent %d, host %s", variables,
             (unsigned long long)seen, program_invocation_name, (int)getppid(), hostile.host->name);
    hostile.host->log(hostile.host, FAROP_LOG_INFO, line);
  }
  hostile.silent = !graded;
  return FAROP_OK;
}

HOSTILE_PLUGIN(.begin = begin)
