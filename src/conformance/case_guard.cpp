// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "conformance/case_kinds.h"

namespace farop::conformance {

void run_guarded(Run& run, const Case& c, Outcome& out, CaseResult& row) {
  if (!run.maker.can_guard()) {
    row.status = CaseStatus::skipped, row.reason = "its memory cannot be guarded";
    return;
  }
  // The frame touches a guard with its end and its beginning in turns: everything twice.
  const std::unique_ptr<Subject> life = run.maker.make_guarded();
  for (const Drawing& d : c.drawings) {
    const Drawing given = run.maker.as_given(d);
    for (int turn = 0; turn < 2; ++turn) {
      if (!run.picture_of(c, *life, given, out)) return;
      ++row.judged;
    }
  }
}

}  // namespace farop::conformance
