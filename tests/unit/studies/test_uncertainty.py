"""Samples of uncertain inputs, their bands and contributions, on a program that answers at once."""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
from statistics import NormalDist
from unittest import mock

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "studies"))

import distributions  # noqa: E402
import latin_hypercube  # noqa: E402
import runs  # noqa: E402
import scatter  # noqa: E402
import study_file  # noqa: E402
import uncertainty  # noqa: E402
import workers  # noqa: E402

# exit = 100 + 3 a + b, or 0 if that is below 101; it fails for a > 0.9 and refuses b > 5. The depth is null behind an exit.
PROGRAM = """#!/usr/bin/python3 -SE
import json, os, sys
said = dict(word.split("=") for word in sys.argv if "=" in word)
a, b = (float(said.get(key, "0").split()[0]) for key in ("A/a", "A/b"))
if b > 5:
    print(f"warning\\npenetrate: key 'b': found '{b:g}', allowed: at most 5", file=sys.stderr)
    sys.exit(2)
if "--plan" in sys.argv: sys.exit(0)
folder = sys.argv[sys.argv.index("--output") + 1]; os.makedirs(folder, exist_ok=True)
if a > 0.9: sys.exit("no luck")
with open(os.path.dirname(__file__) + "/count", "a") as count: count.write("x")
out = 100 + 3 * a + b
open(folder + "/resolved.prm", "w").close()
open(folder + "/summary.json", "w").write(json.dumps({"program": "penetrate", "thickness": 0.127, "impact_velocity": 313, "version": "0",
    "diameter": 1.52, "projectile_mass": 2.34, "projectile_radius": 0.0254, "projectile_length": 0.3556,
    "exit_velocity": out if out >= 101 else 0, "exit_velocity_low": out - 2, "exit_velocity_high": out + 4,
    "penetration_depth": None if out >= 101 else 0.1}))
"""
STUDY = """
subsection Study
  set Kind    = uncertainty
  set Program = penetrate
  set Input   = case.prm
  set Answers = exit_velocity, penetration_depth
  set Samples = 25
  set Seed    = 3
end
subsection Distributions
  set first  = A/a=uniform 0 1 MPa    # from nowhere
  set second = A/b=uniform 0 1
  set table  = A/t=choice weak | mean weight 2
  set layout = A/seed=integers 1 1000
end
"""


def law(text):
    return distributions.read("x", f"A/a={text}", 1)


class Sampling(unittest.TestCase):
    def test_each_interval_of_equal_probability_has_one_sample(self):
        for count in (25, 50, 100, 200):
            for name in ("a", "b"):
                places = latin_hypercube.places(5, name, count)
                self.assertEqual(sorted((count * places).astype(int)), list(range(count)))
            self.assertTrue(latin_hypercube.is_complete(count))
        self.assertEqual([n for n in range(1, 210) if latin_hypercube.is_complete(n)], [25, 50, 100, 200])

    def test_a_larger_study_keeps_the_samples(self):
        long = latin_hypercube.places(5, "a", 333)
        for count in (1, 7, 25, 26, 60, 200):
            self.assertEqual(list(latin_hypercube.places(5, "a", count)), list(long[:count]))

    def test_samples_are_those_of_the_seed_on_any_machine(self):
        """Made of raw bits of PCG64: numbers that must never change, or studies would not find their runs again."""
        self.assertEqual([round(float(u), 12) for u in latin_hypercube.places(1, "friction", 3)],
                         [0.974243113716, 0.195269359225, 0.635289955876])
        self.assertFalse(set(latin_hypercube.places(1, "a", 50)) & set(latin_hypercube.places(2, "a", 50)))
        self.assertFalse(set(latin_hypercube.places(1, "a", 50)) & set(latin_hypercube.places(1, "b", 50)))

    def test_inputs_are_paired_at_random(self):
        pairs = [latin_hypercube.places(seed, name, 200) for seed in range(20) for name in ("a", "b")]
        found = [np.corrcoef(pairs[i], pairs[i + 1])[0, 1] for i in range(0, 40, 2)]
        self.assertLess(max(map(abs, found)), 4 / math.sqrt(200))
        self.assertGreater(np.std(found), 0.3 / math.sqrt(200))


