"""Tries the commands of documents. Each function returns what is wrong with a command, or ""."""

import json
import re
import shlex
import shutil
import subprocess

from reading import PLACEHOLDER
from tree import PROGRAMS, SCRIPTS, TOPS

# Of the programs, which read their input with --check in place of a computation: what has no sense there, and words behind it.
WRITES = {"--output": 1, "-o": 1, "--restart": 0, "--force": 0}
MAIN_JOB = ("material", "microcell", "report", "slab_127", "slab_127_axis")  # folders in out/
SHELL = ("cd", "export", "cpack")  # always there, with CMake
BENCHMARKS = ("benchmark_macro", "benchmark_micro")


def has_option(shown, option):
    return option == "-o" or re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", shown) is not None


def unknown_option(shown, words):
    """Returns the first option among the words that a help does not show, or ""."""
    return next((word for word in words if word.startswith("-") and not has_option(shown, word.split("=")[0])), "")


def fault_of_run(tree, words, again=False):
    try:
        code, said = (tree.run_again if again else tree.run)(*words)
    except subprocess.TimeoutExpired:
        return "takes more than the time it may have"
    return f"fails with exit code {code}: {(said.strip().splitlines() or ['it says nothing'])[-1]}" if code else ""


def fault_of_result(tree, text, path):
    """A folder out/NAME is made by the main job, by a command of the document, or from an input NAME.prm, which it may ask to save."""
    name = path.split("/")[1]
    made = name in MAIN_JOB or f"`out/{name}.prm`" in text or re.search(rf"--output out/{re.escape(name)}(?!\w)", text) or (tree.scratch / "out" / name).exists()
    return "" if made or any(file.endswith(f"/{name}.prm") for file in tree.files) else f"nothing writes '{path}'"


def fault_of_command(tree, command, text):
    """Returns what is wrong with a command, "" if nothing is, None if these words are no command that has a rule."""
    try:
        words = shlex.split(re.sub(r"[][]", " ", command))
    except ValueError:
        return None
    while words[:1] in (["sudo"], ["/usr/bin/python3"]):
        words = words[1:]
    if words[:2] == ["mpirun", "-n"]:
        return fault_of_command(tree, shlex.join(words[3:]), text) or ""
    if not words or (len(words) == 1 and "/" not in words[0]):
        return None
    name = re.sub("^build/(macro|micro)/", "", words[0])
    if name in PROGRAMS and words[0] in (name, f"build/{PROGRAMS[name]}"):
        return fault_of_program(tree, name, words, text, bool(PLACEHOLDER.search(command) or re.search(r"[][|]", command)))
    if words[0] in RULES:
        return RULES[words[0]](tree, words, text)
    script = next((script for script in SCRIPTS if words[0] == script or (len(words) > 1 and script.endswith("/" + words[0]))), None)
    if script:
        return fault_of_script(tree, script, words, text)
    of_tree = words[0].split("/")[0] in (*TOPS, "build") and "/" in words[0]
    return f"no rule says how to try '{words[0]}'" if of_tree and len(words) > 1 and "=" not in words[0] else None


def fault_of_program(tree, name, words, text, usage):
    """A program reads its input with --check in place of a computation; of a line with words to fill in, the options are tried."""
    if option := unknown_option(tree.help_of(name), words):
        return f"{name} has no option '{option}'"
    kept, rest = [], words[1:]
    while rest:
        word = rest.pop(0)
        if word in WRITES:
            rest = rest[WRITES[word]:]
        else:
            kept.append(word)
    if usage or all(word.startswith("-") and word not in ("--help", "--version") for word in kept):
        return ""
    shown = any(word in ("--plan", "--help", "--version") for word in kept)
    return fault_of_run(tree, [tree.program(name), *kept, *([] if shown else ["--check"])])


def fault_of_script(tree, script, words, text):
    """Options, files and results of a script; formulas and concretes are computed."""
    if option := unknown_option(tree.help_of(script), words[1:]):
        return f"{script} has no option '{option}'"
    for before, word in zip(words, words[1:]):
        if word.startswith("out/") and before not in WRITES and not word.endswith(".prm"):
            if fault := fault_of_result(tree, text, word):
                return fault
        elif word.startswith(("data/", "tests/")) and word not in tree.files:
            return f"there is no '{word}'"
    if script == "shared/tension" and not set("|".join(words[1:2]).split("|")) <= {"", "spall", "pull", "split"}:
        return f"shared/tension has no '{words[1]}'"
    if script not in ("shared/formulas", "shared/concrete") or len(words) == 1 or any(map(PLACEHOLDER.search, words)):
        return ""
    if "--output" in words:
        shutil.rmtree(tree.scratch / words[words.index("--output") + 1], ignore_errors=True)
    return fault_of_run(tree, [str(tree.root / script), *words[1:], *(("--build", str(tree.build)) if "--run" in words else ())], again=True)


