"""Reads STUDY.prm: the syntax of the programs' own inputs."""

import itertools
import math
import os
import pathlib
import re
import sys
from dataclasses import dataclass, field

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from files import Unreadable, fault_of_file, read_text  # noqa: E402
from inputs import without_comment  # noqa: E402

LONGEST_LINE = 20000  # characters of a list of keys
DEEPEST_INCLUDE = 32  # files one inside the other
MOST_RUNS = 100000  # of one study


class BadStudy(Exception):
    """Its message is one line that names the file and the line, the value found and the allowed values."""


@dataclass
class Case:
    series: str
    overrides: dict


@dataclass
class Study:
    name: str
    program: str
    input: pathlib.Path
    reference: dict   # overrides of the run whose answers are taken as exact; empty with `exact`
    exact: dict       # exact answers, if they are given
    answers: list
    costs: list
    fixed: dict = field(default_factory=dict)
    default: dict = field(default_factory=dict)
    repeats: int = 1
    refined_by: list = field(default_factory=list)  # keys of mesh or point refinement
    cases: list = field(default_factory=list)
    # Of a stability map only.
    is_map: bool = False
    rows: dict = field(default_factory=dict)        # name of the row -> overrides
    axes: dict = field(default_factory=dict)        # title -> overrides at each place along the axis
    tolerances: dict = field(default_factory=dict)  # answer -> largest error, percent
    limits: dict = field(default_factory=dict)      # key of the summary -> largest value
    physical: list = field(default_factory=list)    # keys that also change the exact answer
    # Of a tornado chart only.
    constants: dict = field(default_factory=dict)   # name -> overrides of each other value, one or two


@dataclass
class Run:
    """One run of a series. A value `@NAME/FILE` is a file among the results of the earlier run NAME."""
    program: str
    input: pathlib.Path
    overrides: dict


@dataclass
class Series:
    """Runs that one report compares, each with its own results."""
    name: str
    runs: dict  # name -> Run


COMMON = {"Kind", "Program", "Input", "Reference", "Answers", "Fixed"}
OF_KIND = {"chart": COMMON | {"Cost", "Default", "Exact", "Refined by", "Repeats"}, "map": COMMON | {"Limits", "Physical"},
           "tornado": COMMON - {"Reference"}}
REQUIRED = ("Program", "Input", "Answers")
SERIES = ("Kind", "Program", "Fixed")
PROGRAMS = ("microcell", "penetrate")


def overrides(text):
    """Reads overrides: `A/B c=1 D/E/F=2 mm` -> {'A/B c': '1', 'D/E/F': '2 mm'}. A key
    begins at a word with a slash. Only its last part may hold spaces, so that `3 kg/m3 A/B=1` is a value and a key."""
    found = {}
    if len(text) > LONGEST_LINE:
        raise ValueError(f"found {len(text)} characters, allowed: {LONGEST_LINE}")
    for match in re.finditer(r"(\S+/[^=]+?)\s*=\s*(.*?)(?=\s+[^\s=/]+/(?:[^\s=/]+/)*[^=/]+=|$)", text.strip()):
        if match[1].strip() in found:
            raise ValueError(f"found '{match[1].strip()}' twice, allowed: once")
        found[match[1].strip()] = match[2].strip()
    if text.strip() and not found:
        raise ValueError(f"found '{text}', allowed: Section/Key=value ...")
    return found


def words(text):
    return [word.strip() for word in text.split(",") if word.strip()]


def bounds(text, suffix=""):
    """Reads names with numbers: `length 1 %, foot 5 %` -> {'length': 1.0, 'foot': 5.0}"""
    found = {}
    for word in words(text):
        match = re.fullmatch(r"(\S+)\s+(\S+)" + (rf"\s*{suffix}" if suffix else ""), word)
        if not match:
            raise ValueError(f"found '{word}', allowed: NAME NUMBER{' ' + suffix if suffix else ''}, ...")
        number = float(match[2])
        if not math.isfinite(number) or match[1] in found:
            raise ValueError(f"found '{word}', allowed: a finite number, once for each name")
        found[match[1]] = number
    return found


