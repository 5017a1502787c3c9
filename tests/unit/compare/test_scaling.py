"""The model of many ranks, on runs that obey it exactly."""

import json
import pathlib
import sys

import synthetic

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "shared" / "compare"))

import matplotlib  # noqa: E402

import compare  # noqa: E402
import scaling_model  # noqa: E402
from references import EXPERIMENTS, References  # noqa: E402

matplotlib.rcParams.update({"savefig.dpi": 30, "figure.constrained_layout.use": False})

A, B, DEPTH, STEPS = 4e-7, 1e-8, 1.5, 20
ASSUMPTIONS = {"points": 1e8, "ranks": [1000.0, 10000.0], "latency": 2e-6, "bandwidth": 1e9}


def summary(points, ranks, imbalance=1.0):
    share = points / ranks
    copies = (share ** (1 / 3) + 2 * DEPTH) ** 3 - share if ranks > 1 else 0
    busy = (A * share + B * copies) * STEPS
    sent = 48 * copies
    return {"points": points, "ranks": ranks, "steps": STEPS, "wall_seconds": 1.25 * busy, "compute_seconds_max": busy * imbalance,
            "compute_seconds_mean": busy, "owned_points_max": share, "ghost_points_max": copies,
            "bytes_per_step_max": sent, "bytes_per_step_mean": 0.8 * sent, "messages_per_step_max": 12.0,
            "messages_per_step_mean": 10.0, "bytes_per_step_velocities": sent / 2, "bytes_per_step_forces": sent / 2,
            "bytes_per_step_refreshes": 10.0, "messages_per_step_refreshes": 3.0, "collectives_per_step_reductions": 1.0,
            "collectives_per_step_refreshes": 0.5, "gathered_bytes_per_step_refreshes": 20.0}


def run(series, timed, points, ranks, **more):
    return {"series": series, "timed": timed, "ranks": ranks, "summary": summary(points, ranks, **more)}


def runs():
    return [run("strong", True, 40000, 1), run("strong", True, 40000, 2), run("weak", True, 40000, 1),
            run("weak", True, 80000, 2)] + [run("strong", False, 64000, 8, imbalance=1.2)] + [run("strong", False, 64000, p) for p in (1, 27, 64)] + [
            run("weak", False, 1000 * p, p, imbalance=1.1) for p in (1, 27, 64)]


class Model(synthetic.InFolder):
    def test_coefficients_are_those_of_the_runs(self):
        c = scaling_model.coefficients(runs())
        self.assertAlmostEqual(c.point_seconds / A, 1)
        self.assertAlmostEqual(c.depth, DEPTH)
        self.assertAlmostEqual(c.surface_error, 0)
        self.assertAlmostEqual(c.copy_seconds / B, 1)
        self.assertAlmostEqual(c.imbalance, 1.2)
        self.assertEqual((c.messages, c.reductions, c.gathered), (15, 1.5, 20))

    def test_a_step_is_the_sum_of_its_parts(self):
        c = scaling_model.coefficients(runs())
        parts = scaling_model.step(c, ASSUMPTIONS, 1000)
        self.assertAlmostEqual(parts["compute"], 1e5 * A)
        self.assertAlmostEqual(parts["imbalance"], 2e4 * A)
        self.assertAlmostEqual(parts["latency"], (15 + 1.5 * 9.965784284662087) * 2e-6)
        self.assertAlmostEqual(parts["gathering"], 2e-5)
        self.assertAlmostEqual(scaling_model.efficiency(parts), parts["compute"] / sum(parts.values()))
        c.depth = 1e-6  # thin: an eighth of the points has a quarter of the surface
        thin = [scaling_model.step(c, ASSUMPTIONS, ranks)["surface"] for ranks in (1000, 8000)]
        self.assertAlmostEqual(thin[0] / thin[1], 4, places=4)
        self.assertAlmostEqual(thin[0] / (48 * 6e-6 * 1e5 ** (2 / 3) / 1e9), 1, places=4)

    def test_two_ranks_do_twice_the_work_of_one(self):
        for series in ("strong", "weak"):
            speed_up = scaling_model.speed_up(runs(), series)
            self.assertAlmostEqual(speed_up["wall"], speed_up["processor"])
            self.assertAlmostEqual(speed_up["wall"], 2, delta=0.1)  # but for the copies
        self.assertIsNone(scaling_model.speed_up(runs()[:1], "strong"))

    def test_runs_on_few_ranks_make_no_model(self):
        with self.assertRaisesRegex(ValueError, "27 or more"):
            scaling_model.coefficients([one for one in runs() if one["ranks"] < 27])

    def report(self, record):
        (self.folder / "study").mkdir(exist_ok=True)
        (self.folder / "study" / "scaling.json").write_text(json.dumps(record))
        (self.folder / "report").mkdir(exist_ok=True)
        page = compare.compare(*compare.read_all([self.folder / "study"]), self.folder / "report", References.read(EXPERIMENTS),
                               "")
        return page.read_text(encoding="utf-8")

    def test_report_shows_runs_model_and_assumptions(self):
        page = self.report({"runs": runs(), "assumptions": ASSUMPTIONS})
        for expected in ("Two ranks against one, strong: 1.9", "latency 2 us, bandwidth 1 GB/s", "1e+08 points",
                         "400 ns", "10,000"):
            self.assertTrue(expected in page, expected)
        self.assertEqual({path.stem for path in (self.folder / "report").glob("*.svg")},
                         {"study_strong", "study_weak", "study_model"})

    def test_report_says_why_there_is_no_model(self):
        page = self.report({"runs": runs()[:2], "assumptions": ASSUMPTIONS})
        self.assertIn("Missing: the model: a model needs", page)


if __name__ == "__main__":
    synthetic.unittest.main()
