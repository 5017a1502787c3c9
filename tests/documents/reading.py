"""Takes out of a document what can be tried: links, commands, names of files, keys, scenes, each with its line."""

import re
from dataclasses import dataclass

# Words that stand for something the reader fills in.
PLACEHOLDER = re.compile(r"\.\.\.|\b(?:[A-Z][A-Z0-9_]*|P%)\b")


@dataclass
class Item:
    """kind: "link", "span" (between backquotes), "command" (a line of a block), "scene" (a block of an input)."""

    kind: str
    text: str
    line: int


def blank(match):
    """Keeps the lines of what is taken out."""
    return "\n" * match[0].count("\n")


def items(text):
    """Returns the items of a document in Markdown."""
    found = []

    def add(kind, words, place):
        found.append(Item(kind, words, text.count("\n", 0, place) + 1))

    for block in re.finditer(r"^```(\w*)\n(.*?)^```$", text, re.M | re.S):
        if block[1] == "python":
            continue
        if is_scene(block[2]):
            add("scene", block[2], block.start(2))
        else:
            commands(block[2], block.start(2), add)
    rest = re.sub(r"^```.*?^```$", blank, text, flags=re.M | re.S)
    offset = dict(zip(range(1, rest.count("\n") + 2), line_starts(text)))
    for block in re.finditer(r"(?:(?<=\n\n)|\A)(?:    .*\n)+", rest):
        words = re.sub("^    ", "", block[0], flags=re.M)
        first = rest.count("\n", 0, block.start()) + 1
        if is_scene(words):
            found.append(Item("scene", words, first))
        elif re.match(r"[\w.]+/[\w./]+ |ctest |cmake ", words):
            for i, line in enumerate(words.splitlines()):
                commands(line, offset[first + i], add)
    for span in re.finditer(r"(?<!`)`([^`]+)`(?!`)", rest):
        found.append(Item("span", " ".join(span[1].split()).replace(r"\|", "|"), rest.count("\n", 0, span.start()) + 1))
    for link in re.finditer(r"\]\(([^)\s]+)\)", rest):
        found.append(Item("link", link[1], rest.count("\n", 0, link.start()) + 1))
    return found


def line_starts(text):
    return [0, *(match.end() for match in re.finditer("\n", text))]


def is_scene(block):
    return re.match(r"\s*(subsection|set|include) ", block) is not None


def commands(block, begin, add):
    """Adds the commands of a block: lines, without comments, parted at &&."""
    for match in re.finditer(r".+", block):
        line = re.sub(r"(^|\s)#.*", "", match[0]).strip()
        for one in re.split(r"\s*&&\s*", line):
            one = one.strip("() ")
            if one:
                add("command", one, begin + match.start())


def anchors(text):
    """Returns the places of a document that can be linked to: those of its headings, and named ones."""
    heads = re.findall(r"^#+ (.*?)(?: \{#([\w-]+)\})?$", text, re.M)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head, _ in heads} | {name for _, name in heads if name}


def saved_files(text):
    """Returns {path: text} of the inputs that a document asks to save."""
    return dict(re.findall(r"[Ss]ave this as\s+`([\w./]+)`[^\n]*:\n\n```\n(.*?)```", text, re.S))
