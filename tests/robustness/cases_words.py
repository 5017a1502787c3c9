"""Command lines: options and words that are wrong, missing, twice or too long."""

from fixtures import BAR, CELL, MATERIAL, PATH, SLAB
from harness import Case

LONG = "x" * 30000
INPUT = {"penetrate": [BAR], "microcell": [CELL], "material_point": [MATERIAL, PATH]}


def cases(_):
    for program, inputs in INPUT.items():
        yield from of_program(program, inputs)
    for program, words, says in (
            ("penetrate", [BAR, SLAB], ["one scene file only"]),
            ("microcell", [CELL, CELL], ["one case file only"]),
            ("material_point", [MATERIAL], ["PATH.csv"]),
            ("material_point", [MATERIAL, PATH, PATH], ["PATH.csv"]),
            ("microcell", [CELL, "--plan"], ["--plan"]),
            ("microcell", [CELL, "--accuracy", "20%"], ["--accuracy"]),
            ("material_point", [MATERIAL, PATH, "--plan"], ["--plan"]),
            ("material_point", [MATERIAL, PATH, "--restart"], ["--restart"]),
            ("material_point", [MATERIAL, PATH, "--accuracy", "20%"], ["--accuracy"]),
            ("material_point", [MATERIAL, PATH, "--force"], ["--force"]),
            ("penetrate", [BAR, "--accuracy", "x"], ["Accuracy", "'x'"]),
            ("penetrate", [BAR, "--accuracy"], ["--accuracy"]),
            ("penetrate", [BAR, "--accuracy", "-5%"], ["--accuracy"]),
            ("penetrate", [BAR, "--accuracy=-5%"], ["--accuracy"]),
            ("penetrate", [BAR, "--accuracy", "0%"], ["Accuracy"]),
            ("penetrate", [BAR, "--accuracy", "nan"], ["Accuracy"]),
            ("penetrate", [BAR, "--accuracy", "20%", "--accuracy", "10%"], ["twice"]),
            ("penetrate", [BAR, "--plan", "--restart"], ["--plan"]),
            ("penetrate", [BAR, "--plan", "--plan"], ["twice"]),
            ("penetrate", [BAR, "--plan", "--check"], ["--plan", "--check"]),
            ("penetrate", [BAR, "--check", "bar/Rings=0.5"], ["Rings"]),
            ("penetrate", [BAR, "--version", "--nonsense"], ["--nonsense"]),
            ("penetrate", ["--help", "--nonsense"], ["--nonsense"]),
            ("penetrate", [BAR, "--restart"], ["does not exist"])):
        yield Case("command line", " ".join(words), program, words, says=says)


def of_program(program, inputs):
    def case(name, words, says, **more):
        return Case("command line", name, program, words, says=says, **more)

    yield case("nothing", [], [])
    yield case("an empty name", [""], [])
    yield case("no such file", ["none.prm", *inputs[1:]], ["none.prm"])
    yield case("a folder as input", ["{here}", *inputs[1:]], ["folder"])
    yield case("a device as input", ["/dev/zero", *inputs[1:]], ["/dev/zero"])
    yield case("a very long name", [LONG, *inputs[1:]], ["name"])
    yield case("a very long option", [*inputs, "--" + LONG], ["unknown option"])
    yield case("a very long override", [*inputs, f"A/{LONG}=1"], ["A"])
    yield case("a very long value", [*inputs, f"Run/Threads={LONG}"], [])
    yield case("an unknown option", [*inputs, "--nonsense"], ["--nonsense"])
    yield case("a single dash", [*inputs, "-"], ["'-'"])
    yield case("two dashes", [*inputs, "--"], ["'--'"])
    yield case("a short option", [*inputs, "-x"], ["-x"])
    yield case("--output without a name", [*inputs, "--output"], ["--output"])
    yield case("--output with an empty name", [*inputs, "--output", ""], ["--output"])
    yield case("--output= with an empty name", [*inputs, "--output="], ["--output"])
    yield case("--output followed by an option", [*inputs, "--output", "--force"], ["--output"])
    yield case("--output twice", [*inputs, "--output", "a", "--output", "b"], ["--output", "twice"])
    yield case("-o twice", [*inputs, "-o", "a", "--output=b"], ["twice"])
    yield case("--force twice", [*inputs, "--output", "a", "--force", "--force"], ["twice"])
    yield case("an option with a value it has not", [*inputs, "--force=yes"], ["--force=yes"])
    yield case("restart and force", [*inputs, "--restart", "--force"], [])
    yield case("an override without a key", [*inputs, "=1"], ["=1"])
    yield case("an override of slashes", [*inputs, "///=1"], ["///=1"])
    yield case("an override without a section", [*inputs, "Nonsense=1"], ["Nonsense=1"])
    yield case("an override of an unknown section", [*inputs, "Nonsense/Key=1"], ["Nonsense"])
    yield case("an override with a line break", [*inputs, "A/B=1\nset x = 2"], [])
    yield case("an override with an escape sequence", [*inputs, "A/\x1b[31mB=1"], ["A"])
    yield case("an override that is no UTF-8", [*inputs, b"A/\xff\xfeB=1"], ["A"])
    yield case("help on nothing that is there", ["--help", "Nonsense"], ["Nonsense"])
    yield case("help on an escape sequence", ["--help", "\x1b]0;x\x07"], ["--help"])
    yield case("help twice", ["--help", "--help"], [], code=0)
    yield case("help", ["--help"], [], code=0)
    yield case("version", ["--version"], [], code=0)
    yield case("check and force", [*inputs, "--check", "--force"], ["--check"])
    yield case("check of a fault", [*inputs, "--check", "Nonsense/Key=1"], ["Nonsense"])
    yield case("an output that is a file", [*inputs, "--output", "taken/x"], ["taken"], files={"taken": "a file"})
    yield case("an output that cannot be made", [*inputs, "--output", "/proc/x/y"], ["/proc/x"])
    yield case("an output of a very long name", [*inputs, "--output", "y" * 300], ["y"])
    yield case("an input that is a link to itself", ["loop", *inputs[1:]], ["loop"], before=link_to_itself)


def link_to_itself(work):
    (work / "loop").symlink_to("loop")
