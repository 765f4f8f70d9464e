// SPDX-License-Identifier: GPL-3.0-or-later
// How each kind of case is drawn and judged: problems and evidence go to `out`, counts of samples to `row`,
// whose id is set. For src/conformance/case_*.cpp.
#pragma once

#include <span>
#include <vector>

#include "conformance/run.h"

namespace farop::conformance {

/// Any case but one of a sheet.
void run_case(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);

/// Small cases as tiles of one frame; `rows` are theirs.
constexpr int k_tile = 8, k_tiles = 32, k_sheet = k_tile * k_tiles, k_tile_origin = 2;
void run_sheet(Run& run, const std::vector<const Case*>& cases, Subject& subject, Outcome& out,
               std::span<CaseResult> rows);

void run_coverage(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);
void run_pictures(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);
void run_tiling(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);
void run_probe(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);
void run_ties(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);
void run_relation(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);
void run_repeat(Run& run, const Case& c, Outcome& out, CaseResult& row);
void run_guarded(Run& run, const Case& c, Outcome& out, CaseResult& row);
/// Picture, order of neighbours, depths, a second frame and other memory: the first that is wrong.
void run_file(Run& run, const Case& c, Subject& subject, Outcome& out, CaseResult& row);
/// In turns with the reference; nothing else should run meanwhile.
void run_growth(Run& run, const Case& c, Outcome& out, CaseResult& row);

/// One picture of a case, sample by sample.
void judge_picture(const Run& run, const Case& c, const Drawing& given, const Framebuffer& picture,
                   Outcome& out, CaseResult& row);
/// Nothing where no colour was truncated.
void note_truncation(const Run& run, const Case& c, const Drawing& given, std::uint64_t truncated,
                     const Framebuffer& picture, Outcome& out);
bool same_picture(const Framebuffer& a, const Framebuffer& b);

}  // namespace farop::conformance
