"""Reads STUDY.prm: the syntax of the programs' own inputs."""

import itertools
import pathlib
import re
from dataclasses import dataclass, field


class BadStudy(Exception):
    """One line: file, line, what is wrong and what is allowed."""


@dataclass
class Case:
    series: str
    overrides: dict


@dataclass
class Study:
    name: str
    program: str
    input: pathlib.Path
    reference: dict
    answers: list
    cost: str = "wall_seconds"
    fixed: dict = field(default_factory=dict)
    default: dict = field(default_factory=dict)
    repeats: int = 1
    cases: list = field(default_factory=list)


KEYS = {"Program", "Input", "Reference", "Answers", "Cost", "Fixed", "Default", "Repeats"}
REQUIRED = {"Program", "Input", "Reference", "Answers"}


def overrides(text):
    """`A/B c=1 D/E=2 mm` -> {'A/B c': '1', 'D/E': '2 mm'}: a key begins at a word with a slash."""
    found = {}
    for match in re.finditer(r"(\S+/[^=]+?)\s*=\s*(.*?)(?=\s+[^\s=/]+/[^=/]+=|$)", text.strip()):
        found[match[1].strip()] = match[2].strip()
    if text.strip() and not found:
        raise ValueError(f"found '{text}', allowed: Section/Key=value ...")
    return found


def sections(path):
    """(section, line number, key, value) of every line that sets something."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise BadStudy(f"{path}: {error.strerror}") from error
    current = None
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("#", 1)[0].strip()
        if not line:
            continue
        if line.startswith("subsection "):
            current = line.removeprefix("subsection ").strip()
        elif line == "end":
            current = None
        elif (match := re.fullmatch(r"set\s+([^=]+?)\s*=\s*(.*)", line)) and current:
            yield current, number, match[1], match[2]
        else:
            raise BadStudy(f"{path}:{number}: found '{line}', allowed: subsection NAME, set KEY = VALUE, end")


def read_study(path):
    settings, sweeps = {}, {}
    for section, number, key, value in sections(path):
        if section == "Study":
            if key not in KEYS:
                raise BadStudy(f"{path}:{number}: unknown key '{key}', allowed: {', '.join(sorted(KEYS))}")
            settings[key] = value
        elif section.startswith("Sweep"):
            if "/" not in key:
                raise BadStudy(f"{path}:{number}: found '{key}', allowed: Section/Key")
            values = [word.strip() for word in value.split("|")]
            sweeps.setdefault(section.removeprefix("Sweep").strip() or "sweep", {})[key] = values
        else:
            raise BadStudy(f"{path}:{number}: section '{section}', allowed: Study, Sweep NAME")
    if missing := REQUIRED - settings.keys():
        raise BadStudy(f"{path}: key 'Study/{sorted(missing)[0]}' must be set")
    if not sweeps:
        raise BadStudy(f"{path}: no section Sweep")
    if settings["Program"] not in ("microcell", "penetrate"):
        raise BadStudy(f"{path}: Study/Program: found '{settings['Program']}', allowed: microcell, penetrate")
    source = path.parent / settings["Input"]
    if not source.is_file():
        raise BadStudy(f"{path}: Study/Input: no file '{source}'")
    try:
        study = Study(path.stem, settings["Program"], source, overrides(settings["Reference"]),
                      [word.strip() for word in settings["Answers"].split(",")],
                      settings.get("Cost", "wall_seconds"), overrides(settings.get("Fixed", "")),
                      overrides(settings.get("Default", "")), int(settings.get("Repeats", "1")))
    except ValueError as error:
        raise BadStudy(f"{path}: {error}") from error
    for series, keys in sweeps.items():
        for values in itertools.product(*keys.values()):
            study.cases.append(Case(series, dict(zip(keys, values))))
    return study
