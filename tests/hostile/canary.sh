#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What a test of the cage compares before and after a plug-in has run.
#
#   canary.sh plant FOLDER...   puts a file "farop-canary" into each
#   canary.sh sum FOLDER...     prints one checksum over names, types, modes, owners and contents of all that is in them
#   canary.sh processes         lists processes whose name is "farop-hostile": survivors; fails if there are any
#   canary.sh clear FOLDER...   removes what "plant" and the plug-ins of rows 32 and 33 leave
set -eu
what=${1:-}
[ $# -gt 0 ] && shift
case $what in
plant)
  for folder; do
    printf 'results of somebody else\n' > "$folder/farop-canary"
  done
  ;;
sum)
  # Types and modes first, then contents: reading a FIFO would hang, so regular files only.
  for folder; do
    find "$folder" -printf '%P %y %m %U:%G %l\n' | LC_ALL=C sort
    find "$folder" -type f -print0 | LC_ALL=C sort -z | xargs -0 -r sha256sum
  done | sha256sum | cut -d ' ' -f 1
  ;;
processes)
  found=0
  for comm in /proc/[0-9]*/task/[0-9]*/comm; do
    name=
    read -r name 2> /dev/null < "$comm" || continue
    if [ "$name" = farop-hostile ]; then
      echo "$comm"
      found=1
    fi
  done
  exit $found
  ;;
clear)
  for folder; do
    rm -rf "$folder/farop-canary" "$folder/farop-canary-2" "$folder/farop-canary-fill"
  done
  ;;
*)
  echo "usage: $0 plant|sum|processes|clear [FOLDER...]" >&2
  exit 2
  ;;
esac
