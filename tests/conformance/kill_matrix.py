#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `farop check` on every mutant and every innocent and compares with mutants/manifest.tsv.

kill_matrix.py --farop PROGRAM --mutants DIR --innocents DIR [--short] [--seeds N] [--thorough] [--jobs N] [NUMBER ...]

The default level, or with --short for each mutant no more than the families up to the one that has to find it; those
that must be alone meet all of them in any case.

Prints a line for each: its verdicts, each with the family of the first case that shows it, and what is wrong with them.
Exit status: 0 all as the manifest says, 1 not, 2 wrong usage."""
import argparse
import concurrent.futures
import fnmatch
import pathlib
import subprocess
import sys

FAMILIES = ["smoke", "cov", "tile", "depth", "colour", "meta", "abi", "det", "mem", "perf"]


def manifest(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    return [dict(zip(lines[0], line)) for line in lines[1:]]


def check(program, library, options):
    """-> (exit status, [(severity, verdict, detail, family)]); findings are the lines that begin with E, W or I."""
    done = subprocess.run([program, "check", str(library), "--no-progress", *options], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, timeout=1800, check=False)
    findings = []
    for line in done.stdout.splitlines():
        words = line.split()
        if len(words) >= 6 and words[0] in ("E", "W", "I"):
            findings.append((words[0], words[1], words[2], words[5].split("/")[0]))
    return done.returncode, findings


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
    if row["alone"] == "yes":
        return []
    families = dict.fromkeys(["smoke", "cov", *(f for f in row["family"].split(",") if f != "mem")])
    if "perf" in families:
        del families["cov"]  # every picture is right
    return [word for family in families for word in ("--family", family)]


def cells(findings):
    """Verdicts under the family of their first case."""
    return "  ".join(f"{family}: " + ", ".join(
        f[1] + ("" if f[2] == "-" else f" {f[2]}") + ("" if f[0] == "E" else f" ({f[0]})")
        for f in findings if f[3] == family)
        for family in sorted({f[3] for f in findings}, key=lambda f: FAMILIES.index(f) if f in FAMILIES else 99))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--farop", required=True)
    parser.add_argument("--mutants", required=True, type=pathlib.Path)
    parser.add_argument("--innocents", required=True, type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=1, help="of the innocents")
    parser.add_argument("--short", action="store_true", help="only the families that a mutant needs")
    parser.add_argument("--thorough", action="store_true", help="for the innocents")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("numbers", nargs="*", help="only these mutants, and no innocents")
    options = parser.parse_args()

    rows = manifest(pathlib.Path(__file__).parent / "mutants" / "manifest.tsv")
    if options.numbers:
        rows = [row for row in rows if row["number"] in options.numbers]
    innocents = [] if options.numbers else sorted(
        p for p in options.innocents.glob("*.so") if not p.stem.endswith("_sanitized"))
    if not rows or not (innocents or options.numbers):
        parser.error("nothing to run")
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        runs = [(row, pool.submit(check, options.farop, options.mutants / f"mutant_{int(row['number']):02}.so",
                                  families_for(row) if options.short else [])) for row in rows]
        level = ["--thorough"] if options.thorough else []
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
