"""Laws of what users write: tables of experiments from any spreadsheet, names with the sign of a comment in inputs."""

import pathlib
import sys
import unittest

import synthetic

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import files  # noqa: E402
import inputs  # noqa: E402
import references  # noqa: E402


class Tables(synthetic.InFolder):
    def rows(self, text, needed=("thickness_mm",)):
        path = self.folder / "perforation.csv"
        path.write_bytes(text.encode("utf-8"))
        return references.read_rows(path, needed)

    def test_what_spreadsheets_write_is_the_same_table(self):
        expected = [{"thickness_mm": 127.5, "name": "a, b", "exit": None}]
        for text in ('thickness_mm,name,exit\n127.5,"a, b",\n', '# c\nThickness_mm , NAME, Exit\n+127.5, "a, b" ,\n',
                     '"thickness_mm";"name";"exit"\r\n127.5;a, b;\r\n', '\ufeffthickness_mm,name,exit\n"127.5","a, b",\n',
                     '\ufeff# c\nthickness_mm;name;exit\n\n127.5;"a, b";\n'):
            self.assertEqual(self.rows(text), expected, text)

    def test_refusals_name_file_found_and_allowed(self):
        for text, words in (("thickness_mm;exit\n127,5;1\n", "found '127,5', allowed: a number with a decimal point"),
                            ('thickness_mm,exit\n1,"-,5e3"\n', "found '-,5e3', allowed: a number with a decimal point"),
                            ("thickness_mm,exit\n127,5,1\n", "row 1 has 3 columns, the header 2 .a number has a decimal point"),
                            ("thickness_mm,exit\n127\n", "row 1 has 1 columns, the header 2$"),
                            ("thickness\texit\n127\t1\n", "column 'thickness_mm' is missing, found: thickness\texit")):
            with self.assertRaisesRegex(files.Unreadable, "perforation.csv: .*" + words):
                self.rows(text)

    def test_every_file_of_the_data_folder_has_what_it_needs(self):
        read = references.References.read()
        self.assertTrue(read.perforation and read.taylor and read.peers and read.verification)


class Comments(unittest.TestCase):
    def test_a_comment_begins_at_the_start_or_after_a_blank(self):
        for text, words in (("a # b", "a"), ("# b", ""), (" a#b\t#c", "a#b"), ('"a #1" # b', "a #1"), ('"a ""b"""', 'a "b"')):
            self.assertEqual(inputs.without_comment(text), words)
        for text in ('"a', '"a" b'):
            with self.assertRaises(ValueError):
                inputs.without_comment(text)

    def test_resolved_inputs_are_read_as_the_programs_write_them(self):
        text = '# p\nsubsection slab\n  set A   = 5 mm\n  subsection AFC\n    set Table = "/a #1/t.h5"\n    set B = c#d\n  end\nend\n'
        self.assertEqual(inputs.parse_inputs(text), {"slab/A": "5 mm", "slab/AFC/Table": "/a #1/t.h5", "slab/AFC/B": "c#d"})


if __name__ == "__main__":
    unittest.main()
