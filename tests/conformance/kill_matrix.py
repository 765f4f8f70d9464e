#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `farop check` on every mutant and every innocent and compares with mutants/manifest.tsv.

kill_matrix.py --farop PROGRAM --mutants DIR --innocents DIR [--short | --examples] [--jobs N] [NUMBER ...]
kill_matrix.py --farop PROGRAM --mutants DIR --innocents DIR --innocents-only [--also NAME ...] [--seeds N] [--thorough] [--jobs N]

The default level, or with --short for each mutant no more than the families up to the one that has to find it; innocents
all that are about pictures. It looks for no small examples then.

--examples looks at the smallest drawing of the verdict that each mutant must get, and prints its number of polygons: two at
most, and the printed command repeats it; with --sample at those of some mutants only. FAROP_LONG_TESTS=1 in the environment takes --short and
--sample back, and gives the innocents 20 seeds.

--also adds rasterizers by name: shipped ones, and `internal`. Seed 1 meets all families, other seeds those with cases
that depend on the seed.

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
# Right pictures, only slow: nothing to shrink.
TIMED = {"66", "67"}
# Another pixel in every run: no drawing is known to fail again, but the command does so nearly always.
VARYING = {"68"}


def agrees(told, report):
    """Whether the lines of --jsonl say what the report says."""
    rows = {case["id"]: (case["status"], case["verdicts"]) for case in map(json.loads, told)}
    return len(told) == len(report["cases"]) and all(
        rows.get(case["id"]) == (case["status"], case["verdicts"]) for case in report["cases"])


def repeats(program, finding, folder):
    """What is wrong with an example's command: nothing if it shows the fault again."""
    command = finding["example"]["command"]
    words = shlex.split(command)
    if words[:2] != ["farop", "check"]:
        return "no command to repeat it"
    status, again = check_words(program, words[2:], folder)
    kind = finding["verdict"].partition(".")[0]
    if not any(f[0] in (finding["severity"], "E") for f in again) or (finding["severity"] == "E" and status != 1):
        return f"not repeated by {command}"
    if kind in ("crash", "oob", "depth", "colour", "det", "abi", "perf") and not any(
            f[1].partition(".")[0] == kind for f in again):
        return f"repeated as {again[0][1]} by {command}"
    return None


def look_at_example(row, program, library, folder):
    """-> (what its examples are, what is wrong with the smallest drawing of the verdict that a mutant must get)."""
    patterns = re.split("[,&]", row["verdict"])
    done = subprocess.run([program, "check", str(library), "--no-progress", "--json", "r.json", "--jsonl", "r.jsonl",
                           "--examples", "found", *families_for(row)],
                          cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=1800,
                          check=False)
    report = json.loads((folder / "r.json").read_text(encoding="utf-8"))
    if not agrees((folder / "r.jsonl").read_text(encoding="utf-8").splitlines(), report):
        return "", ["--jsonl says something else than --json"]
    mine = [f for f in report["findings"]
            if any(fnmatch.fnmatchcase(f["verdict"], p.partition(":")[0]) for p in patterns)]
    if not mine:
        return "", [f"no example of {row['verdict']}: {done.stderr}"]
    sizes, faults = [], []
    for finding in mine:
        if not finding["example"]:
            faults.append(f"{finding['verdict']}: no example")
            continue
        count = finding["example"]["polygons"]
        sizes.append(f"{finding['verdict']} {'-' if row['number'] in TIMED else count}")
        if count > MOST_POLYGONS and row["number"] not in VARYING:
            faults.append(f"{finding['verdict']}: {count} polygons")
        tries = 5 if row["number"] in VARYING else 1
        failed = [repeats(program, finding, folder) for _ in range(tries)]
        # Of a random fault one of its findings has to come back.
        if all(failed) and not (row["number"] in VARYING and finding["verdict"] != "det.rerun"):
            faults.append(f"{finding['verdict']}: {failed[0]}")
    return ", ".join(sizes), faults


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
    if row["verdict"] == "colour.wrong":
        families["scene"] = None  # which must not change the name
    return [word for family in families for word in ("--family", family)]


def cells(findings):
    """Verdicts under the family of their first case."""
    return "  ".join(f"{family}: " + ", ".join(
        f[1] + ("" if f[2] == "-" else f" {f[2]}") + ("" if f[0] == "E" else f" ({f[0]})")
        for f in findings if f[3] == family)
        for family in sorted({f[3] for f in findings}, key=lambda f: FAMILIES.index(f) if f in FAMILIES else 99))


def seeded_groups(program, level):
    """Families, as --family takes them, whose cases are other ones under another seed."""
    done = subprocess.run([program, "check", "--list", "--seed", "2", *level], stdout=subprocess.PIPE, text=True, check=True)
    ids = [line.split()[0] for line in done.stdout.splitlines()]
    return sorted({case.partition("#")[0] for case in ids if case.endswith("@2")})


def look_at_examples(rows, options):
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool, tempfile.TemporaryDirectory() as top:
        def look(row):
            folder = pathlib.Path(top) / row["number"]
            folder.mkdir()
            return look_at_example(row, options.farop, options.mutants / f"mutant_{int(row['number']):02}.so", folder)
        runs = [(row, pool.submit(look, row)) for row in rows
                if not options.sample or row["number"] in SAMPLE]
        for row, run in runs:
            sizes, faults = run.result()
            wrong += bool(faults)
            print(f"{row['number']:>3} {row['name']:<24} {sizes}", flush=True)
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
    parser.add_argument("--innocents-only", action="store_true", help="no mutants")
    parser.add_argument("--also", action="append", default=[], metavar="NAME", help="more that must not be accused")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("numbers", nargs="*", help="only these mutants, and no innocents")
    options = parser.parse_args()

    if os.environ.get("FAROP_LONG_TESTS") == "1":
        options.short, options.sample, options.seeds = False, False, max(options.seeds, 20)
    rows = manifest(pathlib.Path(__file__).parent / "mutants" / "manifest.tsv")
    if options.numbers or options.innocents_only:
        rows = [row for row in rows if row["number"] in options.numbers]
    innocents = [] if options.numbers else sorted(
        p.resolve() for p in options.innocents.glob("*.so") if not p.stem.endswith("_sanitized"))
    innocents += options.also
    if not (rows or options.innocents_only) or not (innocents or options.numbers):
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
        others = level if options.short else level + [
            word for group in seeded_groups(options.farop, level) for word in ("--family", group)]
        trials = [(pathlib.Path(path), seed, pool.submit(check, options.farop, path,
                                                         (level if seed == 1 else others) + ["--seed", str(seed)]))
                  for seed in range(1, options.seeds + 1) for path in innocents]
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
