"""Sections of the report on studies of curves and limits."""

import csv
import json
import pathlib
import sys

import synthetic

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import compare  # noqa: E402
import reading  # noqa: E402
import sections_curves  # noqa: E402

matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})


def point(x, value, low=None, high=None, state="perforated"):
    return {"x": x, "state": state, "value": value, "low": low, "high": high, "failure": ""}


def curve(folder, **changes):
    """Writes what a study of a curve leaves: three runs, one of them without an answer, and a measured value."""
    folder.mkdir(parents=True)
    found = {"points": [point(100.0, None, state="unfinished"), point(200.0, 120.0, 100.0, 140.0), point(300.0, 230.0, 215.0, 245.0)],
             "measured": [[300.0, 224.0, None]], "formulas": {"ACE": [[100.0, 0.0, False], [300.0, 250.0, True]]},
             "fits": [{"name": "linear", "words": "linear: V_bl 90 +- 2 m/s", "line": [[100.0, 10.0], [300.0, 230.0]]}]}
    record = {"study": "made", "input": "made.prm", "key": "projectile/Velocity", "unit": "m/s", "answers": {"exit_velocity": found}} | changes
    (folder / "curve.json").write_text(json.dumps(record), encoding="utf-8")
    return folder


def limit(folder, disorder=None, **changes):
    """Writes what a study of a limit leaves: a search with two runs."""
    folder.mkdir(parents=True)
    record = {"study": "made", "input": "made.prm", "key": "projectile/Velocity", "unit": "m/s", "criterion": "perforation", "width": 2.0,
              "limit": 99.0, "band": [90.0, 105.0], "layouts": {"count": 2, "mean": 101.0, "deviation": 3.0}, "statistic": None,
              "searches": [{"layout": "as it is", "limit": 99.0, "low": 98.0, "high": 100.0, "rises": True, "disorder": disorder}],
              "formulas": [{"formula": "ACE", "limit": 89.5, "outside": True}]} | changes
    (folder / "limit.json").write_text(json.dumps(record), encoding="utf-8")
    columns = ["projectile/Velocity (m/s)", "layout", "model", "passes", "exit_velocity", "exit_velocity_low", "exit_velocity_high"]
    with open(folder / "limit.csv", "w", encoding="utf-8", newline="") as table:
        rows = csv.writer(table)
        rows.writerow(columns)
        rows.writerow(["98", "as it is", "as it is", "no", "", "", ""])
        rows.writerow(["100", "as it is", "as it is", "yes", "20", "0", "40"])
    return folder


class Sections(synthetic.InFolder):
    def test_a_measured_value_is_held_against_the_band_of_the_run_at_its_place(self):
        record = reading.read_result(curve(self.folder / "curve")).record
        found = record["answers"]["exit_velocity"]
        said, = sections_curves.measured_sentences(record, "exit_velocity", found)
        self.assertIn("at 300 m/s", said)
        self.assertIn("measured 224.0 m/s, within the numerical band", said)
        found["measured"] = [[300.0, 250.0, None], [250.0, 170.0, None]]
        said, = sections_curves.measured_sentences(record, "exit_velocity", found)  # no run at 250 m/s
        self.assertIn("outside the numerical band", said)

    def test_the_limit_is_said_with_its_ranges(self):
        said = sections_curves.limit_sentence(reading.read_result(limit(self.folder / "limit")).record)
        for words in ("limit 99 ± 1 m/s", "numerically 90 to 105", "2 layouts: mean 101, standard deviation 3 m/s"):
            self.assertIn(words, said)
        none = reading.read_result(limit(self.folder / "none", limit=None)).record
        self.assertIn("no limit was found", sections_curves.limit_sentence(none))

    def test_both_are_in_the_report_with_their_warnings(self):
        output = self.folder / "report"
        compare.main([str(curve(self.folder / "curve")), str(limit(self.folder / "limit", disorder=[98.5, 104.0])), "--output", str(output)])
        text = (output / "report.html").read_text(encoding="utf-8")
        for words in ("Curve: curve", "Limit: limit", "answers are out of order between 98.5 and 104.0 m/s", "exit velocity against projectile/Velocity"):
            self.assertIn(words, text)
        self.assertNotIn("cannot be reported in full", text)
        self.assertTrue((output / "limit.svg").is_file())

    def test_damaged_records_are_refused_by_name(self):
        folder = curve(self.folder / "curve")
        (folder / "curve.json").write_text("{}", encoding="utf-8")
        with self.assertRaisesRegex(reading.Unreadable, "curve.json: 'study'"):
            reading.read_result(folder)
        folder = limit(self.folder / "limit")
        (folder / "limit.csv").write_text("a,b\n1,2\n", encoding="utf-8")
        self.assertIn("limit.csv", reading.read_result(folder).missing[0])
