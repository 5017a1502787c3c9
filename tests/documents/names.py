"""Tries what a document says: links, scenes, options, files, keys; commands: commands.py. Each function returns a sentence on what is
wrong, or ""."""

import fnmatch
import pathlib
import re
import shutil

import commands
from reading import PLACEHOLDER, anchors, saved_files
from tree import PROGRAMS, SCRIPTS, TOPS

ENDINGS = r"\.(?:prm|csv|md|h|cc|py|h5|json|html|txt|sh|js|pvd|xdmf|pvsm|stl|cff)$"
KEY = r"[A-Za-z][\w '.-]*(?:/[\w '.-]+)*"  # with or without sections
ANSWERS = ("Exit", "Length", "Momentum", "Penetration")  # keys whose help is not a list of values


def fault_of(tree, document, text, item):
    """Returns what is wrong with an item of a document, or "". document: its path from the root."""
    if item.kind == "link":
        return fault_of_link(tree, document, item.text)
    if item.kind == "scene":
        return fault_of_scene(tree, document, item.text)
    fault = None if item.text.startswith("-") else commands.fault_of_command(tree, item.text, text)
    if fault is None:
        return commands.fault_of_shell(tree, item.text.split(), text) if item.kind == "command" else fault_of_span(tree, text, item.text)
    return fault


def fault_of_link(tree, document, target):
    path, _, place = target.partition("#")
    if "://" in target:
        return ""
    file = (tree.root / document).parent / path if path else tree.root / document
    if not file.exists():
        return f"leads to '{path}', which is not there"
    if place and place not in anchors(file.read_text(encoding="utf-8")):
        return f"leads to '#{place}', which '{file.name}' has not"
    return ""


def fault_of_scene(tree, document, block):
    """Keys of an input; a complete scene is read by the program."""
    for key in re.findall(r"^\s*set ([^=\n]+?)\s*=", block, re.M):
        if "subsection Distributions" not in block and key not in tree.keys:
            return f"no program knows the key '{key}'"
    if "subsection Answers" not in block:
        return ""
    folder = tree.scratch / "out"
    if document.startswith("data/"):  # its includes refer to the folder of the document
        shutil.copytree(tree.root / "data", tree.scratch / "scenes", dirs_exist_ok=True)
        folder = tree.scratch / "scenes" / pathlib.PurePath(document).parent.relative_to("data")
    (folder / "of_a_document.prm").write_text(block, encoding="utf-8")
    code, said = tree.run_again(tree.program("penetrate"), str(folder / "of_a_document.prm"), "--check")
    return f"penetrate --check refuses the scene: {said.strip().splitlines()[-1]}" if code else ""


def fault_of_span(tree, text, span):
    """An option, a file, settings, a key, or just words."""
    if re.match(r"-{1,2}[A-Za-z]", span):
        return fault_of_option(tree, span)
    if span.startswith(("set ", "include ", "/")) or "<" in span or "#" in span:
        return ""
    if re.match(r"\w+/[^=]*=\S+ \w+/", span):  # several settings
        faults = [fault_of_key(tree, *one) for one in re.findall(rf"({KEY})=(\S+(?: \w+(?= |$))?)", span)]
        return next(filter(None, faults), "")
    key, sign, value = (part.strip() for part in span.partition("="))
    if sign:
        return fault_of_key(tree, key, value) if re.fullmatch(KEY, key) else ""
    if is_file(span):
        return fault_of_file(tree, text, span)
    return fault_of_key(tree, span, "") if "/" in span and re.fullmatch(KEY, span) and not re.search(r"\bm/s|[A-Z]{2}/", span) else ""


def is_file(word):
    if re.fullmatch(r"\.\w+|\.\.\.\w*|/", word):  # an ending of names
        return False
    if re.fullmatch(r"[\w.*{},/-]+", word) and re.search(ENDINGS, word):
        return not PLACEHOLDER.search(re.sub(r"[A-Z]+\.(md|cff)$", "", word))
    first = word.split("/")[0]
    return "/" in word and re.fullmatch(r"[\w.{},*/-]+", word) and (first in (*TOPS, "out", "build", "..") or word.endswith("/")) and \
        not PLACEHOLDER.search(word.replace("README", ""))


def fault_of_option(tree, span):
    name = re.split(r"[= ]", span)[0]
    if not name.startswith("-D") and not any(commands.has_option(tree.help_of(one), name) for one in (*PROGRAMS, *SCRIPTS)):
        return f"no program has the option '{name}'"
    key = re.fullmatch(r'--help "?([^"]+?)"?', span)
    return commands.fault_of_run(tree, [tree.program("penetrate"), "--help", key[1]]) if key and key[1] != "KEY" else ""


def fault_of_key(tree, key, value):
    """A key with or without sections, and its value if words are allowed."""
    *sections, last = key.split("/")
    if last == "Key" or re.fullmatch(r"\.+", last):
        return ""
    if last not in tree.keys:
        section = not value and any(last in names for names, _ in tree.keys.values())
        return "" if section or last in ANSWERS else f"no program knows the key '{last}'"
    within, allowed = tree.keys[last]
    if sections and sections[-1] not in within and "NAME" not in within:
        return f"no section '{sections[-1]}' has the key '{last}'"
    value = value.strip('"')
    words = {word.strip() for line in allowed for word in line.split("|")}
    if value and all("|" in line for line in allowed) and not PLACEHOLDER.search(value) and value not in words:
        return f"'{last}' cannot be '{value}', allowed: {', '.join(sorted(words))}"
    return ""


def fault_of_file(tree, text, word):
    """A file by the end of its path, a built one, one that the document asks to save, or one that programs write."""
    options = re.search(r"\{([\w,]+)\}", word)
    for one in [word.replace(options[0], choice) for choice in options[1].split(",")] if options else [word]:
        path = re.sub(r"^(\.\./)+", "", one).rstrip("/")
        if any(fnmatch.fnmatchcase(file, path) or fnmatch.fnmatchcase(file, f"*/{path}") for file in tree.files):
            continue
        if path.removesuffix("/all") in tree.files or path in saved_files(text):  # /all: a target of the build
            continue
        if path in ("build", "out") or (tree.scratch / path).exists() or path.startswith("build/manual/"):
            continue
        if path.startswith("out/") and not re.search(ENDINGS, path):
            if fault := commands.fault_of_result(tree, text, path):
                return fault
        elif path.split("/")[0] in (*TOPS, "build") or not is_written(tree, path.rsplit("/", 1)[-1]):
            return f"there is no '{one}', and nothing writes it"
    return ""


def is_written(tree, name):
    """Returns whether the sources name a file. Of a table, they may name it without its ending: in a word with an underscore, or as
    shared/run does."""
    stem = re.escape(name.removesuffix(".csv"))
    names = [rf"(?<![\w.]){re.escape(name)}", *([rf"^    point {stem} ", *([rf"\"{stem}\""] if "_" in stem else [])] if name.endswith(".csv") else [])]
    return any(re.search(one, tree.sources, re.M) for one in names)
