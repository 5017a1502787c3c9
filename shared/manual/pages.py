"""Writes the pages of the manual for Doxygen: the documents of the tree with links between them, and the inputs that the programs
themselves print.

usage: pages.py BUILD FOLDER"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "shared" / "compare"))

from writing import run_script, write  # noqa: E402

# Documents in the order of the manual, with the names that links use.
DOCUMENTS = {
    "README.md": "mainpage",
    "shared/manual/tutorial.md": "tutorial",
    "shared/manual/theory.md": "theory",
    "data/scenes/README.md": "scenes",
    "data/gallery/README.md": "gallery",
    "data/microcells/README.md": "microcells",
    "data/README.md": "constants",
    "data/studies/README.md": "studies",
    "data/digitised/README.md": "digitised",
    "shared/manual/questions.md": "questions",
    "shared/EXTENDING.md": "extending",
    "CHANGELOG.md": "changelog",
}
PROGRAMS = {"penetrate": "macro/penetrate", "microcell": "micro/microcell", "material_point": "macro/material_point"}


def slug(heading):
    """Returns what a link to a heading is called, as code hosts make it."""
    return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")


def linked(text, folder, here):
    """Returns the text with links to other documents, where it links them or names them in code quotes, from its folder or from the
    root, and with links to its own headings. @param here name of the document itself"""
    def document(path):
        for base in (folder, ROOT):
            whole = (base / path).resolve()
            if whole.is_relative_to(ROOT) and (name := DOCUMENTS.get(str(whole.relative_to(ROOT)))):
                return None if name == here else "index" if name == "mainpage" else name
        return None

    def link(match):
        words, path = match[1] or match[3], match[2] or match[3]
        if path.startswith("#"):
            return f"[{words}](@ref {here}_{path[1:]})"
        return f"[{words}](@ref {name})" if (name := document(path)) else match[0]

    text = re.sub(r"\[([^\]]+)\]\((#[\w-]+|[\w./]+\.md)\)|`([\w./]+\.md)`", link, text)
    return re.sub(r"(?m)^(##+ )(.*)$", lambda heading: f"{heading[0]} {{#{here}_{slug(heading[2])}}}", text)


def outside_code(text, change):
    """Returns the text with change(part) in place of every part outside fenced blocks."""
    return "".join(part if part.startswith("```") else change(part) for part in re.split(r"(?ms)(^```.*?^```$)", text))


def page(path, name):
    """Returns a document as a page of the manual."""
    file = ROOT / path
    title, _, text = file.read_text(encoding="utf-8").partition("\n")
    mark = "" if "{#" in title or name == "mainpage" else f" {{#{name}}}"
    return f"{title}{mark}\n{outside_code(text, lambda part: linked(part, file.parent, name))}"


def inputs(name, program):
    """Returns the page of a program's inputs, as it prints them. @raises subprocess.CalledProcessError"""
    words = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    indented = "\n".join("    " + line for line in words.splitlines())
    return f"# Inputs of {name} {{#inputs_{name}}}\n\nWhat `{name} --help` prints.\n\n{indented}\n"


def main(build, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for path, name in DOCUMENTS.items():
        write(folder / f"{name}.md", page(path, name))
    for name, program in PROGRAMS.items():
        write(folder / f"inputs_{name}.md", inputs(name, build / program))


if __name__ == "__main__":
    sys.exit(run_script("pages.py", lambda: main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))))
