// SPDX-License-Identifier: GPL-3.0-or-later
// Does: opens the judge's memory as a file and writes a byte of it, the one that is there.
// Why:  /proc/PID/mem passes by every filter of system calls but the one on open().
// also: crash.sigsys
#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pid_t judge = hostile_judge();
  if (judge == 0) judge = getpid();
  char path[64], line[256];
  unsigned long address = 0;
  snprintf(path, sizeof path, "/proc/%d/maps", (int)judge);
  FILE* maps = fopen(path, "re");
  while (maps && !address && fgets(line, sizeof line, maps))
    if (strstr(line, " rw")) address = strtoul(line, NULL, 16);
  if (maps) fclose(maps);
  snprintf(path, sizeof path, "/proc/%d/mem", (int)judge);
  int fd = open(path, O_RDWR | O_CLOEXEC);
  hostile_must_fail("open of the judge's memory", fd);
  char byte;
  if (fd >= 0 && pread(fd, &byte, 1, (off_t)address) == 1)
    hostile_must_fail("write to the judge's memory", (long)pwrite(fd, &byte, 1, (off_t)address));
  if (fd >= 0) close(fd);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
