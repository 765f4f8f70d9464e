#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# pictures.sh FAROP MUTANTS FOLDER: checks six faulty rasterizers and writes pictures of their reports for the docs.
set -euo pipefail
reports=$(mktemp -d)
trap 'rm -rf "$reports"' EXIT
words=()
for pair in 01=fill-rule 37=upside-down 18=last-row 26=hull 42=depth 59=colour; do
  name=${pair#*=}
  status=0
  "$1" check "$2/mutant_${pair%=*}.so" -q --report "$reports/$name.html" > /dev/null || status=$?
  [ "$status" -eq 1 ] || { echo "mutant ${pair%=*}: exit status $status" >&2; exit 1; }
  words+=("$name=$reports/$name.html")
done
node "$(dirname "$0")/pictures.mjs" "$3" "${words[@]}"
