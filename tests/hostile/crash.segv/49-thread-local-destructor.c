// SPDX-License-Identifier: GPL-3.0-or-later
// Does: crashes in the destructor of thread-local data when its thread ends.
// Why:  the crash is in libc's clean-up, in another thread, and still belongs to the polygon being drawn.
// also: det.threads, limit.threads, limit.syscall, abi.status
// needs: threads allowed
#include <pthread.h>

#include "../hostile.h"

static pthread_key_t key;

static void release(void* value) {
  (void)value;
  hostile_crash();
}
static void* work(void* nothing) {
  pthread_setspecific(key, &key);
  return nothing;
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  pthread_t thread;
  if (pthread_key_create(&key, release) != 0 || pthread_create(&thread, NULL, work, NULL) != 0)
    return FAROP_E_INTERNAL;
  pthread_join(thread, NULL);
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
