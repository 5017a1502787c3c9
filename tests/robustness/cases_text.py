"""The text of inputs: lines, sections, includes, bytes."""

import os

from fixtures import BAR, CELL, MATERIAL, PATH
from harness import Case

FIRST = {"penetrate": BAR, "microcell": CELL, "material_point": MATERIAL}
KEY = {"penetrate": ("bar", "Rings"), "microcell": ("Mesh", "Degree"), "material_point": ("Path", "Substeps")}


def cases(_):
    for program, first in FIRST.items():
        yield from of_program(program, first)


def of_program(program, first):
    section, key = KEY[program]
    begin = f"include {first}\n"

    def case(name, text, says, **more):
        files = {"in.prm": text} | more.pop("files", {})
        words = ["in.prm", *([PATH] if program == "material_point" else []), *more.pop("words", [])]
        return Case("text of inputs", name, program, words, says=says, files=resolve(files), **more)

    yield case("empty", "", [])
    yield case("a blank", " \n", [])
    yield case("NUL bytes", "\0" * 100, ["in.prm:1"])
    yield case("a NUL in a value", begin + f"set {section}/{key} = 3\0\n", ["in.prm:2"])
    yield case("random bytes", bytes((i * 7919 + i * i) % 256 for i in range(4000)), ["in.prm:"])
    yield case("escape sequences", "\x1b[2J\x1b]0;title\x07\n", ["in.prm:1"])
    yield case("an escape sequence in a value", begin + f"set {section}/{key} = \x1b[31m3\n", ["in.prm:2"])
    yield case("an escape sequence in a key", begin + f"set {section}/\x1b[31m = 3\n", ["in.prm:2"])
    yield case("an escape sequence in a section", "subsection \x1b[31m\nset a = 1\nend\n", ["in.prm:"])
    yield case("right-to-left marks", begin + f"set {section}/{key} = \u202e3\n", ["in.prm:2"])
    yield case("Latin-1", begin.encode() + f"set {section}/{key} = 3 \xb5m\n".encode("latin-1"), ["in.prm:2"])
    yield case("UTF-16", (begin + f"set {section}/{key} = 3\n").encode("utf-16"), ["in.prm:1"])
    yield case("a line of 26 kB", begin + "x" * 26000 + "\n", ["in.prm:2"])
    yield case("a line of 10 MB", begin + f"set {section}/{key} = " + "1" * 10_000_000 + "\n", ["in.prm:2"])
    yield case("a word of 1 MB in quotes", begin + f'set {section}/{key} = "' + "a" * 1_000_000 + "\"\n", ["in.prm:2"])
    yield case("a name of 1 MB", "subsection " + "a" * 1_000_000 + "\nend\n", ["in.prm"])
    yield case("100,000 open sections", "subsection a\n" * 100_000, ["in.prm"])
    yield case("a path of 100,000 sections", "set " + "a/" * 100_000 + "b = 1\n", ["in.prm:1"])
    yield case("a million continued lines", begin + "\\\n" * 1_000_000, [], code=2)
    yield case("a quote that is not closed", begin + f'set {section}/{key} = "3\n', ["in.prm:2", "quote"])
    yield case("words behind a quote", begin + f'set {section}/{key} = "3" 4\n', ["in.prm:2"])
    yield case("end without a section", begin + "end\n", ["in.prm:2", "end"])
    yield case("a section that is not closed", begin + f"subsection {section}\n", ["in.prm:2", "not closed"])
    yield case("a section without a name", begin + "subsection \nend\n", ["in.prm:2"])
    yield case("a section of slashes", begin + "subsection ///\nend\n", ["in.prm:2"])
    yield case("an unknown section", begin + "subsection Nonsense\n set a = 1\nend\n", ["in.prm:"])
    yield case("an unknown key", begin + f"set {section}/Nonsense = 1\n", ["in.prm:2", "Nonsense"])
    yield case("a key without a section", begin + "set Nonsense = 1\n", ["in.prm:2"])
    yield case("a key in other capitals", begin + f"set {section}/{key.upper()} = 1\n", ["in.prm:2", key])
    yield case("set without a key", begin + "set = 1\n", ["in.prm:2"])
    yield case("set without a sign", begin + f"set {section}/{key} 1\n", ["in.prm:2"])
    yield case("set without a value", begin + f"set {section}/{key} =\n", ["in.prm:2"])
    yield case("a word of its own", begin + "nonsense\n", ["in.prm:2", "nonsense"])
    yield case("SET in capitals", begin + f"SET {section}/{key} = 1\n", ["in.prm:2"])
    yield case("INCLUDE in capitals", f"INCLUDE {first}\n", ["in.prm:1"])
    yield case("a key twice in one section", begin + f"subsection {section}\n set {key} = 2\n set {key} = 3\nend\n",
               ["in.prm:4", "twice", key])
    yield case("a key twice in one file", begin + f"set {section}/{key} = 2\nset {section}/{key} = 2\n", ["in.prm:3", "twice"])
    yield case("a decimal comma", begin + f"set {section}/{key} = 2,5\n", ["in.prm:2"])
    yield from includes(case, begin)


def resolve(files):
    """The scenes of data/ by their full names."""
    from harness import ROOT
    return {name: text.replace("{data}", str(ROOT / "data")) if isinstance(text, str)
            else text.replace(b"{data}", str(ROOT / "data").encode()) for name, text in files.items()}


def includes(case, begin):
    yield case("include of nothing", "include\n", ["in.prm:1"])
    yield case("include of no file", "include none.prm\n", ["in.prm:1", "none.prm"])
    yield case("include of a folder", "include .\n", ["in.prm:1"])
    yield case("include of a device", "include /dev/zero\n", ["in.prm:1", "/dev/zero"])
    yield case("include of a pipe", "include pipe\n", ["in.prm:1", "pipe"], before=lambda work: os.mkfifo(work / "pipe"))
    yield case("include of a very long name", "include " + "n" * 5000 + "\n", ["in.prm:1"])
    yield case("include of a link to itself", "include loop\n", ["in.prm:1", "loop"],
               before=lambda work: (work / "loop").symlink_to("loop"))
    yield case("include of itself", "include in.prm\n", ["in.prm"])
    yield case("include of itself by another way", "include a/../in.prm\n", ["in.prm"], files={"a/x": ""})
    yield case("include of itself by a link", "include other.prm\n", ["include"],
               before=lambda work: (work / "other.prm").symlink_to("in.prm"))
    yield case("include in a circle", "include b.prm\n", ["in.prm"], files={"b.prm": "include in.prm\n"})
    yield case("a chain of 5,000 includes", "include 1.prm\n", ["include"],
               files={f"{i}.prm": f"include {i + 1}.prm\n" for i in range(1, 5000)})
    yield case("includes that double", "include 1.prm\ninclude 1.prm\n", ["include"],
               files={f"{i}.prm": f"include {i + 1}.prm\n" * 2 for i in range(1, 60)} | {"60.prm": ""})
    yield case("include of a file without rights to read its folder", "include /proc/1/root/nope\n", ["in.prm:1"])
    yield case("include of a file that is no input", "include /etc/passwd\n", ["/etc/passwd:1"], hides=["root:"])
    yield case("end of a section that the including file opened", "subsection a\ninclude b.prm\n",
               ["b.prm:1"], files={"b.prm": "end\n"})
    yield case("a section that an include leaves open", "include b.prm\nend\n", ["b.prm:1"], files={"b.prm": "subsection a\n"})
