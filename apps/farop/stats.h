// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"

namespace farop::app {

class Session;

/// Writes the run as JSON (schema "farop.stats/1") to session.options.stats_file. Members are only ever
/// added.
void write_stats(const Session& session, ExitStatus status);

}  // namespace farop::app
