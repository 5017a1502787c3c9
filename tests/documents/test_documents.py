"""Every command, link, file name and key of the documents works."""

import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop())

import names  # noqa: E402
import reading  # noqa: E402
import tree  # noqa: E402

DOCUMENTS = ["README.md", *sorted(path.relative_to(ROOT).as_posix() for pattern in (
    "data/README.md", "data/*/README.md", "shared/manual/*.md", "shared/EXTENDING.md", ".github/CONTRIBUTING.md") for path in ROOT.glob(pattern))]


class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.tree = tree.Tree(ROOT, BUILD.resolve(), pathlib.Path(temporary.name))

    def faults(self, document, text):
        """Returns "file:line: item: what is wrong" of all that is wrong in a document."""
        for path, content in reading.saved_files(text).items():
            (self.tree.scratch / path).write_text(content, encoding="utf-8")
        return [f"{document}:{item.line}: `{item.text.splitlines()[0]}` {fault}" for item in reading.items(text)
                if (fault := names.fault_of(self.tree, document, text, item))]

    def test_every_document_works(self):
        found, tried = [], 0
        for document in DOCUMENTS:
            text = (ROOT / document).read_text(encoding="utf-8")
            tried += len(reading.items(text))
            found += self.faults(document, text)
        self.assertEqual(found, [], "\n" + "\n".join(found))
        self.assertGreater(tried, 1000)

    def test_what_is_broken_is_found_with_its_line(self):
        broken = [
            "[there](data/none.md)", "[there](data/scenes/README.md#no-such-place)", "`data/scenes/none.prm`", "`none.csv`",
            "`penetrate data/scenes/none.prm`", "`penetrate data/scenes/slab_127.prm --fast`", "`shared/study data/studies/none.prm`",
            "`penetrate data/scenes/slab_127.prm slab/Layot=lattice`", "`slab/Layout=lattce`", "`Time/Ende time`", "`--accuraccy`",
            "`shared/view out/none`", "`shared/view out/slab_127 --pictures x.png`", "`shared/run tests`", "`.ci/run linting`",
            "`ctest --test-dir build -R no_such_test`", "`cmake --preset fast`", "`cmake --build build --target none`",
            "`apt-get install none`", "`shared/concrete --strength \"35 kg\" --aggregate \"9.5 mm\" --density \"2320 kg/m3\" --output out/c`",
            "`shared/formulas data/scenes/slab_127.prm projectile/Mas=3`", "`--help \"Time/Ende time\"`", "`shared/tool x`",
            "```\nshared/compare/compare.py out/slab_127 --outptu x\n```", "```\nsubsection slab\n  set Heigth = 1 m\nend\n```",
            "`mpirun -n 2 build/macro/penetrat data/scenes/slab_127.prm`", "`spall penetrat x`", "`tests/fuzz/run build-fast 3`",
        ]
        sound = "# What works\n\nSee `data/scenes/slab_127.prm` and\n[there](data/scenes/README.md#reinforcement).\n\n"
        self.assertEqual(self.faults("README.md", sound), [])
        for one in broken:
            found = self.faults("README.md", f"{sound}{one}\n\n{sound}")
            line = 6 + ("```" in one)
            self.assertEqual([re.match(r"README.md:(\d+): ", fault)[1] for fault in found], [str(line)], (one, found))

    def test_scenes_that_are_refused_are_found(self):
        name = "data/scenes/README.md"
        text = (ROOT / name).read_text(encoding="utf-8")
        self.assertIn("set Height  = 100 mm", text)
        found = self.faults(name, text.replace("set Height  = 100 mm", "set Height  = 100 kg"))
        self.assertEqual(len(found), 1, found)
        self.assertIn("penetrate --check refuses", found[0])


if __name__ == "__main__":
    unittest.main()
