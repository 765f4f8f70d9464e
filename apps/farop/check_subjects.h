// SPDX-License-Identifier: GPL-3.0-or-later
// Rasterizers of every kind in the form that the checker draws with.
#pragma once

#include <memory>

#include "conformance/subject.h"
#include "rasterizer_options.h"
#include "run_facts.h"
#include "session.h"

namespace farop::app {

/// What is to be checked; what it prints goes to `printed`, too. Session and `printed` must outlive it.
/// Throws Error(plugin) for a file that cannot be loaded here at all; a library that fails in its own process
/// is the checker's finding.
std::unique_ptr<conformance::SubjectMaker> make_subjects(Session& session, const ChosenRasterizer& chosen,
                                                         const RasterizerOptions& how, std::uint64_t seed,
                                                         PrintedLines& printed);

/// The depth buffer that comes with farop, for comparing times; null where it is not installed.
std::unique_ptr<conformance::SubjectMaker> make_reference(Session& session, const RasterizerOptions& how,
                                                          PrintedLines& printed);

/// Draws right and writes every drawing as a flat file into `folder`: HASH.scr. For rasterizers on other
/// machines; their pictures are HASH.ppm, in the same folder, on a black background, and their depths, where
/// they can tell them, HASH.pgm of the maximum ZRES - 1.
std::unique_ptr<conformance::SubjectMaker> make_emitter(const std::string& folder);
std::unique_ptr<conformance::SubjectMaker> make_picture_reader(const std::string& folder);

/// What the rasterizer says of itself, as far as it can be asked.
conformance::PluginFacts describe_subject(const ChosenRasterizer& chosen, const RasterizerOptions& how,
                                          std::vector<std::string>& walls);

}  // namespace farop::app