class Distributions(unittest.TestCase):
    def test_quantiles_are_those_of_closed_forms(self):
        normal = NormalDist()
        for text, u, expected in [("uniform 2 4 MPa", 0.25, 2.5), ("triangular 0 1 4", 0.25, 1),
                                  ("triangular 0 1 4", 0.0625, 0.5), ("triangular 0 1 4", 0.75, 4 - math.sqrt(3)),
                                  ("triangular 0 0 4", 0.75, 2),
                                  ("normal 10 2 m truncated 3 SD", 0.5, 10), ("normal 10 2 m truncated 3 SD", 0, 4),
                                  ("normal 10 2 m truncated 3 SD", 1, 16), ("normal 10 2 m truncated 9 12", 0, 9),
                                  ("normal 10 2 m truncated 10 50", 0.5, 10 + 2 * normal.inv_cdf(0.75)),
                                  ("lognormal 8 2 m", 0.5, 8), ("lognormal 8 2 m", normal.cdf(1), 16),
                                  ("lognormal 8 2 m truncated 4 32", 0, 4), ("lognormal 8 2 m truncated 1 SD", 1, 16)]:
            self.assertAlmostEqual(law(text).number(u), expected, places=9, msg=text)

    def test_alternatives_come_as_often_as_their_weights_say(self):
        places = latin_hypercube.places(1, "x", 400)
        found = [law("choice a b | c weight 2 | d").texts(u) for u in places]
        self.assertEqual([found.count((value,)) for value in ("a b", "c", "d")], [100, 200, 100])
        numbers = [law("integers -1 2").number(u) for u in places]
        self.assertEqual([numbers.count(value) for value in range(-1, 3)], 4 * [100])

    def test_numbers_keep_their_unit_and_one_draw_sets_several_keys(self):
        self.assertEqual(law("uniform 2 4 1/MPa").settings(0.25), {"A/a": "2.5 1/MPa"})
        self.assertEqual(law("uniform 2 4 1/MPa").columns(0.25), {"x (1/MPa)": "2.5"})
        both = distributions.read("x", "A/a + B/b=uniform 0 1 m, uniform 5 3.7e1", 1)
        self.assertEqual(both.settings(0.5), {"A/a": "0.5 m", "B/b": "21"})
        self.assertEqual(both.columns(0.5), {"x A/a (m)": "0.5", "x B/b": "21"})
        self.assertEqual(distributions.read("x", "A/a + B/b=uniform 0 1 m", 1).settings(0.5), {"A/a": "0.5 m", "B/b": "0.5 m"})
        pair = distributions.read("x", "A/a + B/b=choice 1, 2 | 3, 4", 1)
        self.assertEqual((pair.settings(0.1), pair.settings(0.6)), ({"A/a": "1", "B/b": "2"}, {"A/a": "3", "B/b": "4"}))
        self.assertEqual(pair.ends(), [pair.settings(0.1), pair.settings(0.6)])
        self.assertEqual(law("normal 10 2 m truncated 3 SD").ends(), [{"A/a": "4 m"}, {"A/a": "16 m"}])


