#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `farop check` on every mutant and every innocent and compares with mutants/manifest.tsv.

kill_matrix.py --farop PROGRAM --mutants DIR --innocents DIR [--short | --examples] [--seeds N] [--thorough] [--jobs N] [NUMBER ...]

The default level, or with --short for each mutant no more than the families up to the one that has to find it; innocents
all that are about pictures. It looks for no small examples then.

--examples looks at the smallest drawing of the verdict that each mutant must get: two polygons at most, and the printed
command repeats it; with --sample at those of some mutants only. FAROP_LONG_TESTS=1 in the environment takes --short and
--sample back, and gives the innocents 20 seeds.

Prints a line for each: its verdicts, each with the family of the first case that shows it, and what is wrong with them.
Exit status: 0 all as the manifest says, 1 not, 2 wrong usage."""
import argparse
import concurrent.futures
import fnmatch
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

FAMILIES = ["smoke", "cov", "tile", "depth", "colour", "meta", "abi", "det", "mem", "perf"]


def manifest(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def check(program, library, options):
    """-> (exit status, [(severity, verdict, detail, family)]); findings are the lines that begin with E, W or I."""
    return check_words(program, [str(library), *options], None)


def check_words(program, words, folder):
    done = subprocess.run([program, "check", "--no-progress", *words], stdout=subprocess.PIPE, cwd=folder,
                          stderr=subprocess.PIPE, text=True, timeout=1800, check=False)
    findings = []
    for line in done.stdout.splitlines():
        words = line.split()
        if len(words) >= 6 and words[0] in ("E", "W", "I"):
            findings.append((words[0], words[1], words[2], words[5].split("/")[0]))
    return done.returncode, findings


MOST_POLYGONS = 2
# One of each kind that examples come in: single pixels, neighbours, crashes, wrong memory, order, measured depth, colour,
# memory, state.
SAMPLE = {"2", "13", "24", "33", "34", "36", "43", "46", "49", "51", "53", "59", "64", "65"}
# Nothing to repeat: another pixel in every run; times, which have no example.
NOT_REPEATED = {"66", "67", "68"}


def faults_of_examples(row, program, library, folder):
    """What is wrong with the smallest drawing of the verdict that a mutant must get, and with its printed command."""
    patterns = re.split("[,&]", row["verdict"])
    done = subprocess.run([program, "check", str(library), "--no-progress", "--json", "r.json", "--examples", "found",
                           *families_for(row)], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          timeout=1800, check=False)
    report = json.loads((folder / "r.json").read_text(encoding="utf-8"))
    mine = [f for f in report["findings"]
            if any(fnmatch.fnmatchcase(f["verdict"], p.partition(":")[0]) for p in patterns)]
    if not mine:
        return [f"no example of {row['verdict']}: {done.stderr}"]
    faults = []
    for finding in mine:
        example = finding["example"]
        if not example:
            faults.append(f"{finding['verdict']}: no example")
            continue
        count = int(example["flat"].split()[4]) if example["flat"] else 0
        if example["shrunk"] and count > MOST_POLYGONS:
            faults.append(f"{finding['verdict']}: {count} polygons")
        words = shlex.split(example["command"])
        if words[:2] != ["farop", "check"]:
            faults.append(f"{finding['verdict']}: no command to repeat it")
            continue
        status, again = check_words(program, words[2:], folder)
        kind = finding["verdict"].partition(".")[0]
        alike = [f for f in again if f[0] == finding["severity"] or f[0] == "E"]
        if not alike or (finding["severity"] == "E" and status != 1):
            faults.append(f"{finding['verdict']}: not repeated by {example['command']}")
        elif kind in ("crash", "oob", "depth", "colour", "det", "abi") and not any(
                f[1].partition(".")[0] == kind for f in again):
            faults.append(f"{finding['verdict']}: repeated as {again[0][1]} by {example['command']}")
    return faults


def found(pattern, findings):
    verdict, _, detail = pattern.partition(":")
    return [f for f in findings if fnmatch.fnmatchcase(f[1], verdict) and detail in ("", f[2])]


def faults_of(row, status, findings):
    """What a mutant's findings lack."""
    if status not in (0, 1):
        return [f"exit status {status}"]
    if "&" in row["verdict"]:
        faults = [f"no {p}" for p in row["verdict"].split("&") if not found(p, findings)]
        expected = row["verdict"].split("&")
    else:
        expected = row["verdict"].split(",")
        faults = [] if any(found(p, findings) for p in expected) else [f"no {row['verdict']}"]
    errors = [f for f in findings if f[0] == "E"]
    if row["alone"] == "yes":
        faults += [f"not alone: {f[1]}" for f in errors if not any(f in found(p, findings) for p in expected)]
    if row["alone"] == "no E":
        faults += [f"an error: {f[1]}" for f in errors]
    return faults


