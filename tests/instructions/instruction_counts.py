#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts the instructions of counted_work by callgrind and compares them with counts.json beside this file.

    instruction_counts.py PROGRAM --compiler NAME [--record]

A stage, or a function of it, that takes over 5 % of the stage more than recorded fails. --record writes what was counted.
Instructions of shared libraries do not count: they depend on the processor. Exit status 77: nothing to compare with.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

ALLOWED = 0.05
SHOWN = 0.02  # functions of a smaller share are recorded together
RECORD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "counts.json")


def count(program, stage):
    """Instructions by function, of the program's own object file."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "callgrind.out")
        subprocess.run(["valgrind", "--tool=callgrind", "--callgrind-out-file=" + out, "--toggle-collect=counted",
                        "--compress-strings=no", "--compress-pos=no", program, stage],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        counts, function, own, called = {}, None, False, False
        with open(out, encoding="utf-8") as lines:
            for line in lines:
                if line.startswith("ob="):
                    own = os.path.basename(line[3:].strip()) == os.path.basename(program)
                elif line.startswith("fn="):
                    function = line[3:].strip()
                elif line.startswith("calls="):
                    called = True  # the next line is the cost of the function called
                elif re.match(r"^[0-9+*-]", line):
                    if own and not called:
                        name = plain_name(function)
                        counts[name] = counts.get(name, 0) + int(line.split()[1])
                    called = False
        return counts


def plain_name(function):
    """Without parameters, templates' arguments and recursion marks: one line for all of its forms."""
    name = re.sub(r"'\d+$", "", function).replace("(anonymous namespace)::", "")
    previous = None
    while previous != name:  # the innermost brackets first
        previous, name = name, re.sub(r"<[^<>]*>|\([^()]*\)|\[[^\[\]]*\]", "", name)
    return name.replace(" const", "").split(" ")[-1] or function


def summary(counts):
    total = sum(counts.values())
    shown = {name: n for name, n in counts.items() if n >= SHOWN * total}
    return {"total": total, "functions": dict(sorted(shown.items(), key=lambda item: -item[1]))}


def rises(stage, recorded, now, functions):
    """What takes over 5 % of the stage more than it did, in words."""
    allowed, shown = ALLOWED * recorded["total"], SHOWN * recorded["total"]
    # A function that is not recorded had less than the share shown.
    grown = {name: n - recorded["functions"].get(name, min(n, shown)) for name, n in functions.items()}
    by_growth = sorted(grown, key=lambda name: -grown[name])
    found = [f"{stage}: {name} takes {functions[name]:,} instructions, {grown[name]:,.0f} more than before"
             for name in by_growth if grown[name] > allowed]
    rise = now["total"] / recorded["total"] - 1
    if rise > ALLOWED:
        most = [name for name in by_growth[:3] if grown[name] > 0]
        found.append(f"{stage}: {now['total']:,} instructions, {rise:+.1%}; most of it in {', '.join(most) or 'small functions'}")
    return found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--compiler", required=True)
    parser.add_argument("--record", action="store_true")
    arguments = parser.parse_args()
    recorded = json.load(open(RECORD, encoding="utf-8")) if os.path.exists(RECORD) else None
    if not arguments.record and (recorded is None or recorded["compiler"] != arguments.compiler):
        print(f"skipped: counts are recorded for {recorded and recorded['compiler']}, this is {arguments.compiler}")
        return 77
    result, complaints = {"compiler": arguments.compiler}, []
    for stage in ("parse", "geometry", "raster"):
        functions = count(arguments.program, stage)
        result[stage] = summary(functions)
        if arguments.record:
            print(f"{stage}: {result[stage]['total']:,} instructions")
            continue
        change = result[stage]["total"] / recorded[stage]["total"] - 1
        print(f"{stage}: {result[stage]['total']:,} instructions, {change:+.2%}")
        complaints += rises(stage, recorded[stage], result[stage], functions)
    if arguments.record:
        with open(RECORD, "w", encoding="utf-8") as file:
            json.dump(result, file, indent=1)
            file.write("\n")
    for complaint in complaints:
        print("RISE " + complaint)
    if complaints:
        print("Make it faster again, or, where more work is wanted, record it: " + " ".join(sys.argv) + " --record")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
