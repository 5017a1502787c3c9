"""Studies that are wrong, hostile or interrupted."""

import json
import os
import signal
import time

from fixtures import BAR
from harness import ROOT, Case

STUDY = """subsection Study
  set Program   = microcell
  set Input     = {data}/microcells/case_a.prm
  set Reference = Mesh/Degree=1 Mesh/Elements=4
  set Answers   = peak_stress
end
subsection Sweep
  set Mesh/Degree = 1 | 2
end
"""
SERIES = """subsection Study
  set Kind    = series
  set Program = microcell
end
subsection Runs
  set one = {data}/microcells/case_a.prm Mesh/Degree=1
end
"""
MAP = """subsection Study
  set Kind      = map
  set Program   = penetrate
  set Input     = {data}/scenes/taylor_aluminium.prm
  set Reference = bar/Rings=3
  set Answers   = final_length_ratio 1 %
end
subsection Rows
  set NSNI = Integration/Scheme=NSNI
end
subsection Sweep step
  set Time/Step factor = 0.5 | 0.7
end
"""
SCALING = """subsection Study
  set Kind    = scaling
  set Program = penetrate
  set Input   = {data}/scenes/taylor_aluminium.prm
end
subsection Strong timed
  set 1 | 2 = bar/Rings=3
end
subsection Model
  set Points    = 1e8
  set Ranks     = 1000
  set Latency   = 2e-6
  set Bandwidth = 1e9
end
"""
UNCERTAINTY = """subsection Study
  set Kind    = uncertainty
  set Program = microcell
  set Input   = {data}/microcells/case_a.prm
  set Answers = peak_stress
  set Samples = 5
end
subsection Distributions
  set strength = Material/Tensile strength=uniform 2 3 MPa
end
"""


def text(content):
    return content.replace("{data}", str(ROOT / "data")) if isinstance(content, str) else content


def replaced(content, old, new):
    """Returns a text with its first `old` replaced."""
    assert old in content, old
    return content.replace(old, new, 1)


