#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# make-bad-files.sh FOLDER GOOD.so PIE NO_PIE: the things of row 50 that are no plug-in, made in FOLDER/abi.load, and
# FOLDER/manifest.txt in the form of the other plug-ins' manifest. Made when a test runs and not when the tree is
# built: a FIFO or a link to /dev/zero in a build folder hangs whoever searches it. All of them: abi.load, no hang.
set -eu
if [ $# -ne 4 ]; then
  echo "usage: $0 FOLDER GOOD.so PIE NO_PIE" >&2
  exit 2
fi
folder=$1 good=$2 pie=$3 no_pie=$4
to=$folder/abi.load
mkdir -p "$to"
rm -rf "$to"/50?-*
# patch FILE OFFSET OCTAL: a copy of the good plug-in with bytes replaced
patch() {
  cp "$good" "$1"
  chmod u+w "$1"
  printf %b "$3" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}
printf 'int main(void) { return 0; }\n' > "$to/50a-not-an-elf.so"
: > "$to/50b-empty.so"
dd if="$good" of="$to/50c-truncated-header.so" bs=40 count=1 status=none
dd if="$good" of="$to/50d-truncated.so" bs=1000 count=1 status=none
patch "$to/50e-32-bit.so" 4 '\0001'            # EI_CLASS = ELFCLASS32
patch "$to/50f-other-machine.so" 18 '\0363\0000'  # e_machine = EM_RISCV
cp "$pie" "$to/50g-program-pie.so"
cp "$no_pie" "$to/50h-program.so"
truncate -s 2G "$to/50i-sparse.so"
mkdir "$to/50j-directory.so"
mkfifo "$to/50k-fifo.so"
ln -s /dev/zero "$to/50l-zero.so"
patch "$to/50m-big-endian.so" 5 '\0002'                                          # EI_DATA = ELFDATA2MSB
patch "$to/50n-headers-beyond-end.so" 32 '\0377\0377\0377\0377\0377\0377\0377\0177'     # e_phoff
patch "$to/50o-no-headers.so" 56 '\0000\0000'                                     # e_phnum
patch "$to/50p-object-file.so" 16 '\0001\0000'                                    # e_type = ET_REL
cp "$good" "$to/50q-unreadable.so"
chmod 0 "$to/50q-unreadable.so"
ln -s 50r-loop.so "$to/50r-loop.so"
# The header of a good one, then 2 GiB of hole: valid at first sight.
cp "$good" "$to/50s-sparse-tail.so"
chmod u+w "$to/50s-sparse-tail.so"
truncate -s 2G "$to/50s-sparse-tail.so"
for file in "$to"/50?-*; do
  name=${file##*/}
  expected=abi.load also=
  case $name in
  50d-*) also=crash.bus,crash.segv ;;  # its header is right: the loader finds out by a signal
  50q-*) [ ! -r "$file" ] || expected=pass ;;  # root may read what nobody may: an honest plug-in then
  esac
  printf '%s\t%s\t%s\t%s\n' "${name%.so}" "$expected" "$also" "$file"
done > "$folder/manifest.txt"
printf '50t-missing\tabi.load\t\t%s\n' "$to/50t-missing.so" >> "$folder/manifest.txt"
