"""Reads STUDY.prm: the syntax of the programs' own inputs."""

import itertools
import pathlib
import re
import sys
from dataclasses import dataclass, field

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "compare"))

from inputs import without_comment  # noqa: E402


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
    for match in re.finditer(r"(\S+/[^=]+?)\s*=\s*(.*?)(?=\s+[^\s=/]+/(?:[^\s=/]+/)*[^=/]+=|$)", text.strip()):
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
        found[match[1]] = float(match[2])
    return found


def bare_line(line):
    """Returns a line without its comment, and without the double quotes around its file or value. @raises ValueError"""
    line = line.strip()
    match = re.match(r"include\s+|set\s+[^=#]*=\s*", line)
    if not match:
        return without_comment(line)
    return f"{match[0].rstrip()} {without_comment(line[match.end():])}"


def sections(path):
    """Yields (section, line number, key, value) of every line that sets a key. `include FILE` stands for the lines of that file,
    whose numbers are FILE:NUMBER. A later line replaces an earlier one."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise BadStudy(f"{path}: {error.strerror}") from error
    current = None
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
            yield from ((section, f"{included.name}:{at}", key, value) for section, at, key, value in sections(included))
        elif line.startswith("subsection "):
            current = line.removeprefix("subsection ").strip()
        elif line == "end":
            current = None
        elif (match := re.fullmatch(r"set\s+([^=]+?)\s*=\s*(.*)", line)) and current:
            yield current, number, match[1], match[2]
        else:
            raise BadStudy(f"{path}:{number}: found '{line}', allowed: include FILE, subsection NAME, set KEY = VALUE, end")


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
    if not source.is_file():
        raise ValueError(f"no file '{source}'")
    return Run(program if own else first, source, (fixed if own else {}) | overrides(changes))


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
    fixed = overrides(settings.get("Fixed", ("", 0))[0])
    for name, (value, number) in lines.items():
        try:
            run = read_run(value, path.parent, program, fixed)
        except ValueError as error:
            raise BadStudy(f"{path}:{number}: {error}") from error
        for wanted in [value[1:].split("/")[0] for value in run.overrides.values() if value.startswith("@")]:
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
    if not source.is_file():
        raise BadStudy(f"{path}: Study/Input: no file '{source}'")
    try:
        tolerances = bounds(setting["Answers"], "%") if kind == "map" else {}
        study = Study(path.stem, setting["Program"], source, overrides(setting.get("Reference", "")),
                      bounds(setting.get("Exact", "")), list(tolerances) or words(setting["Answers"]),
                      words(setting.get("Cost", "wall_seconds")),
                      overrides(setting.get("Fixed", "")), overrides(setting.get("Default", "")),
                      int(setting.get("Repeats", "1")), words(setting.get("Refined by", "")),
                      is_map=kind == "map", rows=rows, tolerances=tolerances,
                      limits=bounds(setting.get("Limits", "")), physical=words(setting.get("Physical", "")),
                      constants=constants)
    except ValueError as error:
        raise BadStudy(f"{path}: {error}") from error
    if study.exact and (lacking := set(study.answers) - study.exact.keys()):
        raise BadStudy(f"{path}:{settings['Exact'][1]}: Study/Exact: no value for {', '.join(sorted(lacking))}")
    for series, keys in sweeps.items():
        if study.is_map:
            if len(keys) != 1:
                raise BadStudy(f"{path}: section 'Sweep {series}': a map has one axis per sweep, found {len(keys)}")
            study.axes[series] = keys[0]
        else:
            study.cases += [Case(series, {key: value for at in combination for key, value in at.items()})
                            for combination in itertools.product(*keys)]
    return study
