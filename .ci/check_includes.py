#!/usr/bin/python3
"""Fails on an include against the order of the tree.

shared <- micro, shared <- macro, never micro <-> macro. Inside macro:
points <- {approximation, shape} <- {integration, contact, material, reinforcement} <- {solid, scene} <- dynamics
<- {output, restart} <- setup <- top level.
Rooms of equal rank do not include each other, with the exceptions of ALLOWED. Tests may include anything.
"""

import pathlib
import re
import sys

TOPS = {"shared": {"shared"}, "micro": {"shared", "micro"}, "macro": {"shared", "macro"}}
RANK = {"points": 0, "approximation": 1, "shape": 1, "integration": 2, "contact": 2, "material": 2, "reinforcement": 2,
        "solid": 3, "scene": 3,
        "dynamics": 4, "output": 5, "restart": 5, "setup": 6, "": 7}
# Between rooms of equal rank: an integration scheme calls the interface of materials, never one law.
ALLOWED = {("integration", "material"): {"macro/material/material.h"}}

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<((?:macro|micro|shared)/[^>]+)>)')


def room(path):
    """Room of a path below macro/: '' for files at its top level."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else ""


def complaint(file, included):
    """Why `file` may not include `included` (both relative to the root), or None."""
    top, target = file.split("/")[0], included.split("/")[0]
    if target not in TOPS:
        return None  # a library's header
    if target not in TOPS[top]:
        return f"{top} must not include {target}"
    if top != "macro" or target != "macro":
        return None
    here, there = room(file), room(included)
    for name in (here, there):
        if name not in RANK:
            return f"room 'macro/{name}' has no place in the order: add it to .ci/check_includes.py"
    if here == there or RANK[there] < RANK[here]:
        return None
    if (here, there) in ALLOWED:
        files = ALLOWED[here, there]
        if files is None or included in files:
            return None
        return f"macro/{here} may include only {', '.join(sorted(files))} of macro/{there}"
    order = "has the same rank as" if RANK[here] == RANK[there] else "comes before"
    return f"macro/{here} {order} macro/{there or ' (top level)'} and must not include it"


def resolve(root, file, text):
    """Path of an include relative to the root: beside the including file if it is there, as compilers do."""
    beside = (root / file).parent / text
    if beside.is_file():
        return beside.resolve().relative_to(root.resolve()).as_posix()
    return text


def check(root):
    """All complaints of a tree as 'file:line: reason'."""
    found = []
    for top in TOPS:
        for path in sorted((root / top).rglob("*")):
            if path.suffix not in (".h", ".cc") or not path.is_file():
                continue
            file = path.relative_to(root).as_posix()
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                included = resolve(root, file, match[1] or match[2])
                reason = complaint(file, included)
                if reason:
                    found.append(f"{file}:{number}: {reason} ({included})")
    return found


if __name__ == "__main__":
    problems = check(pathlib.Path(__file__).resolve().parent.parent)
    print("\n".join(problems) if problems else "   ok")
    sys.exit(1 if problems else 0)
