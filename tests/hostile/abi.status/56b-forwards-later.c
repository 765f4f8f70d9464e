// SPDX-License-Identifier: GPL-3.0-or-later
// Does: loads the shipped rasterizer in the first frame and forwards its calls.
// Why:  the second filter: no library can be loaded any more.
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

static const farop_rasterizer* other;
static void* other_self;

static farop_status begin(const farop_frame* frame) {
  if (!other) other = shipped(hostile.host);
  if (!other) return FAROP_E_INTERNAL;
  if (!other_self && other->create && other->create(hostile.host, &other_self) < 0) return FAROP_E_INTERNAL;
  return other->begin_frame(other_self, frame);
}
static farop_status each(const farop_polygon* polygon) {
  farop_status status = other->polygon(other_self, polygon);
  return status < 0 ? status : HOSTILE_SKIP;
}
static farop_status end(void) {
  return other->end_frame(other_self);
}

HOSTILE_PLUGIN(.begin = begin, .each = each, .end = end)
