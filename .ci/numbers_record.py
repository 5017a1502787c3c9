#!/usr/bin/python3
"""Measures a few numbers of the programs and compares them with the record .ci/numbers.csv: instructions of kernels, answers of a bar
and a slab, sizes of programs. A change beyond a number's band fails, unless the same commit changes the record.

usage: .ci/numbers_record.py BUILD                    compares
       .ci/numbers_record.py BUILD --record "reason"  takes the numbers beyond their bands into the record, with the reason

Instructions are counted by callgrind in tests/benchmark/counted.cc, which is compiled for any x86-64 processor; the functions of the C
library are those for that processor too (GLIBC_TUNABLES). So they are the same on every machine with the same compiler and libraries.
Answers and sizes are of the programs as they are built, also with -march=native: their bands hold the round-off of other machines.
"""

import csv
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
RECORD = ROOT / ".ci" / "numbers.csv"
COLUMNS = ["number", "value", "unit", "band", "note"]

KERNELS = ("j2_update", "afc_update", "refresh_nsni", "refresh_subpoint")
PROGRAMS = {"penetrate": "macro/penetrate", "material_point": "macro/material_point", "microcell": "micro/microcell"}
# Runs: name, arguments of penetrate, keys of summary.json that are recorded.
RUNS = (("bar", ["data/scenes/taylor_aluminium.prm", "bar/Rings=4", "bar/Layers=20", "Run/Threads=1"],
         ("final_length_ratio", "foot_diameter", "steps", "bytes_per_point")),
        ("slab", ["data/scenes/slab_127_axis.prm", "Run/Threads=1"], ("exit_velocity", "steps", "energy_balance_error")))
# Functions of the C library for newer processors, which are not to be used.
NEWER = "AVX,AVX2,AVX512F,AVX512VL,AVX_Fast_Unaligned_Load,ERMS,FMA,FMA4,FSRM"


class Failed(Exception):
    """One line: what could not be measured or read."""


def output_of(command, **more):
    done = subprocess.run([str(word) for word in command], cwd=ROOT, capture_output=True, text=True, check=False, **more)
    if done.returncode:
        last = (done.stderr.strip() or "it said nothing").splitlines()[-1]
        raise Failed(f"{pathlib.Path(command[0]).name} ended with exit code {done.returncode}: {last}")
    return done.stdout + done.stderr


def instructions(build, kernel):
    """Returns the instructions of a kernel."""
    environment = {"PATH": os.environ["PATH"],
                   "GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + ",".join(f"-{name}" for name in NEWER.split(","))}
    words = output_of(["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--toggle-collect=counted",
                       build / "tests/benchmark/counted", kernel], env=environment)
    found = re.search(r"Collected : (\d+)", words)
    if not found or int(found[1]) == 0:
        raise Failed(f"callgrind counted nothing in the kernel '{kernel}'")
    return int(found[1])


def answers(build, arguments):
    """Returns the summary of a run. One thread: others have working memory of their own."""
    with tempfile.TemporaryDirectory() as folder:
        output_of([build / "macro/penetrate", *arguments, "--output", folder + "/run"])
        return json.loads((pathlib.Path(folder) / "run/summary.json").read_text(encoding="utf-8"))


def size(program):
    """Returns the bytes of code and constants and of variables, without names and debugging data."""
    return sum(map(int, output_of(["size", program]).splitlines()[1].split()[:2]))


def measure(build):
    """Returns {number: value} of all that is measured."""
    found = {f"instructions_{kernel}": instructions(build, kernel) for kernel in KERNELS}
    for name, arguments, keys in RUNS:
        summary = answers(build, arguments)
        found |= {f"{name}_{key}": summary[key] for key in keys}
    return found | {f"size_{name}": size(build / path) for name, path in PROGRAMS.items()}


def width(row):
    """Returns the allowed change of a number of the record, in its unit."""
    band = row["band"].strip()
    return abs(float(row["value"])) * float(band[:-1]) / 100 if band.endswith("%") else float(band)


def read_record(path):
    """Returns {number: row}, in the order of the file, and the lines of comment before it. @raises Failed"""
    lines = path.read_text(encoding="utf-8").splitlines()
    comment = [line for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if line and not line.startswith("#")))
    if not rows or rows[0] != COLUMNS:
        raise Failed(f"{path}: found the columns {','.join(rows[0]) if rows else '(none)'}, allowed: {','.join(COLUMNS)}")
    record = {}
    for cells in rows[1:]:
        row = dict(zip(COLUMNS, cells))
        try:
            if len(cells) != len(COLUMNS) or not math.isfinite(float(row["value"])) or not width(row) >= 0:
                raise ValueError
        except ValueError:
            raise Failed(f"{path}: found '{','.join(cells)}', allowed: {','.join(COLUMNS)}, with a number as value and a band of its unit "
                         "or in %") from None
        if cells[0] in record:
            raise Failed(f"{path}: names '{cells[0]}' twice")
        record[cells[0]] = row
    return record, comment


def compared(record, found):
    """Returns (number, before, now, allowed change with its unit, verdict) of every number; the verdict is empty where all is well."""
    rows = []
    for name in [*record, *(name for name in found if name not in record)]:
        row, now = record.get(name), found.get(name)
        if row is None:
            rows.append((name, "-", f"{now:.10g}", "-", "is not in the record"))
        elif now is None:
            rows.append((name, row["value"], "-", row["band"], "is not measured any more"))
        else:
            change = abs(now - float(row["value"]))
            unit = "" if row["band"].endswith("%") or row["unit"] == "1" else f" {row['unit']}"
            rows.append((name, row["value"], f"{now:.10g}", f"{row['band']}{unit}",
                         "" if change <= width(row) else "changed beyond its band"))
    return rows


def updated(record, found, reason):
    """Returns the record with the numbers that have left their bands, and new ones, taken in with the reason. New ones have a band of 0,
    which whoever records them replaces."""
    rows = {name: dict(row) for name, row in record.items() if name in found}
    for name, _, now, _, verdict in compared(record, found):
        if verdict and name in found:
            rows[name] = rows.get(name, {"number": name, "unit": "1", "band": "0"}) | {"value": now, "note": reason}
    return rows


def write_record(path, comment, rows):
    with open(path, "w", encoding="utf-8", newline="") as stream:
        stream.writelines(f"{line}\n" for line in comment)
        writer = csv.DictWriter(stream, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows.values())


def report(rows):
    """Prints the table; returns how many numbers are not what they were."""
    table = [("number", "before", "now", "band", ""), *rows]
    widths = [max(len(row[i]) for row in table) for i in range(4)]
    for row in table:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)) + "  " + row[4])
    return sum(bool(row[4]) for row in rows)


def main(arguments):
    recording = len(arguments) == 3 and arguments[1] == "--record" and arguments[2].strip()
    if len(arguments) != 1 and not recording:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        record, comment = read_record(RECORD)
        found = measure(pathlib.Path(arguments[0]).resolve())
    except (Failed, OSError, KeyError) as error:
        print(f"numbers_record.py: {error}", file=sys.stderr)
        return 2
    changed = report(compared(record, found))
    if recording:
        write_record(RECORD, comment, updated(record, found, arguments[2].strip()))
        return 0
    if changed:
        print(f"numbers_record.py: {changed} of the numbers changed. If that is meant: .ci/numbers_record.py {arguments[0]} --record "
              '"reason", and commit .ci/numbers.csv with the change; otherwise mend it.', file=sys.stderr)
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