REFUSED = (
    ("empty", "", ["s.prm"]),
    ("binary", bytes(range(256)) * 10, ["s.prm"]),
    ("NUL bytes", "\0" * 10, ["s.prm"]),
    ("UTF-16", STUDY.encode("utf-16"), ["s.prm"]),
    ("escape sequences", "\x1b[31m\n", ["s.prm:1"]),
    ("a line of 1 MB", "x" * 1_000_000, ["s.prm:1"]),
    ("a list of keys of 1 MB", replaced(STUDY, "Mesh/Degree=1 ", "a/b " * 250_000), []),
    ("includes itself", "include s.prm\n", ["itself"]),
    ("includes a device", "include /dev/zero\n", ["/dev/zero"]),
    ("includes nothing", "include none.prm\n", ["none.prm"]),
    ("includes what is no study", "include /etc/passwd\n", ["/etc/passwd"]),
    ("a section that is not closed", STUDY.removesuffix("end\n"), ["not closed"]),
    ("end without a section", "end\n", ["s.prm:1"]),
    ("a section in a section", replaced(STUDY, "end\n", "subsection a\n"), ["s.prm"]),
    ("a key twice", replaced(STUDY, "end\n", "  set Answers = peak_stress\nend\n"), ["twice"]),
    ("an unknown key", replaced(STUDY, "end\n", "  set Nonsense = 1\nend\n"), ["Nonsense"]),
    ("an unknown section", STUDY + "subsection Nonsense\n set a = 1\nend\n", ["Nonsense"]),
    ("an unknown kind", replaced(STUDY, "end\n", "  set Kind = nonsense\nend\n"), ["nonsense"]),
    ("an unknown program", replaced(STUDY, "= microcell", "= rm"), ["rm"]),
    ("an input that is missing", replaced(STUDY, "case_a.prm", "none.prm"), ["none.prm"]),
    ("an input that is a folder", replaced(STUDY, "/case_a.prm", ""), ["microcells"]),
    ("no answers", replaced(STUDY, "peak_stress", ""), ["Answers"]),
    ("a comma at the end", replaced(STUDY, "peak_stress", "peak_stress,"), ["Answers"]),
    ("an answer twice", replaced(STUDY, "peak_stress", "peak_stress, peak_stress"), ["Answers"]),
    ("repeats 0", replaced(STUDY, "end\n", "  set Repeats = 0\nend\n"), ["Repeats"]),
    ("repeats -1", replaced(STUDY, "end\n", "  set Repeats = -1\nend\n"), ["Repeats"]),
    ("repeats many", replaced(STUDY, "end\n", "  set Repeats = 1e9\nend\n"), ["Repeats"]),
    ("an override twice", replaced(STUDY, "end\n", "  set Fixed = A/B=1 A/B=2\nend\n"), ["A/B"]),
    ("an exact value NaN", replaced(STUDY, "Reference = Mesh/Degree=1 Mesh/Elements=4", "Exact = peak_stress nan"), ["nan"]),
    ("too many runs", STUDY + "subsection Sweep b\n" + "".join(f" set A/B{i} = {' | '.join('0123456789')}\n" for i in range(9)) + "end\n", ["runs"]),
    ("a map: a tolerance NaN", replaced(MAP, "1 %", "nan %"), ["nan"]),
    ("a map: a tolerance 0", replaced(MAP, "1 %", "0 %"), ["0 %"]),
    ("a map: a tolerance -1", replaced(MAP, "1 %", "-1 %"), ["-1 %"]),
    ("a map: a limit NaN", replaced(MAP, "end\n", "  set Limits = a nan\nend\n"), ["nan"]),
    ("a map: a limit twice", replaced(MAP, "end\n", "  set Limits = a 1, a 2\nend\n"), ["a 2"]),
    ("scaling: ranks -1", replaced(SCALING, "set 1 | 2 =", "set -1 | 2 ="), ["-1"]),
    ("scaling: ranks 0", replaced(SCALING, "set 1 | 2 =", "set 0 ="), ["0"]),
    ("scaling: ranks 1.5", replaced(SCALING, "set 1 | 2 =", "set 1.5 ="), ["1.5"]),
    ("scaling: ranks NaN", replaced(SCALING, "set 1 | 2 =", "set nan ="), ["nan"]),
    ("scaling: points NaN", replaced(SCALING, "1e8", "nan"), ["nan"]),
    ("scaling: repeats 0", replaced(SCALING, "end\n", "  set Repeats = 0\nend\n"), ["Repeats"]),
    ("uncertainty: samples 0", replaced(UNCERTAINTY, "Samples = 5", "Samples = 0"), ["Samples"]),
    ("uncertainty: samples 1e9", replaced(UNCERTAINTY, "Samples = 5", "Samples = 1000000000"), ["Samples"]),
    ("uncertainty: a NaN", replaced(UNCERTAINTY, "uniform 2 3", "uniform nan 3"), ["strength"]),
    ("uncertainty: ends reversed", replaced(UNCERTAINTY, "uniform 2 3", "uniform 3 2"), ["strength"]),
    ("uncertainty: a value that the program refuses", replaced(UNCERTAINTY, "uniform 2 3", "uniform -3 -2"), ["strength"]))


def study(name, content, says, **more):
    return Case("studies", name, "study", ["s.prm", "--build", "{build}", *more.pop("words", [])], says=says,
                files={"s.prm": text(content)} | more.pop("files", {}), **more)