def families_for(row):
    """--family ... for a mutant: smoke and cov say how the others are judged."""
    families = dict.fromkeys(["smoke", "cov", *row["family"].split(",")])
    if row["alone"] == "yes":
        families |= dict.fromkeys(["tile", "colour"])  # where a wrong rule would show next
    if "perf" in families:
        del families["cov"]  # every picture is right
    return [word for family in families for word in ("--family", family)]


def cells(findings):
    """Verdicts under the family of their first case."""
    return "  ".join(f"{family}: " + ", ".join(
        f[1] + ("" if f[2] == "-" else f" {f[2]}") + ("" if f[0] == "E" else f" ({f[0]})")
        for f in findings if f[3] == family)
        for family in sorted({f[3] for f in findings}, key=lambda f: FAMILIES.index(f) if f in FAMILIES else 99))


def look_at_examples(rows, options):
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, tempfile.TemporaryDirectory() as top:
        def look(row):
            folder = pathlib.Path(top) / row["number"]
            folder.mkdir()
            return faults_of_examples(row, options.farop, options.mutants / f"mutant_{int(row['number']):02}.so", folder)
        runs = [(row, pool.submit(look, row)) for row in rows
                if row["number"] not in NOT_REPEATED and (not options.sample or row["number"] in SAMPLE)]
        for row, run in runs:
            faults = run.result()
            wrong += bool(faults)
            print(f"{row['number']:>3} {row['name']:<24} {'ok' if not faults else ''}", flush=True)
            for fault in faults:
                print(f"      MISMATCH {fault}", flush=True)
    print(f"{len(runs)} mutants, {wrong} with examples that are not small or do not repeat")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--farop", required=True)
    parser.add_argument("--mutants", required=True, type=pathlib.Path)
    parser.add_argument("--innocents", required=True, type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=1, help="of the innocents")
    parser.add_argument("--short", action="store_true", help="only the families that a mutant needs")
    parser.add_argument("--examples", action="store_true",
                        help="look at the examples instead: few polygons, and repeated by their command")
    parser.add_argument("--sample", action="store_true", help="examples of some mutants only")
    parser.add_argument("--thorough", action="store_true", help="for the innocents")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("numbers", nargs="*", help="only these mutants, and no innocents")
    options = parser.parse_args()

    if os.environ.get("FAROP_LONG_TESTS") == "1":
        options.short, options.sample, options.seeds = False, False, max(options.seeds, 20)
    rows = manifest(pathlib.Path(__file__).parent / "mutants" / "manifest.tsv")
    if options.numbers:
        rows = [row for row in rows if row["number"] in options.numbers]
    innocents = [] if options.numbers else sorted(
        p for p in options.innocents.glob("*.so") if not p.stem.endswith("_sanitized"))
    if not rows or not (innocents or options.numbers):
        parser.error("nothing to run")
    wrong = 0
    options.farop = str(pathlib.Path(options.farop).resolve())
    options.mutants = options.mutants.resolve()
    if options.examples:
        return look_at_examples(rows, options)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        runs = [(row, pool.submit(check, options.farop, options.mutants / f"mutant_{int(row['number']):02}.so",
                                  [*families_for(row), "--no-shrink"] if options.short else []))
                for row in rows]
        level = ["--thorough"] if options.thorough else []
        if options.short:
            level += ["--no-shrink", *(w for f in ("smoke", "cov", "tile", "depth", "colour", "mem")
                                       for w in ("--family", f))]
        trials = [(path, seed, pool.submit(check, options.farop, path, level + ["--seed", str(seed)]))
                  for path in innocents for seed in range(1, options.seeds + 1)]
        for row, run in runs:
            status, findings = run.result()
            faults = faults_of(row, status, findings)
            wrong += bool(faults)
            print(f"{row['number']:>3} {row['name']:<24} {cells(findings) or '-'}", flush=True)
            for fault in faults:
                print(f"      MISMATCH {fault}", flush=True)
        for path, seed, run in trials:
            status, findings = run.result()
            accused = status != 0 or bool(findings)
            wrong += accused
            print(f"{path.stem:<28} seed {seed}: {cells(findings) or '-'}", flush=True)
            if accused:
                print(f"      MISMATCH accused, exit status {status}", flush=True)
    print(f"{len(runs)} mutants, {len(trials)} runs of innocents, {wrong} not as the manifest says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
