// SPDX-License-Identifier: GPL-3.0-or-later
// Does: stores a key in its process keyring.
// Why:  keyrings pass data between sandboxes of one user.
// also: crash.sigsys, pass
#include <linux/keyctl.h>

#include "../hostile.h"

static farop_status deed(const farop_polygon* polygon) {
  (void)polygon;
  hostile_must_fail("add_key",
                    syscall(SYS_add_key, "user", HOSTILE_MARKER, "x", 1, KEY_SPEC_PROCESS_KEYRING));
  hostile_must_fail("keyctl", syscall(SYS_keyctl, KEYCTL_GET_KEYRING_ID, KEY_SPEC_PROCESS_KEYRING, 0));
  return FAROP_OK;
}

HOSTILE_PLUGIN(.before = deed)