def count(text, what):
    """Returns a whole number of at least 1. @raises ValueError"""
    if not re.fullmatch(r"[0-9]{1,6}", text) or int(text) < 1:
        raise ValueError(f"Study/{what}: found '{text}', allowed: a whole number of 1 or more")
    return int(text)


def names_of(text, what, least=1):
    """Returns names between commas. @raises ValueError: one is empty or stands there twice"""
    found = [word.strip() for word in text.split(",")] if text.strip() else []
    if len(found) < least or not all(found) or len(set(found)) < len(found):
        raise ValueError(f"Study/{what}: found '{text}', allowed: names between commas, each once")
    return found


def bare_line(line):
    """Returns a line without its comment, and without the double quotes around its file or value. @raises ValueError"""
    line = line.strip()
    match = re.match(r"include\s+|set\s+[^=#]*=\s*", line)
    if not match:
        return without_comment(line)
    return f"{match[0].rstrip()} {without_comment(line[match.end():])}"


def sections(path, including=()):
    """Yields (section, line number, key, value) of every line that sets a key. `include FILE` stands for the lines of that file,
    whose numbers are FILE:NUMBER. A later line replaces an earlier one of another file; one file sets a key once. @raises BadStudy"""
    try:
        text = read_text(path)
        identity = path.resolve()
    except (Unreadable, OSError, RuntimeError) as error:  # RuntimeError: a link to itself
        raise BadStudy(error if isinstance(error, Unreadable) else f"{path}: {error}") from error
    if identity in including or len(including) >= DEEPEST_INCLUDE:
        raise BadStudy(f"{path}: " + ("includes itself" if identity in including else "is included too deep, allowed: "
                                      f"{DEEPEST_INCLUDE} files one inside the other"))
    current, own = None, {}
    for number, line in enumerate(text.splitlines(), 1):
        try:
            line = bare_line(line)
        except ValueError as error:
            raise BadStudy(f"{path}:{number}: {error}") from error
        if not line:
            continue
        if line.startswith("include "):
            if current is not None:
                raise BadStudy(f"{path}:{number}: found '{line}' in the section '{current}', allowed: outside of sections")
            included = path.parent / line.removeprefix("include ")
            yield from ((section, f"{included.name}:{at}", key, value)
                        for section, at, key, value in sections(included, (*including, identity)))
        elif line.startswith("subsection ") and current is None:
            current = line.removeprefix("subsection ").strip()
        elif line == "end" and current is not None:
            current = None
        elif (match := re.fullmatch(r"set\s+([^=]+?)\s*=\s*(.*)", line)) and current:
            first = own.setdefault((current, match[1]), number)
            if first != number:
                raise BadStudy(f"{path}:{number}: the key '{current}/{match[1]}' is set twice in this file, first in line {first}")
            yield current, number, match[1], match[2]
        else:
            # Lines of a file that is no input are nobody's business.
            found = f"found '{line}'" if not including or path.suffix == ".prm" else "found another line"
            raise BadStudy(f"{path}:{number}: {found}, allowed: include FILE, subsection NAME, set KEY = VALUE, end")
    if current is not None:
        raise BadStudy(f"{path}: the subsection '{current}' is not closed with 'end'")


def places(path, number, key, value):
    """Reads swept keys: `A/B + C/D = 1, 2 | 3, 4` -> [{'A/B': '1', 'C/D': '2'}, {'A/B': '3', 'C/D': '4'}]"""
    keys = [word.strip() for word in key.split(" + ")]
    if not all("/" in word for word in keys):
        raise BadStudy(f"{path}:{number}: found '{key}', allowed: Section/Key, or Section/Key + Section/Key")
    found = []
    for place in value.split("|"):
        values = [word.strip() for word in place.split(",")] if len(keys) > 1 else [place.strip()]
        if len(values) != len(keys):
            raise BadStudy(f"{path}:{number}: found '{place.strip()}', allowed: {len(keys)} values between commas")
        found.append(dict(zip(keys, values)))
    return found


