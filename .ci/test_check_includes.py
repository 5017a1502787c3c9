#!/usr/bin/python3
"""The include check lets the allowed directions pass and names file and line of every other one."""

import pathlib
import tempfile
import unittest

import check_includes


def problems(files):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in files.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        return check_includes.check(root)


class IncludeDirection(unittest.TestCase):
    def assert_allowed(self, file, included):
        self.assertEqual(problems({file: f'#include "{included}"\n'}), [])

    def assert_refused(self, file, included):
        found = problems({file: f'#pragma once\n#include "{included}"\n'})
        self.assertEqual(len(found), 1, f"{file} includes {included}")
        self.assertTrue(found[0].startswith(f"{file}:2: "), found[0])

    def test_both_programs_include_shared_only(self):
        self.assert_allowed("micro/a.cc", "shared/error.h")
        self.assert_allowed("macro/a.cc", "shared/error.h")
        self.assert_refused("shared/a.h", "micro/b.h")
        self.assert_refused("shared/a.h", "macro/b.h")
        self.assert_refused("micro/a.h", "macro/points/b.h")
        self.assert_refused("macro/points/a.h", "micro/b.h")

    def test_rooms_include_earlier_rooms_only(self):
        order = ["points", "approximation", "material", "dynamics", "output"]
        for i, earlier in enumerate(order):
            self.assert_allowed("macro/penetrate.cc", f"macro/{earlier}/b.h")
            self.assert_refused(f"macro/{earlier}/a.h", "macro/penetrate.h")
            for later in order[i + 1:]:
                self.assert_allowed(f"macro/{later}/a.h", f"macro/{earlier}/b.h")
                self.assert_refused(f"macro/{earlier}/a.h", f"macro/{later}/b.h")

    def test_rooms_of_equal_rank_keep_apart_but_for_the_named_exceptions(self):
        self.assert_refused("macro/contact/a.h", "macro/material/b.h")
        self.assert_refused("macro/integration/a.h", "macro/scene/b.h")
        self.assert_refused("macro/integration/a.h", "macro/material/j2.h")
        self.assert_allowed("macro/integration/a.h", "macro/material/material.h")
        self.assert_allowed("macro/integration/a.h", "macro/points/tensor.h")
        self.assert_allowed("macro/scene/a.h", "macro/material/j2.h")
        self.assert_allowed("macro/scene/a.h", "macro/contact/b.h")

    def test_a_room_without_a_place_is_named(self):
        self.assertIn("macro/attic", problems({"macro/attic/a.h": '#include "macro/points/b.h"\n'})[0])

    def test_an_include_relative_to_the_file_is_followed(self):
        files = {"macro/points/a.h": '#include "../output/b.h"\n', "macro/output/b.h": ""}
        self.assertEqual(len(problems(files)), 1)

    def test_an_angle_include_is_no_way_round(self):
        self.assertEqual(len(problems({"micro/a.h": "#include <macro/points/b.h>\n"})), 1)


if __name__ == "__main__":
    unittest.main()
