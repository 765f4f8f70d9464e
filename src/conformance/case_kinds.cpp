// SPDX-License-Identifier: GPL-3.0-or-later
#include "conformance/case_kinds.h"

namespace farop::conformance {

void run_case(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row) {
  if (c.name == "cres" && run.maker.eight_bit_colors()) {
    row.status = CaseStatus::skipped, row.reason = "colours have 8 bits here";
    return;
  }
  if (c.deliver) {
    Case delivered = c;
    delivered.drawings = c.deliver(), delivered.deliver = {};
    if (c.window.samples() == 0) delivered.window = window_of(delivered.drawings.front().frame);
    return run_case(run, delivered, subject, out, row);
  }
  switch (c.kind) {
    case CaseKind::coverage:
      return run_coverage(run, c, subject, out, row);
    case CaseKind::picture:
    case CaseKind::state:
      return run_pictures(run, c, subject, out, row);
    case CaseKind::tiling:
      return run_tiling(run, c, subject, out, row);
    case CaseKind::probe:
      return run_probe(run, c, subject, out, row);
    case CaseKind::ties:
      return run_ties(run, c, subject, out, row);
    case CaseKind::relation:
      return run_relation(run, c, subject, out, row);
    case CaseKind::repeat:
      return run_repeat(run, c, out, row);
    case CaseKind::guard:
      return run_guarded(run, c, out, row);
    case CaseKind::file:
      return run_file(run, c, subject, out, row);
    case CaseKind::growth:
      return run_growth(run, c, out, row);
    case CaseKind::survive:
      for (const Drawing& d : c.drawings) run.picture_of(c, subject, run.maker.as_given(d), out);
      return;
  }
}

}  // namespace farop::conformance
