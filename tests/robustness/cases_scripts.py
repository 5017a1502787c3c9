"""The other scripts: the report, formulas, concretes, tests in tension, seals."""

import json
import os
import shutil

from fixtures import BAR
from harness import ROOT, Case


def cases(fixtures):
    yield from reports(fixtures)
    yield from others(fixtures)


def unsealed(work):
    (work / "t.h5").write_bytes((ROOT / "data" / "tables" / "wes5000.h5").read_bytes()[:-32])


def damaged(fixtures, name, then):
    def before(work):
        shutil.copytree(fixtures / name, work / "r")
        shutil.copytree(fixtures / "cell", work / "good")
        then(work / "r")
    return before


def write(name, content):
    return lambda folder: (folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())


def cut(name):
    return lambda folder: (folder / name).write_bytes((folder / name).read_bytes()[:1000])


def without_column(name):
    def change(folder):
        path = folder / name
        rows = [line.split(",")[1:] for line in path.read_text().splitlines() if not line.startswith("#")]
        path.write_text("\n".join(",".join(row) for row in rows) + "\n")
    return change


def in_summary(key, value):
    def change(folder):
        summary = json.loads((folder / "summary.json").read_text())
        summary[key] = value
        (folder / "summary.json").write_text(json.dumps(summary))
    return change


def reports(fixtures):
    """Whatever one result is, the others are reported."""
    def has_others(work):
        report = work / "report" / "report.html"
        return "" if report.is_file() and "good" in report.read_text() else "the other result is not reported"

    odd = [
            ("cell", "damage_table.h5 cut", cut("damage_table.h5")),
            ("cell", "damage_table.h5 a text", write("damage_table.h5", "x" * 5000)),
            ("cell", "curve.csv without strain", without_column("curve.csv")),
            ("cell", "curve.csv empty", write("curve.csv", "")),
            ("cell", "curve.csv binary", write("curve.csv", bytes(range(256)))),
            ("cell", "fields.pvd no XML", write("fields.pvd", "<a")),
            ("cell", "fields.pvd leads elsewhere", write("fields.pvd", '<VTKFile><Collection><DataSet timestep="0" file="../../etc/passwd"/></Collection></VTKFile>')),
            ("bar", "history.csv without time", without_column("history.csv")),
            ("bar", "history.csv empty", write("history.csv", "")),
            ("bar", "history.csv of words", write("history.csv", "time,total_energy\na,b\n")),
            ("bar", "fields.h5 cut", cut("fields.h5")),
            ("bar", "a frame cut", cut("fields/000.h5")),
            ("bar", "a frame missing", lambda folder: (folder / "fields/001.h5").unlink()),
            ("bar", "summary.json cut", cut("summary.json") if False else write("summary.json", '{"program": "penet')),
            ("bar", "summary.json a list", write("summary.json", "[]")),
            ("bar", "summary.json nested", write("summary.json", "[" * 100_000)),
            ("bar", "summary.json no UTF-8", write("summary.json", b'{"program": "\xff"}')),
            ("bar", "a number that is a text", in_summary("final_length_ratio", "x")),
            ("bar", "an infinite number", in_summary("foot_diameter", float("inf"))),
            ("bar", "resolved.prm binary", write("resolved.prm", bytes(range(256)))),
            ("bar", "main body that is missing", in_summary("main_body", "nobody"))]
    for name, what, then in odd:
        yield Case("reports", f"{name}: {what}", "compare.py", ["r", "good", "--output", "report"], code=0,
                   before=damaged(fixtures, name, then), after=has_others)
    yield Case("reports", "a pipe for a history", "compare.py", ["r", "good", "--output", "report"], code=0, after=has_others,
               before=damaged(fixtures, "bar", lambda folder: ((folder / "history.csv").unlink(), os.mkfifo(folder / "history.csv"))))
    for name in ("$x^{$", "a b", "<script>alert(1)</script>"[:8], "x\ny", "%s%n", "ä\u202eb"):
        yield Case("reports", f"a folder named {name!r}", "compare.py", [name, "good", "--output", "report"], code=0, after=has_others,
                   before=damaged(fixtures, "bar", lambda folder, name=name: folder.rename(folder.parent / name)))
    for name, words, says in (
            ("nothing", [], ["RESULTS"]),
            ("no folder", ["none"], ["none"]),
            ("an empty folder", ["{here}"], ["no result"]),
            ("a file", ["/etc/passwd"], ["/etc/passwd"]),
            ("references that are missing", ["{fixtures}/cell", "--references", "none"], ["none"]),
            ("references that are foreign", ["{fixtures}/cell", "--references", "foreign"], ["perforation.csv"]),
            ("digitised curves that are missing", ["{fixtures}/cell", "--digitised", "none"], ["none"]),
            ("digitised curves that are foreign", ["{fixtures}/cell", "--digitised", "foreign"], ["perforation.csv", "fig04_hydrostat"]),
            ("a report is there", ["{fixtures}/cell", "--output", "there"], ["--force"]),
            ("the output is a file", ["{fixtures}/cell", "--output", "file"], ["file"]),
            ("the output cannot be made", ["{fixtures}/cell", "--output", "/proc/x"], ["/proc/x"]),
            ("an unknown option", ["{fixtures}/cell", "--nonsense"], ["--nonsense"]),
            ("a very long name", ["x" * 5000], [])):
        yield Case("reports", name, "compare.py", words, says=says,
                   files={"there/report.html": "old", "file": "x", "foreign/perforation.csv": "a,b\n1,2\n"})


