"""The sources and the programs that documents speak of, and a folder in which commands are tried."""

import functools
import os
import re
import shutil
import subprocess

TOPS = ("macro", "micro", "shared", "data", "tests", ".ci", ".github")
PROGRAMS = {"penetrate": "macro/penetrate", "microcell": "micro/microcell", "material_point": "macro/material_point"}
SCRIPTS = ("shared/study", "shared/formulas", "shared/concrete", "shared/tension", "shared/view", "shared/compare/compare.py",
           "shared/compare/sealed.py", "tests/benchmark/ratio.py", ".ci/numbers_record.py")


class Tree:
    """The sources at `root` with the programs in `build`; scratch: a folder in which commands run, with links to both and the table
    of the main job."""

    def __init__(self, root, build, scratch):
        self.root, self.build, self.scratch = root, build, scratch
        for path in root.iterdir():
            if path.name in TOPS or path.is_file():
                (scratch / path.name).symlink_to(path)
        (scratch / "build").symlink_to(build)
        (scratch / "out" / "microcell").mkdir(parents=True)
        shutil.copy(root / "data" / "tables" / "wes5000.h5", scratch / "out" / "microcell" / "damage_table.h5")

    @functools.cached_property
    def files(self):
        """Paths of all sources and of their folders, from the root."""
        found = [path.name for path in self.root.iterdir() if path.is_file()]
        for top in TOPS:
            found += [path.relative_to(self.root).as_posix() for path in (self.root / top).rglob("*") if "__pycache__" not in path.parts]
        return [*found, *TOPS]

    def text(self, path):
        return (self.root / path).read_text(encoding="utf-8")

    @functools.cached_property
    def sources(self):
        """The text of all programs and scripts: the names of the files that they write are in it."""
        return "\n".join(self.text(file) for file in self.files
                         if file.startswith(("macro/", "micro/", "shared/")) and file.endswith((".cc", ".h", ".py", "/run")))

    @functools.cache
    def run(self, *words):
        """Runs a command that writes nothing. Returns its exit code and what it says."""
        return self.run_again(*words)

    def run_again(self, *words):
        done = subprocess.run(words, cwd=self.scratch, capture_output=True, text=True, check=False, timeout=50,
                              stdin=subprocess.DEVNULL, env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"})
        return done.returncode, done.stdout + done.stderr

    def program(self, name):
        return str(self.build / PROGRAMS[name])

    def help_of(self, name):
        """Returns the help of a program or script; of a script without one its source, which begins with its usage."""
        if name in PROGRAMS:
            return self.run(self.program(name), "--help")[1]
        source = self.text(name)
        return self.run("/usr/bin/python3", str(self.root / name), "--help")[1] if "run_script" in source or "argparse" in source else source

    @functools.cached_property
    def keys(self):
        """{last part of a key: (sections in which it is, what is allowed)} of all programs; of studies, whose help shows examples
        only, anything is."""
        found = {}
        for name in PROGRAMS:
            for match in re.finditer(r"^  (\S.*)/([^/\n]+)\n(?:      .*\n)*?      .*?allowed: (.*)$", self.help_of(name), re.M):
                sections, allowed = found.setdefault(match[2], (set(), []))
                sections.update(match[1].split("/"))
                allowed.append(match[3])
        for key in re.findall(r"^    set (\w[\w ]*?) +=", self.help_of("shared/study"), re.M):
            sections, allowed = found.setdefault(key, (set(), []))
            sections.add("Study")
            allowed.append("anything")
        return found