def fault_of_launcher(tree, words, text):
    """shared/run and spall: their commands, as their help lists them at the begin of lines."""
    script = "shared/run" if words[0] == "shared/run" else "shared/spall"
    code, shown = tree.run(str(tree.root / script), "help")
    names = " | ".join(re.findall(r"^  (\S+(?: \| \w+)*)", shown, re.M)).split(" | ")
    unknown = [word for word in "|".join(words[1:2]).split("|") if word and word not in names]
    return f"{script} help fails" if code else f"{words[0]} has no command '{unknown[0]}'" if unknown else ""


def fault_of_checks(tree, words, text):
    phases = re.search(r"^phases=\((.*)\)$", tree.text(".ci/run"), re.M)[1].split()
    unknown = [word for word in words[1:] if word not in phases and not PLACEHOLDER.fullmatch(word)]
    return f".ci/run has no phase '{unknown[0]}'" if unknown else ""


def presets(tree, kind):
    return [one["name"] for one in json.loads(tree.text("CMakePresets.json"))[kind]]


def fault_of_cmake(tree, words, text):
    """Presets and targets."""
    kind = "buildPresets" if "--build" in words else "configurePresets"
    for before, word in zip(words, words[1:]):
        if before == "--preset" and word not in presets(tree, kind):
            return f"there is no preset '{word}' in {kind}"
        if before == "--target":
            declared = "\n".join(tree.text(file) for file in tree.files if file.endswith("CMakeLists.txt"))
            if not re.search(rf"^ *add_(custom_target|executable|library)\({re.escape(word)}\b", declared, re.M):
                return f"there is no target '{word}'"
    return ""


def fault_of_ctest(tree, words, text):
    """At least one test is chosen."""
    code, said = tree.run("ctest", "--test-dir", str(tree.build), *words[words.index("--test-dir") + 2:], "-N")
    count = re.search(r"^Total Tests: (\d+)", said, re.M)
    return "" if code == 0 and count and int(count[1]) > 0 else "chooses no test"


def fault_of_packages(tree, words, text):
    """Packages that a list or a message of the tree names too, and the package that is built."""
    named = "".join(map(tree.text, ("shared/packages.txt", ".ci/packages.txt", "shared/viewing/view_command.py")))
    version = re.search(r"^project\(\w+\s+VERSION ([\d.]+)", tree.text("CMakeLists.txt"), re.M | re.I)[1]
    for word in words[2:]:
        if word != f"./build-portable/spall_{version}_amd64.deb" and not re.search(rf"(?<![\w-]){re.escape(word)}(?![\w-])", named):
            return f"no list of packages names '{word}'"
    return "" if words[1] == "install" else f"no rule says how to try '{words[0]} {words[1]}'"


def fault_of_fuzzers(tree, words, text):
    folders = [f"build-{name}" for name in presets(tree, "configurePresets")]
    return "" if len(words) == 1 or words[1] in folders else f"no preset builds into '{words[1]}'"


def fault_of_benchmark(tree, words, text):
    name = words[0].rsplit("/", 1)[-1]
    return "" if re.search(rf"\b{name}\b", tree.text("tests/benchmark/CMakeLists.txt")) else f"nothing builds '{name}'"


def fault_of_shell(tree, words, text):
    return "" if words[0] in SHELL else f"no rule says how to try '{words[0]}'"


RULES = {"shared/run": fault_of_launcher, "spall": fault_of_launcher, ".ci/run": fault_of_checks, "cmake": fault_of_cmake, "ctest": fault_of_ctest,
         "apt-get": fault_of_packages, "apt": fault_of_packages, "tests/fuzz/run": fault_of_fuzzers,
         **dict.fromkeys(SHELL, fault_of_shell)} | {
             place + name: fault_of_benchmark for name in BENCHMARKS for place in ("", "build/tests/benchmark/")}
