#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# run.sh FAROP_REPORT_DEMO: writes a report and drives it in a browser. Exit status 77: a tool is missing.
set -euo pipefail
command -v node > /dev/null || { echo "skipped: Node is missing"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" > "$folder/report.html"
node "$(dirname "$0")/report_test.mjs" "$folder/report.html"
