#!/usr/bin/python3
"""Runs clang-tidy on the files that a change touches. Usage: .ci/lint.py BUILD, a folder with compile commands.

The change is what differs from the common ancestor with the main branch; on the main branch itself, what the last
commit changed. A shallow clone is deepened by one commit; where even that fails (no network, one commit in all)
every file counts as changed. A changed header is checked in its own .cc file, or else in the first one that includes
it. Findings in files that did not change are not reported. Which findings are errors: .clang-tidy.

At most LARGEST_NUMBER files are checked and none is started after LONGEST_TIME seconds; what is left out is said.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

LARGEST_NUMBER = 20
LONGEST_TIME = 120
MAIN_BRANCHES = ("origin/HEAD", "origin/main", "origin/master", "main", "master")
SOURCE = re.compile(r"^(macro|micro|shared|tests)/.*\.(h|cc)$")


def git(root, *words):
    """Output of a git command, None if it fails."""
    done = subprocess.run(["git", "-C", str(root), *words], capture_output=True, text=True, check=False)
    return done.stdout.strip() if done.returncode == 0 else None


def base_of_change(root):
    """Commit that the change is measured from, None if the history does not tell."""
    head = git(root, "rev-parse", "HEAD")
    for branch in MAIN_BRANCHES:
        base = git(root, "merge-base", "HEAD", branch)
        if base and base != head:
            return base
    if git(root, "rev-parse", "--verify", "--quiet", "HEAD~1") is None:
        git(root, "fetch", "--quiet", "--deepen=1")
    return git(root, "rev-parse", "--verify", "--quiet", "HEAD~1")


def changed_files(root):
    """Changed C++ files, relative to the root, and in words what they are."""
    base = base_of_change(root)
    if base is None:
        listed, words = git(root, "ls-files"), "all files, as no earlier commit is known"
    else:
        # With what is not committed yet; files that are gone cannot be checked.
        listed = git(root, "diff", "--name-only", "--diff-filter=d", base)
        words = f"files changed since {base[:10]}"
    return sorted(name for name in (listed or "").splitlines() if SOURCE.match(name)), words


def includes(text, header):
    """Whether a file's text includes a header, given relative to the root."""
    return f'#include "{header}"' in text


def unit_of(root, name, units):
    """The file among `units` (compiled ones, relative to the root) to check `name` in, or None."""
    if name in units:
        return name
    own = re.sub(r"\.h$", ".cc", name)
    if own in units:
        return own
    return next((u for u in units if includes((root / u).read_text(encoding="utf-8"), name)), None)


def plan(root, names, units):
    """Files to check in each unit, by unit, and the files that no unit includes directly."""
    work, orphans = {}, []
    for name in names:
        unit = unit_of(root, name, units)
        if unit is None:
            orphans.append(name)
        else:
            work.setdefault(unit, []).append(name)
    return work, orphans


def check(root, build, unit, names, deadline):
    """Runs clang-tidy on one unit: (unit, None if too late or else whether it passed, its output)."""
    if time.monotonic() > deadline:
        return unit, None, ""
    # The filter matches the ends of paths.
    only = json.dumps([{"name": "/" + name} for name in names])
    done = subprocess.run(["clang-tidy-14", "--quiet", "-p", str(build), f"--line-filter={only}", str(root / unit)],
                          cwd=root, capture_output=True, text=True, check=False)
    return unit, done.returncode == 0, done.stdout + (done.stderr if done.returncode else "")


def main(root, build):
    names, words = changed_files(root)
    commands = json.loads((build / "compile_commands.json").read_text(encoding="utf-8"))
    units = sorted(pathlib.Path(c["file"]).resolve().relative_to(root).as_posix() for c in commands)
    work, orphans = plan(root, names, units)
    print(f"   {words}: {len(names)}, checked in {len(work)} compiled files")
    for name in orphans:
        print(f"   not checked, as no compiled file includes it directly: {name}")
    chosen = sorted(work)[:LARGEST_NUMBER]
    left_out = sorted(work)[LARGEST_NUMBER:]
    deadline, failed = time.monotonic() + LONGEST_TIME, False
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for unit, passed, output in pool.map(lambda u: check(root, build, u, work[u], deadline), chosen):
            if passed is None:
                left_out.append(unit)
                continue
            if output.strip():
                print(output.strip())
            failed = failed or not passed
    if left_out:
        print(f"   not checked (at most {LARGEST_NUMBER} files, {LONGEST_TIME} s): {', '.join(left_out)}")
    print("   failed" if failed else "   ok")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(__file__).resolve().parent.parent, pathlib.Path(sys.argv[1]).resolve()))