def sides(path, number, value):
    """Reads the one or two other values of a constant: `A/B=1 | A/B=2 C/D=3` -> [{'A/B': '1'}, {'A/B': '2', 'C/D': '3'}]"""
    try:
        found = [overrides(side) for side in value.split("|")]
    except ValueError as error:
        raise BadStudy(f"{path}:{number}: {error}") from error
    if len(found) > 2 or not all(found):
        raise BadStudy(f"{path}:{number}: found '{value}', allowed: Section/Key=value ... [| Section/Key=value ...]")
    return found


def collect(path):
    """Returns the settings with their lines, the rows of a map, the sweeps (series -> one list of overrides per swept key), and
    the constants of a tornado chart."""
    settings, rows, sweeps, constants = {}, {}, {}, {}
    for section, number, key, value in sections(path):
        if section == "Study":
            settings[key] = (value, number)
        elif section == "Rows":
            try:
                rows[key] = overrides(value)
            except ValueError as error:
                raise BadStudy(f"{path}:{number}: {error}") from error
        elif section == "Constants":
            constants[key] = sides(path, number, value)
        elif section.startswith("Sweep"):
            series = section.removeprefix("Sweep").strip() or "sweep"
            sweeps.setdefault(series, []).append(places(path, number, key, value))
        else:
            raise BadStudy(f"{path}:{number}: section '{section}', allowed: Study, Rows, Constants, Sweep NAME")
    return settings, rows, sweeps, constants


def read_run(words_of_run, folder, program, fixed):
    """Reads `[PROGRAM] INPUT [Section/Key=value ...]`. The fixed keys apply to runs of the series' own program only."""
    first, _, rest = words_of_run.partition(" ")
    own = first not in PROGRAMS
    name, _, changes = (words_of_run if own else rest.strip()).partition(" ")
    source = folder / name
    if fault_of_file(source):
        raise ValueError(f"no file '{source}'")
    return Run(program if own else first, source, (fixed if own else {}) | overrides(changes))


TAKEN = ("report", "runs.json")  # what a series writes beside its runs


def is_file_name(text):
    """Returns whether a text is the name of a file or folder that stays where it is put."""
    return text not in ("", ".", "..") and len(os.fsencode(text)) <= 200 and "/" not in text and text.isprintable()


def read_series(path):
    """Reads the series in a file. Returns None if its kind is another one. @raises BadStudy"""
    settings, lines, runs = {}, {}, {}
    for section, number, key, value in sections(path):
        if section in ("Study", "Runs"):
            (settings if section == "Study" else lines)[key] = (value, number)
    if settings.get("Kind", ("", 0))[0] != "series":
        return None
    for key, (_, number) in settings.items():
        if key not in SERIES:
            raise BadStudy(f"{path}:{number}: unknown key '{key}', allowed: {', '.join(SERIES)}")
    program = settings.get("Program", ("", 0))[0]
    if program not in PROGRAMS:
        raise BadStudy(f"{path}: Study/Program: found '{program}', allowed: {', '.join(PROGRAMS)}")
    if not lines:
        raise BadStudy(f"{path}: a series needs a section Runs: set NAME = [PROGRAM] INPUT.prm [Section/Key=value ...]")
    try:
        fixed = overrides(settings.get("Fixed", ("", 0))[0])
    except ValueError as error:
        raise BadStudy(f"{path}:{settings['Fixed'][1]}: Study/Fixed: {error}") from error
    for name, (value, number) in lines.items():
        if not is_file_name(name) or name in TAKEN:
            raise BadStudy(f"{path}:{number}: found '{name}', allowed: a name of a folder inside that of the study, other than "
                           f"{', '.join(TAKEN)}")
        try:
            run = read_run(value, path.parent, program, fixed)
        except ValueError as error:
            raise BadStudy(f"{path}:{number}: {error}") from error
        for value in [value for value in run.overrides.values() if value.startswith("@")]:
            wanted, *parts = value[1:].split("/")
            if not parts or not all(map(is_file_name, parts)):
                raise BadStudy(f"{path}:{number}: found '{value}', allowed: @NAME/FILE, a file among the results of the run NAME")
            if wanted not in runs:
                raise BadStudy(f"{path}:{number}: '@{wanted}': no run of that name before it")
        runs[name] = run
    return Series(path.stem, runs)


