// SPDX-License-Identifier: GPL-3.0-or-later
// Does: installs a SIGSEGV handler that steps over the faulting store, then writes all around the frame.
// Why:  a handler may hide the fault at the guard page, not the bytes in the apron on the other side.
// also: oob.write-after, crash.segv
// only: x86_64
#define _GNU_SOURCE 1
#include <signal.h>
#include <ucontext.h>

#include "../hostile.h"

static volatile greg_t resume_at;

static void step_over(int signal_number, siginfo_t* info, void* context) {
  (void)signal_number, (void)info;
  ((ucontext_t*)context)->uc_mcontext.gregs[REG_RIP] = resume_at;
}

__attribute__((noinline)) static void store(uint8_t* at, uint8_t value) {
  __asm__ volatile(
      "leaq 1f(%%rip), %%rax\n\t"
      "movq %%rax, %0\n\t"
      "movb %2, (%1)\n"
      "1:"
      : "=m"(resume_at)
      : "r"(at), "q"(value)
      : "rax", "memory");
}

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_sigaction = step_over;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  sigaction(SIGSEGV, &action, NULL);
  sigaction(SIGBUS, &action, NULL);
  for (int i = 1; i <= 96; ++i) store(hostile.frame.pixels - i, (uint8_t)(i * 37));
  for (int i = 0; i < 96; ++i) store(hostile_frame_end() + i, (uint8_t)(i * 41));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.after = deed)
