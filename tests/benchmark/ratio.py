#!/usr/bin/python3
"""Times two commands in alternation and prints how many times as long the second one takes.

A machine that others use is now slower, now faster. Two runs one after the other meet about the same machine, so the ratio of a
pair says more than two times, and the range of the ratios says how much.

    tests/benchmark/ratio.py --pairs 5 "build/macro/penetrate data/scenes/taylor_aluminium.prm -o /tmp/a --force" "lmp -in bar.in"
"""

import argparse
import os
import shlex
import statistics
import subprocess
import sys
import time

DOUBTFUL = 1.2  # largest over smallest ratio of pairs, above which the median is doubtful


class Failed(Exception):
    pass


def timed(command):
    """Returns (wall time, processor time) of a command in seconds. @raises Failed"""
    begin = time.monotonic()
    try:
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    except OSError as error:
        raise Failed(f"{command[0]}: {error.strerror}") from error
    with process.stderr as stream:
        words = stream.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.monotonic() - begin
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise Failed(f"{shlex.join(command)}: exit code {process.returncode}: {words.decode(errors='replace').strip()[-300:]}")
    return wall, usage.ru_utime + usage.ru_stime


def compare(commands, pairs, measure=timed):
    """Returns [(times of ours, times of theirs), ...]. The one that runs first changes from pair to pair."""
    found = []
    for i in range(pairs):
        order = (0, 1) if i % 2 == 0 else (1, 0)
        times = {which: measure(commands[which]) for which in order}
        found.append((times[0], times[1]))
    return found


def in_words(found):
    """Returns the ratios of wall and of processor times: median, smallest, largest."""
    lines = []
    for name, kind in (("wall time", 0), ("processor time", 1)):
        ours, theirs = [pair[0][kind] for pair in found], [pair[1][kind] for pair in found]
        ratios = [b / a if a > 0 else float("inf") for a, b in zip(ours, theirs)]
        doubt = "; they differ: a quieter machine or more pairs" if max(ratios) > DOUBTFUL * min(ratios) else ""
        lines.append(f"{name}: ours {statistics.median(ours):.3g} s, theirs {statistics.median(theirs):.3g} s, "
                     f"ratio {statistics.median(ratios):.3g} ({min(ratios):.3g} to {max(ratios):.3g} in {len(found)} pairs{doubt})")
    return "\n".join(lines)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ours", help="a command in quotes")
    parser.add_argument("theirs", help="a command in quotes")
    parser.add_argument("--pairs", type=int, default=5, metavar="N", help="default: 5")
    options = parser.parse_args(arguments)
    commands = [shlex.split(options.ours), shlex.split(options.theirs)]
    if options.pairs < 1 or not all(commands):
        parser.error("one pair at least, and two commands")
    try:
        print(in_words(compare(commands, options.pairs)))
    except Failed as error:
        print(f"ratio: {error}", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