def read_study(path):
    """Reads a chart, a map or a tornado chart. @raises BadStudy"""
    settings, rows, sweeps, constants = collect(path)
    kind = settings.get("Kind", ("chart", 0))[0]
    if kind not in OF_KIND:
        raise BadStudy(f"{path}:{settings['Kind'][1]}: Study/Kind: found '{kind}', allowed: chart, map, tornado, "
                       "series, scaling, uncertainty, curve, limit")
    for key, (_, number) in settings.items():
        if key not in OF_KIND[kind]:
            raise BadStudy(f"{path}:{number}: unknown key '{key}', allowed: {', '.join(sorted(OF_KIND[kind]))}")
    for key in REQUIRED:
        if key not in settings:
            raise BadStudy(f"{path}: key 'Study/{key}' must be set")
    if kind != "tornado" and ("Reference" in settings) == ("Exact" in settings):
        raise BadStudy(f"{path}: set one of Study/Reference (a run) and Study/Exact (values known from elsewhere)")
    if (kind == "tornado") != bool(constants) or (kind == "tornado") == bool(sweeps):
        raise BadStudy(f"{path}: a tornado needs a section Constants and no Sweep, the other kinds the reverse")
    if (kind == "map") != bool(rows):
        raise BadStudy(f"{path}: a map needs a section Rows, a chart has none")
    setting = {key: value for key, (value, _) in settings.items()}
    if setting["Program"] not in PROGRAMS:
        raise BadStudy(f"{path}: Study/Program: found '{setting['Program']}', allowed: {', '.join(PROGRAMS)}")
    source = path.parent / setting["Input"]
    if fault_of_file(source):
        raise BadStudy(f"{path}: Study/Input: no file '{source}'")
    try:
        tolerances = bounds(setting["Answers"], "%") if kind == "map" else {}
        study = Study(path.stem, setting["Program"], source, overrides(setting.get("Reference", "")),
                      bounds(setting.get("Exact", "")), list(tolerances) or names_of(setting["Answers"], "Answers"),
                      names_of(setting.get("Cost", "wall_seconds"), "Cost"),
                      overrides(setting.get("Fixed", "")), overrides(setting.get("Default", "")),
                      count(setting.get("Repeats", "1"), "Repeats"), names_of(setting.get("Refined by", ""), "Refined by", 0),
                      is_map=kind == "map", rows=rows, tolerances=tolerances,
                      limits=bounds(setting.get("Limits", "")), physical=names_of(setting.get("Physical", ""), "Physical", 0),
                      constants=constants)
    except ValueError as error:
        raise BadStudy(f"{path}: {error}") from error
    if study.exact and (lacking := set(study.answers) - study.exact.keys()):
        raise BadStudy(f"{path}:{settings['Exact'][1]}: Study/Exact: no value for {', '.join(sorted(lacking))}")
    if any(tolerance <= 0 for tolerance in study.tolerances.values()):
        raise BadStudy(f"{path}: Study/Answers: found '{setting['Answers']}', allowed: errors above 0 %")
    for series, keys in sweeps.items():
        if math.prod(map(len, keys)) > MOST_RUNS:
            raise BadStudy(f"{path}: section 'Sweep {series}': found {math.prod(map(len, keys))} runs, allowed: {MOST_RUNS}")
        if study.is_map:
            if len(keys) != 1:
                raise BadStudy(f"{path}: section 'Sweep {series}': a map has one axis per sweep, found {len(keys)}")
            study.axes[series] = keys[0]
        else:
            study.cases += [Case(series, {key: value for at in combination for key, value in at.items()})
                            for combination in itertools.product(*keys)]
    return study