class Statistics(unittest.TestCase):
    def test_quantiles_of_a_known_function_lie_in_the_band(self):
        values = latin_hypercube.places(1, "x", 400) ** 2
        for end, level in zip(scatter.band(values), (0.05, 0.5, 0.95)):
            self.assertAlmostEqual(end["value"], level**2, delta=0.003)
            self.assertLess(end["low"], level**2)
            self.assertGreater(end["high"], level**2)

    def test_the_stated_confidence_is_reached(self):
        """Of 2000 sets of independent numbers nine tenths or a little more have the quantile between the order statistics."""
        sets = np.sort(np.random.Generator(np.random.PCG64(1)).random((2000, 80)), axis=1)
        for level in (0.05, 0.5, 0.95):
            r, s = scatter.ranks_around(80, level)
            share = np.mean((sets[:, r - 1] <= level) & (level <= sets[:, s - 1]))
            self.assertGreater(share, 0.89)
            self.assertLess(share, 0.96)

    def test_59_values_bound_both_ends_and_58_do_not(self):
        for count, bounded in ((58, False), (59, True)):
            ends = scatter.band(np.arange(float(count)))
            self.assertEqual((ends[0]["low"] is not None, ends[2]["high"] is not None), (bounded, bounded))

    def contributions(self, count, answer):
        inputs = {name: latin_hypercube.places(1, name, count) for name in "abcd"}
        return scatter.contributions({name: (u, False) for name, u in inputs.items()}, answer(**inputs))

    def test_contributions_of_a_linear_function_are_its_shares_of_variance(self):
        found = self.contributions(800, lambda a, b, c, d: 3 * a - 2 * b + c)
        for name, expected in zip("abcd", (9 / 14, 4 / 14, 1 / 14, 0)):
            self.assertAlmostEqual(found["shares"][name], expected, delta=0.03)
            sign = -1 if name == "b" else 1
            self.assertAlmostEqual(found["spearman"][name], sign * math.sqrt(expected), delta=0.07)
        self.assertAlmostEqual(found["r2"], sum(found["shares"].values()))
        self.assertGreater(found["r2"], 0.95)
        self.assertEqual(scatter.cautions(800, found), [])

    def test_errors_of_shares_are_those_of_other_samples(self):
        """Independent samples of y = 2 a + b, 60 at a time: their shares scatter by as much as the errors say."""
        bits, shares, errors = np.random.Generator(np.random.PCG64(4)), [], []
        for _ in range(40):
            a, b = bits.random((2, 60))
            inputs = {"a": (a, False), "b": (b, False)}
            shares.append(scatter.contributions(inputs, 2 * a + b)["shares"]["a"])
            errors.append(scatter.share_errors(inputs, 2 * a + b)["a"])
        self.assertAlmostEqual(np.mean(errors) / np.std(shares), 1, delta=0.3)
        few = {name: (np.arange(3.0), False) for name in "ab"}
        self.assertEqual(scatter.share_errors(few, np.arange(3.0)), {"a": None, "b": None})

    def test_ranks_see_a_monotonic_function_as_a_line_and_others_not(self):
        self.assertAlmostEqual(self.contributions(200, lambda a, **_: np.exp(9 * a))["r2"], 1)
        found = self.contributions(200, lambda a, **_: (a - 0.5) ** 2)
        self.assertLess(found["r2"], 0.1)
        self.assertIn("a sum of the inputs' effects", scatter.cautions(200, found)[0])

    def test_an_alternative_contributes_without_an_order(self):
        places = latin_hypercube.places(1, "x", 300)
        alternative = np.floor(3 * places)
        answer = np.array([5.0, 0.0, 5.0])[alternative.astype(int)] + 1e-9 * latin_hypercube.places(1, "y", 300)
        found = scatter.contributions({"x": (alternative, True)}, answer)
        self.assertIsNone(found["spearman"]["x"])
        self.assertEqual(found["regressors"], 2)
        self.assertGreater(found["shares"]["x"], 0.6)  # as ordered numbers: nothing
        self.assertLess(scatter.contributions({"x": (alternative, False)}, answer)["r2"], 0.01)

    def test_too_few_samples_are_told(self):
        found = self.contributions(5, lambda a, **_: a)
        self.assertIsNone(found["r2"])
        self.assertIn("no shares of variance", scatter.cautions(5, found)[0])
        found = self.contributions(39, lambda a, **_: a)
        self.assertIn("39 values are few for 4 regressors", scatter.cautions(39, found)[0])
        self.assertEqual(scatter.cautions(40, self.contributions(40, lambda a, **_: a)), [])
        self.assertIsNone(self.contributions(40, lambda a, **_: 0 * a)["r2"])  # nothing changes

    def test_the_band_of_the_first_samples_ends_at_that_of_all(self):
        values, used = np.arange(90.0), np.delete(np.arange(100), range(10, 20))
        steps = scatter.growth(values, used)
        self.assertEqual(steps[-1], {"samples": 100, "band": scatter.band(values)})
        self.assertEqual(steps[0], {"samples": 10, "band": scatter.band(values[:10])})
        counts = [step["samples"] for step in steps]
        self.assertEqual(counts, sorted(set(counts)))
        self.assertEqual(scatter.ranks(np.array([3.0, 1, 3, 0])).tolist(), [3.5, 2, 3.5, 1])


