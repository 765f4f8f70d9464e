// SPDX-License-Identifier: GPL-3.0-or-later
// The files of web/, put into the program by embed.cmake.
#pragma once

namespace farop::conformance_report {

extern const char* const k_web_template;  ///< Mustache
extern const char* const k_web_style;
extern const char* const k_web_script;
extern const char* const k_web_script_hash;  ///< as a Content-Security-Policy names it
extern const char* const k_web_portuguese;   ///< JSON, a sentence to its translation

}  // namespace farop::conformance_report
