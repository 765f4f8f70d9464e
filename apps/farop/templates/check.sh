#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Draws three scenes with the rasterizer and with FAROP itself, and compares the pictures; status 1 when one differs.
# Usage: check.sh SOURCE RASTERIZER [--triangles]
farop=${FAROP:-farop}
source=$1
rasterizer=./$2
triangles=$3
background='0.078 0.361 0.753' # a flat file has none, and on black a missing polygon in the shade would not show
failed=0

# check_scene NAME [option of farop spd]...
check_scene() {
  file=check/$1
  rm -f "$file".*
  $farop spd "$@" -o "$file.nff" -q &&
    $farop export "$file.nff" -o "$file.scr" --resolution 200x150 $triangles -q &&
    $farop raster "$file.scr" -o "$file.expected.ppm" --background $background -q || exit 4
  if ! $farop raster "$file.scr" -o "$file.mine.ppm" --background $background --rasterizer "$rasterizer" -q; then
    echo "FAIL  $1: it was not drawn"
    failed=1
    return
  fi
  # 0.005 lies between one step of 8 bits, which rounding may cost, and two.
  $farop compare "$file.mine.ppm" "$file.expected.ppm" --fail 0.005 -o "$file.difference.png" -q > "$file.txt"
  case $? in
  0) echo "pass  $1" ;;
  1)
    echo "FAIL  $1: $(sed -n 's/^over --fail *//p' "$file.txt") differ, see $file.difference.png"
    failed=1
    ;;
  *) exit 4 ;;
  esac
}

mkdir -p check || exit 4
check_scene hollow-cube
check_scene teapot --size 3
check_scene gears --size 1
[ $failed = 0 ] && exit 0

echo
echo "In check/, *.expected.ppm is right, *.mine.ppm is yours, and *.difference.png is black where they agree."
if grep -q 'YOUR PART' "$source"; then
  echo "What to do: fill in what is still marked in $source (delete each mark when its part is done):"
  grep -n -o 'YOUR PART [^.]*' "$source" | sort -t: -k2 | sed 's/^/  line /; s/:/: /'
else
  echo "What to do: lines along edges come from the fill rule, patches from the depth test, shades from interpolation."
fi
exit 1