class Study(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.out = self.folder / "out"
        (self.folder / "case.prm").write_text("")
        self.program = self.folder / "build" / "macro" / "penetrate"
        self.program.parent.mkdir(parents=True)
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)

    def write(self, text):
        path = self.folder / "study.prm"
        path.write_text(text)
        return path

    def begun(self):
        counted = self.program.parent / "count"
        return len(counted.read_text()) if counted.exists() else 0

    def study(self, text, *more):
        return subprocess.run([ROOT / "shared" / "study", self.write(text), "--build", self.folder / "build", "--output", self.out,
                               *more], capture_output=True, text=True, check=False)

    def table(self):
        with open(self.out / "samples.csv", newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream))

    def test_failed_samples_and_missing_values_are_shown(self):
        done = self.study(STUDY)
        self.assertEqual(done.returncode, 3, done.stderr)
        rows, record = self.table(), json.loads((self.out / "uncertainty.json").read_text())
        self.assertEqual(len(rows), 25)
        places = latin_hypercube.places(3, "first", 25)
        for u, row in zip(places, rows):
            a, b = float(row["first (MPa)"]), float(row["second"])
            self.assertAlmostEqual(a, u, places=9)
            self.assertEqual(row["state"], "failed" if a > 0.9 else "done")
            out = 100 + 3 * a + b if a <= 0.9 else None
            self.assertEqual("no luck" in row["failure"], out is None)
            self.assertEqual(row["exit_velocity"], "" if out is None else str(out) if out >= 101 else "0.0")
            self.assertEqual(row["penetration_depth"], "0.1" if out is not None and out < 101 else "")
        failed = [int(row["sample"]) for row in rows if row["state"] == "failed"]
        self.assertGreater(len(failed), 0)
        self.assertEqual([one["sample"] for one in record["failed"]], failed)
        velocity, depth = record["answers"]["exit_velocity"], record["answers"]["penetration_depth"]
        self.assertEqual(velocity["count"], 25 - len(failed))
        self.assertEqual(velocity["values"].count(0), depth["count"])
        self.assertEqual(depth["count"] + depth["without"], 25 - len(failed))
        self.assertGreater(min(depth["count"], depth["without"]), 0)
        page = (self.out / "report" / "report.html").read_text()
        for words in (f"{len(failed)} of 25 samples failed", "no luck", "Uncertain inputs", "uniform 0 1 MPa"):
            self.assertIn(words, page)
        for figure in ("distribution", "contributions", "convergence"):
            self.assertTrue((self.out / "report" / f"out_exit_velocity_{figure}.svg").is_file())

    def test_more_samples_keep_the_runs_and_the_experiment_is_found(self):
        text = STUDY.replace("uniform 0 1 MPa", "uniform 0.4 0.9 MPa").replace(", penetration_depth", "")
        study = uncertainty.read(self.write(text))
        with mock.patch("uncertainty.subprocess.run", return_value=mock.Mock(returncode=0)):  # the report
            self.assertEqual(uncertainty.run(study, runs.Runs(study, self.folder / "build", self.out, workers.workers_of(2))), [])
        first = self.table()
        self.assertEqual(self.begun(), 26)
        done = self.study(text.replace("= 25", "= 30"))
        self.assertEqual((done.returncode, self.begun()), (0, 31), done.stderr)
        self.assertEqual(self.table()[:25], first)
        self.assertIn("the measured 224 m/s lies outside the band: 100 % of the samples are below it",
                      (self.out / "report" / "verdict.txt").read_text())
        record = json.loads((self.out / "uncertainty.json").read_text())["answers"]["exit_velocity"]
        self.assertEqual(record["as_it_is"], 0)  # 100 m/s stop
        low, high = record["numerical"]
        self.assertTrue(all(a + 2 == x == b - 4 for a, x, b in zip(low, record["values"], high)))
        self.assertGreater(record["contributions"]["shares"]["first"], 0.5)  # 2.25 of 3.25
        self.assertNotIn("layout", record["contributions"]["shares"])

    def test_inputs_that_the_program_refuses_are_refused_before_any_run(self):
        done = self.study(STUDY.replace("A/b=uniform 0 1", "A/b=uniform 0 6"))
        self.assertEqual((done.returncode, self.begun(), self.out.exists()), (2, 0, False))
        self.assertEqual(done.stderr, f"study: {self.folder}/study.prm:12: second: penetrate: key 'b': found '6', allowed: at most "
                                      "5\n")
        done = self.study(STUDY.replace("set Seed", "set Fixed = A/c=1 B/b=7\n set Seed").replace("A/b", "B/b"))
        self.assertIn(":13: second: found 'B/b', which Study/Fixed sets", done.stderr)

    def test_a_changed_table_of_an_alternative_is_seen(self):
        (self.folder / "weak.h5").write_text("1")
        path = self.write(STUDY.replace("choice weak", f"choice {self.folder}/weak.h5"))
        study = uncertainty.read(path)
        self.assertEqual(study.files, [self.folder / "weak.h5"])
        kept = runs.Runs(study, self.folder / "build", self.out).record
        kept.add("run", {})
        (self.folder / "weak.h5").write_text("2")
        with self.assertRaisesRegex(study_file.BadStudy, "other inputs"):
            runs.Runs(study, self.folder / "build", self.out, workers.workers_of(1))

    def test_files_of_alternatives_lie_beside_the_study(self):
        (self.folder / "weak.h5").write_text("1")
        study = uncertainty.read(self.write(STUDY.replace("choice weak", "choice weak.h5")))
        table = next(one for one in study.inputs if one.name == "table")
        self.assertEqual([values[0] for values in table.laws[0].values], [str(self.folder / "weak.h5"), "mean"])

    def test_bad_studies_name_file_line_and_what_is_allowed(self):
        self.assertIsNone(uncertainty.read(self.write(STUDY.replace("= uncertainty", "= tornado"))))
        for old, new, expected in [
                ("Samples", "Smaples", ":7: unknown key 'Smaples', allowed: Kind"), ("= 25", "= 0", ":7: Study/Samples: found '0'"),
                ("= 25", "= 2.5", ":7: Study/Samples: found '2.5', allowed: a whole number of 1"),
                ("= 3", "= -3", ":8: Study/Seed: found '-3', allowed"), ("  set Samples = 25\n", "", "'Study/Samples' must be set"),
                ("= penetrate", "= perforate", ":4: Study/Program: found 'perforate', allowed: microcell, penetrate"),
                ("case.prm", "none.prm", ":5: Study/Input: found no file"), ("case.prm", "x" * 300, ":5: Study/Input: found no file"),
                ("subsection Dist", "subsection Mist", "section 'Mist"),
                ("exit_velocity, penetration_depth", "", ":6: Study/Answers: found ''"),
                ("set Seed ", "set Fixed = x\n  set Seed", ":8: Study/Fixed: found 'x', allowed: Section/Key=value"),
                (STUDY[STUDY.index("subsection Dist"):], "", "needs a section Distributions"),
                ("A/b", "A/a", ":12: second: found 'A/a', which first sets"), ("A/a=", "a=", ":11: first: found 'a=uniform"),
                ("A/a=", "A/a + A/a=", "keys that differ"), ("A/a=uniform", "A/a uniform", ":11: first: found 'A/a uniform")]:
            with self.subTest(new), self.assertRaisesRegex(study_file.BadStudy, expected):
                self.assertIn(old, STUDY)
                uncertainty.read(self.write(STUDY.replace(old, new)))

    def test_bad_distributions_name_what_is_allowed(self):
        for bad, expected in [
                ("uniform 1 0 MPa", "uniform LOW HIGH"), ("uniform 1 1", "LOW < HIGH"), ("uniform 0 MPa", "uniform LOW HIGH"),
                ("uniform 0 1 2 MPa", "uniform LOW HIGH"), ("uniform 0 inf", "uniform LOW HIGH"),
                ("uniform 0 1 truncated 1 SD", "uniform"),
                ("uniform 0 1, uniform 0 2", "found 2 distributions between commas, allowed: 1"), ("gauss 0 1", "uniform, tri"),
                ("", "uniform, triangular"), ("triangular 0 2 1", "LOW <= MODE <= HIGH"), ("normal 0 1 MPa", "truncated NUMBER SD"),
                ("normal 0 0 MPa truncated 3 SD", "SD > 0"), ("normal 0 1 MPa truncated 2 1", "truncated LOW HIGH"),
                ("normal 0 1 truncated 0 SD", "truncated"), ("normal 0 1 truncated 90 99", "truncated"),
                ("lognormal 0 2 m", "MEDIAN > 0"), ("lognormal 1 1 m", "FACTOR > 1"), ("lognormal 1 2 truncated -1 3", "truncated"),
                ("integers 1 2.5", "integers LOW HIGH"), ("integers 3 3", "LOW < HIGH"), ("integers 1 3 m", "integers LOW HIGH"),
                ("choice a", "choice A | B"), ("choice a | ", "choice A | B"), ("choice a | b weight 0", "weights > 0"),
                ("choice a | b weight x", "weights > 0"), ("choice a | a", "alternatives that differ")]:
            with self.subTest(bad), self.assertRaisesRegex(ValueError, "allowed: .*" + expected.replace("|", r"\|") if
                                                           not expected.startswith("found") else expected):
                law(bad)
        with self.assertRaisesRegex(ValueError, "2 values between commas"):
            distributions.read("x", "A/a + B/b=choice 1, 2 | 3", 1)


if __name__ == "__main__":
    unittest.main()