def others(fixtures):
    shot = ["--diameter", "50 mm", "--mass", "1 kg", "--velocity", "300 m/s", "--strength", "38 MPa", "--crh", "3"]
    for name, words, says in (
            ("nothing", [], ["diameter"]),
            ("a diameter without a unit", ["--diameter", "50", *shot[2:]], ["diameter"]),
            ("a diameter NaN", ["--diameter", "nan mm", *shot[2:]], ["diameter"]),
            ("a diameter 0", ["--diameter", "0 mm", *shot[2:]], ["diameter"]),
            ("a diameter 1e999", ["--diameter", "1e999 mm", *shot[2:]], ["diameter"]),
            ("a mass -1", [*shot[:2], "--mass", "-1 kg", *shot[4:]], ["mass"]),
            ("an ogive NaN", [*shot[:-1], "nan"], ["crh"]),
            ("a scene that is missing", ["none.prm"], ["none.prm"]),
            ("a folder", ["{here}"], []),
            ("a device", ["/dev/zero"], ["/dev/zero"]),
            ("a scene that includes itself", ["loop.prm"], ["itself"]),
            ("a scene that includes what is none", ["leak.prm"], ["/etc/passwd:1"]),
            ("no scene at all", ["/etc/passwd"], ["/etc/passwd"]),
            ("a binary scene", ["binary.prm"], ["binary.prm"]),
            ("a scene without a shot", [BAR], ["no shot"]),
            ("an override that is none", ["{data}/scenes/slab_127.prm", "nonsense"], ["nonsense"]),
            ("an unknown option", ["--nonsense"], ["--nonsense"]),
            ("a file that is there", [*shot, "--csv", "there.csv"], ["there.csv"]),
            ("a velocity twice", [*shot, "--velocity", "100 m/s"], ["twice"])):
        yield Case("formulas", name, "formulas", words, says=says, hides=["root:"] if "include" in name else [],
                   files={"loop.prm": "include loop.prm\n", "leak.prm": "include /etc/passwd\n", "binary.prm": bytes(range(256)), "there.csv": "old"})
    yield Case("formulas", "a shot", "formulas", shot, code=0)
    concrete = ["--strength", "35 MPa", "--aggregate", "9.5 mm", "--density", "2320 kg/m3", "--output", "c"]
    for name, words, says in (
            ("nothing", [], []),
            ("a strength NaN", ["--strength", "nan MPa", *concrete[2:]], ["strength"]),
            ("a strength 0", ["--strength", "0 MPa", *concrete[2:]], ["strength"]),
            ("a strength without a unit", ["--strength", "35", *concrete[2:]], ["strength"]),
            ("a density of lead", [*concrete[:4], "--density", "11000 kg/m3", *concrete[6:]], ["density"]),
            ("an aggregate of a metre", [*concrete[:2], "--aggregate", "1 m", *concrete[4:]], ["aggregate"]),
            ("an output that is a file", [*concrete[:-1], "file"], ["file"]),
            ("an output with results", [*concrete[:-1], "there"], ["--force"]),
            ("--run without a program", [*concrete, "--run", "--build", "none"], ["none"]),
            ("an unknown option", [*concrete, "--nonsense"], ["--nonsense"]),
            ("an option twice", [*concrete, "--output", "d"], ["twice"])):
        yield Case("concretes", name, "concrete", words, says=says, files={"file": "x", "there/concrete.prm": "old"})
    yield Case("concretes", "a concrete", "concrete", concrete, code=0)
    for name, words, says in (
            ("nothing", [], []),
            ("no test", ["nonsense", "{fixtures}/bar"], ["nonsense"]),
            ("no folder", ["spall", "none"], ["none"]),
            ("a bar that is none of both", ["spall", "{fixtures}/bar"], []),
            ("a microcell", ["pull", "{fixtures}/cell"], []),
            ("a damaged result", ["pull", "r"], ["r"])):
        yield Case("tests in tension", name, "tension", words, says=says, before=damaged(fixtures, "bar", cut("fields.h5")))
    for name, words, code in (
            ("nothing", [], 2),
            ("a text", ["text"], 2),
            ("a device", ["/dev/zero"], 2),
            ("a table", ["t.h5"], 0),
            ("a table that is sealed", ["{fixtures}/t.h5"], 0)):
        yield Case("seals", name, "sealed.py", words, code=code, files={"text": "x" * 100}, before=unsealed)
    for name, words in (("an unknown command", ["nonsense"]), ("two commands", ["test", "build"]), ("a list that is missing", ["install", "none"])):
        yield Case("shared/run", name, "run", words)
    yield Case("shared/run", "help", "run", ["help"], code=0)
    yield Case("shared/run", "help into a full output", "run", ["help"], code=3, streams={1: "/dev/full"})


