#!/usr/bin/python3
"""The comparison of numbers_record.py, with made-up numbers."""

import contextlib
import io
import pathlib
import tempfile
import unittest

import numbers_record as numbers


def row(name, value, band, unit="1"):
    return {"number": name, "value": value, "unit": unit, "band": band, "note": ""}


class Bands(unittest.TestCase):
    record = {"count": row("count", "1000", "0.5 %"), "velocity": row("velocity", "-200", "1.5", "m/s")}

    def verdicts(self, **found):
        return {name: verdict for name, *_, verdict in numbers.compared(self.record, found)}

    def test_a_change_within_the_band_passes_to_its_edge_on_both_sides(self):
        for count, velocity in ((1000, -200), (1005, -201.5), (995, -198.5)):
            self.assertEqual(self.verdicts(count=count, velocity=velocity), {"count": "", "velocity": ""})

    def test_a_change_beyond_it_fails_on_both_sides(self):
        for count, velocity in ((1006, -201.6), (994, -198.4), (float("nan"), float("inf"))):
            self.assertEqual(set(self.verdicts(count=count, velocity=velocity).values()), {"changed beyond its band"})

    def test_numbers_that_come_and_go_fail(self):
        self.assertEqual(self.verdicts(count=1000, new=3),
                         {"count": "", "velocity": "is not measured any more", "new": "is not in the record"})

    def test_the_table_names_number_before_now_and_band(self):
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(numbers.report(numbers.compared(self.record, {"count": 1000, "velocity": -190.0})), 1)
        self.assertEqual(said.getvalue().splitlines()[-1].split(),
                         ["velocity", "-200", "-190", "1.5", "m/s", "changed", "beyond", "its", "band"])

    def test_a_recorded_change_passes_and_only_it_has_the_reason(self):
        found = {"count": 1001, "velocity": -190.0}
        taken = numbers.updated(self.record, found, "another friction")
        self.assertEqual([(r["value"], r["note"]) for r in taken.values()], [("1000", ""), ("-190", "another friction")])
        self.assertEqual({verdict for *_, verdict in numbers.compared(taken, found)}, {""})


class Record(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.path = pathlib.Path(scratch.name) / "numbers.csv"

    def test_what_is_written_is_read_again(self):
        rows = {"a": row("a", "1", "2 %"), "b": row("b", "2.5", "0", "m/s") | {"note": "why, so"}}
        numbers.write_record(self.path, ["# one", "# two"], rows)
        self.assertEqual(numbers.read_record(self.path), (rows, ["# one", "# two"]))

    def test_a_bad_record_is_refused(self):
        head = "number,value,unit,band,note\n"
        for text, words in (("", "columns"), ("a,b\n", "columns"), (head + "a,1,1\n", "a,1,1"), (head + "a,x,1,1,\n", "a,x"),
                            (head + "a,1,1,x %,\n", "x %"), (head + "a,1,1,-1,\n", "-1"), (head + "a,1,1,1,\na,2,1,1,\n", "twice")):
            self.path.write_text(text, encoding="utf-8")
            with self.assertRaisesRegex(numbers.Failed, words):
                numbers.read_record(self.path)

    def test_the_record_of_the_tree_can_be_read_and_has_what_is_measured(self):
        record, _ = numbers.read_record(numbers.RECORD)
        expected = [f"instructions_{kernel}" for kernel in numbers.KERNELS] + [
            f"{name}_{key}" for name, _, keys in numbers.RUNS for key in keys] + [f"size_{name}" for name in numbers.PROGRAMS]
        self.assertEqual(list(record), expected)


if __name__ == "__main__":
    unittest.main()
