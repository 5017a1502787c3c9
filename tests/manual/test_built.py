"""The manual: Doxygen makes it without a warning, and its pages lead to one another."""

import pathlib
import re
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop())
sys.path.insert(0, str(ROOT / "shared" / "manual"))

import pages  # noqa: E402


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        pages.main(BUILD, BUILD / "manual" / "pages")
        cls.done = subprocess.run(["doxygen", BUILD / "manual" / "Doxyfile"], capture_output=True, text=True, check=False)

    def test_it_is_built_without_a_warning(self):
        self.assertEqual((self.done.returncode, self.done.stderr), (0, ""))

    def test_every_document_is_a_page_and_every_link_leads_somewhere(self):
        html = BUILD / "manual" / "html"
        for name in [*pages.DOCUMENTS.values(), *(f"inputs_{program}" for program in pages.PROGRAMS)]:
            page = html / ("index.html" if name == "mainpage" else f"{name}.html")
            for target in re.findall(r'href="([\w.]+\.html)', page.read_text(encoding="utf-8")):
                self.assertTrue((html / target).exists(), f"{page.name}: {target}")

    def test_every_key_of_the_scenes_is_in_the_inputs(self):
        text = (BUILD / "manual" / "pages" / "inputs_penetrate.md").read_text(encoding="utf-8")
        for key in ("Run/Until", "Contact/Friction", "Integration/Scheme"):
            self.assertIn(f"    {key}", text)


class Links(unittest.TestCase):
    def linked(self, text):
        return pages.linked(text, ROOT / "data", "constants")

    def test_names_of_documents_become_links_from_their_folder_and_from_the_root(self):
        self.assertEqual(self.linked("see `studies/README.md` and `shared/EXTENDING.md`"),
                         "see [studies/README.md](@ref studies) and [shared/EXTENDING.md](@ref extending)")
        self.assertEqual(self.linked("[scenes](scenes/README.md)"), "[scenes](@ref scenes)")
        self.assertEqual(self.linked("`README.md` `none.md`"), "`README.md` `none.md`")  # the document itself, and none

    def test_headings_can_be_linked(self):
        self.assertEqual(self.linked("## Of A, b\n[there](#of-a-b)"),
                         "## Of A, b {#constants_of-a-b}\n[there](@ref constants_of-a-b)")


if __name__ == "__main__":
    unittest.main()
