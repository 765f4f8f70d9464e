// SPDX-License-Identifier: GPL-3.0-or-later
// What the viewer of the page needs of an example, beside its pictures.
#pragma once

#include <nlohmann/json.hpp>

#include "conformance/result.h"

namespace farop::conformance_report {

/// {w, h, c, case, polygons: [[[x, y, z, r, g, b] ...] ...], wrong: [[x, y, kind, measured z or null] ...],
/// owners: [owner, run length ...]}. Polygons end where their corners get too many for a page.
nlohmann::ordered_json viewer_data(const conformance::Example& example);

/// Where the two pictures differ, brightened so that a difference of one is seen; empty without both.
Framebuffer difference_picture(const conformance::Example& example);

}  // namespace farop::conformance_report
