// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/error.h"

namespace farop::app {

class Session;

/// Writes session.trace in the Trace Event Format of Chrome and Perfetto to session.options.trace_file: one
/// complete event a slice, microseconds since the run began. Throws as OutputFile.
void write_trace(const Session& session);

/// Writes the run as JSON (schema "farop.stats/1") to session.options.stats_file. Members are only ever
/// added.
void write_stats(const Session& session, ExitStatus status);

}  // namespace farop::app
