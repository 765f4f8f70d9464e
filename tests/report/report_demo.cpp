// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the page of the synthetic result of the unit tests to standard output.
#include <cstdio>
#include <string>

#include "conformance_report/html_report.h"
#include "sample_result.h"

int main() {
  using namespace farop::conformance_report;
  const std::string page = to_html(sample_result(), Catalogue(Language::english));
  return std::fwrite(page.data(), 1, page.size(), stdout) == page.size() ? 0 : 1;
}