def cases(_):
    for name, content, says in REFUSED:
        yield study(name, content, says, hides=["root:"])
    for name in ("../x", "/tmp/x", "a/b", "..", ".", "report", "runs.json", "a\x1b[31mb", "x" * 300):
        yield study(f"a series: a run named {name[:20]!r}", replaced(SERIES, "set one", f"set {name}"), ["s.prm:6"])
    yield study("a series: a run twice", replaced(SERIES, "end\n", "") + "  set one = {data}/microcells/case_a.prm\nend\n".replace("{data}", str(ROOT / "data")), ["s.prm"])
    for value in ("@one/../../etc/passwd", "@one", "@two/x", "@../x"):
        yield study(f"a series: a file {value}", replaced(SERIES, "Mesh/Degree=1\n", f"Mesh/Degree=1\n  set b = {ROOT}/data/microcells/case_a.prm Cell/Sizes={value}\n"), ["s.prm"])
    yield study("a series: overrides that are none", replaced(SERIES, "end\n", "  set Fixed = nonsense\nend\n"), ["nonsense"])
    yield study("the output is a file", STUDY, ["x"], words=["--output", "x"], files={"x": "a file"})
    yield study("the output cannot be made", STUDY, ["/proc"], words=["--output", "/proc/x/y"])
    yield study("the output has results", STUDY, ["--force"], words=["--output", "x"], files={"x/study.csv": "old"})
    yield study("the record is damaged", STUDY, ["runs.json"], words=["--output", "x"], files={"x/runs.json": "{"})
    yield study("the record is of another study", STUDY, ["other inputs"], words=["--output", "x"], files={"x/runs.json": '{"digest": "0", "runs": {}}'})
    yield study("the record is nested", STUDY, ["runs.json"], words=["--output", "x"], files={"x/runs.json": "[" * 100_000})
    yield study("hosts are missing", STUDY, ["none"], words=["--hosts", "none"])
    yield study("hosts are binary", STUDY, ["h"], words=["--hosts", "h"], files={"h": bytes(range(256))})
    yield study("a host that is an option", STUDY, ["h:1"], words=["--hosts", "h"], files={"h": "-oProxyCommand=x\n"})
    yield study("jobs 0", STUDY, ["jobs"], words=["--jobs", "0"])
    yield study("jobs -1", STUDY, ["jobs"], words=["--jobs=-1"])
    yield study("an option of no study", STUDY, ["--nonsense"], words=["--nonsense"])
    yield study("an option that is shortened", STUDY, ["--forc"], words=["--forc"])
    yield study("an option twice", STUDY, ["twice"], words=["--output", "a", "--output", "b"])
    yield study("an empty output", STUDY, ["empty"], words=["--output", ""])
    yield Case("studies", "no study", "study", [], says=["study"])
    yield Case("studies", "a folder", "study", ["{here}"], says=["folder"])
    yield Case("studies", "a device", "study", ["/dev/zero"], says=["/dev/zero"])
    yield study("no programs", STUDY, ["build"], words=[], environment={}) if False else Case(
        "studies", "no programs", "study", ["s.prm", "--build", "nowhere"], says=["nowhere"], files={"s.prm": text(STUDY)})
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        yield study(f"{number.name}", replaced(STUDY, "1 | 2", "1 | 2 | 3") + "subsection Sweep b\n set Mesh/Elements = "
                    + " | ".join(map(str, range(4, 60))) + "\nend\n", [], words=["--output", "x", "--jobs", "2"], code=130,
                    signal=after_runs(number), after=nothing_runs)


def after_runs(number):
    def send(process, work):
        for _ in range(500):
            if (work / "x" / "runs.json").is_file():
                break
            time.sleep(0.02)
        time.sleep(0.1)
        process.send_signal(number)
    return send


def nothing_runs(work):
    """Whether no program works in the folder any more, and what was done is kept."""
    for place in os.listdir("/proc"):
        try:
            words = open(f"/proc/{place}/cmdline", "rb").read()
        except OSError:
            continue
        if str(work).encode() in words and b"microcell" in words:
            return "a run goes on without the study"
    kept = json.loads((work / "x" / "runs.json").read_text())["runs"]
    return "" if kept else "nothing is kept"
