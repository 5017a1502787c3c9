#!/usr/bin/python3
"""What counts as the change, in clones of every depth, and where a changed header is checked."""

import pathlib
import subprocess
import tempfile
import unittest

import lint


def git(folder, *words):
    names = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "protocol.file.allow=always"]
    subprocess.run(["git", "-C", str(folder), *names, *words], check=True, capture_output=True)


def commit(folder, files, message):
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    git(folder, "add", "-A")
    git(folder, "commit", "-m", message)


class Change(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.origin = pathlib.Path(self.scratch.name) / "origin"
        self.origin.mkdir()
        git(self.origin, "init", "-b", "main")
        commit(self.origin, {"shared/a.cc": "1", "shared/b.cc": "1", "README.md": "1"}, "first")
        commit(self.origin, {"shared/b.cc": "2", "README.md": "2"}, "second")

    def clone(self, *options):
        git(self.origin, "clone", *options, f"file://{self.origin}", str(self.origin.parent / "clone"))
        return self.origin.parent / "clone"

    def changed(self, folder):
        return lint.changed_files(folder)[0]

    def test_a_branch_is_compared_with_where_it_left_the_main_branch(self):
        clone = self.clone()
        git(clone, "checkout", "-b", "work")
        commit(clone, {"macro/c.h": "1"}, "third")
        commit(clone, {"macro/d.cc": "1", "data/x.prm": "1"}, "fourth")
        self.assertEqual(self.changed(clone), ["macro/c.h", "macro/d.cc"])

    def test_the_main_branch_is_compared_with_the_commit_before(self):
        self.assertEqual(self.changed(self.origin), ["shared/b.cc"])
        self.assertEqual(self.changed(self.clone()), ["shared/b.cc"])

    def test_what_is_not_committed_counts_and_what_is_gone_does_not(self):
        (self.origin / "shared/a.cc").write_text("3", encoding="utf-8")
        (self.origin / "shared/b.cc").unlink()
        self.assertEqual(self.changed(self.origin), ["shared/a.cc"])

    def test_a_shallow_clone_fetches_one_commit_more(self):
        self.assertEqual(self.changed(self.clone("--depth=1")), ["shared/b.cc"])

    def test_a_shallow_clone_without_its_origin_takes_every_file(self):
        clone = self.clone("--depth=1")
        git(clone, "remote", "set-url", "origin", "file:///nowhere")
        self.assertEqual(self.changed(clone), ["shared/a.cc", "shared/b.cc"])

    def test_a_change_of_other_files_alone_is_no_work(self):
        commit(self.origin, {"README.md": "3"}, "third")
        self.assertEqual(self.changed(self.origin), [])


class Plan(unittest.TestCase):
    def test_a_header_is_checked_in_its_own_file_or_in_one_that_includes_it(self):
        with tempfile.TemporaryDirectory() as scratch:
            root = pathlib.Path(scratch)
            texts = {"shared/a.cc": '#include "shared/a.h"\n', "shared/b.cc": '#include "shared/c.h"\n', "shared/a.h": "",
                     "shared/c.h": "", "shared/d.h": ""}
            for name, text in texts.items():
                (root / name).parent.mkdir(exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            work, orphans = lint.plan(root, ["shared/a.h", "shared/b.cc", "shared/c.h", "shared/d.h"],
                                      ["shared/a.cc", "shared/b.cc"])
            self.assertEqual(work, {"shared/a.cc": ["shared/a.h"], "shared/b.cc": ["shared/b.cc", "shared/c.h"]})
            self.assertEqual(orphans, ["shared/d.h"])


if __name__ == "__main__":
    unittest.main()
