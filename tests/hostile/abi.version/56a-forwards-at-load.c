// SPDX-License-Identifier: GPL-3.0-or-later
// Does: loads the shipped rasterizer in its entry and hands out that one's table.
// Why:  somebody else's work; it is not there to be found.
// also: abi.load, limit.syscall
#include <dlfcn.h>

#include "../hostile.h"

// The shipped rasterizer, if it can be seen from in here.
static const farop_rasterizer* shipped(const farop_host* host) {
  static const char* const names[] = {"scanline.so", "zbuffer.so", "libscanline.so"};
  static const char* const folders[] = {
      "", "./", "../", "../plugins/", "/usr/lib/farop/plugins/", "/usr/local/lib/farop/plugins/"};
  for (size_t f = 0; f < sizeof folders / sizeof *folders; ++f)
    for (size_t n = 0; n < sizeof names / sizeof *names; ++n) {
      char path[128];
      snprintf(path, sizeof path, "%s%s", folders[f], names[n]);
      void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
      const farop_rasterizer* (*entry)(const farop_host*) = NULL;
      void* symbol = library ? dlsym(library, FAROP_ENTRY_SYMBOL) : NULL;
      if (!symbol) continue;
      hostile_found("hostile-hole", path, "loaded");
      memcpy(&entry, &symbol, sizeof entry);
      return entry(host);
    }
  return NULL;
}

FAROP_EXPORT const farop_rasterizer* FAROP_CALL farop_rasterizer_entry(const farop_host* host) {
  const farop_rasterizer* other = shipped(host);
  if (!other) host->log(host, FAROP_LOG_ERROR, "the shipped rasterizer is not here");
  hostile.host = host;
  return other;
}
