"""The shipped studies can be read, and the cheap end of the accuracy chart of the slab is where it should be.

Argument: the build folder."""

import pathlib
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "shared" / "studies"))
sys.dont_write_bytecode = True

import main  # noqa: E402
import runs  # noqa: E402
import scaling  # noqa: E402
import study_file  # noqa: E402
import sweep  # noqa: E402
import uncertainty  # noqa: E402

BUILD = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else ROOT / "build"
STUDIES = ROOT / "data" / "studies"


class Shipped(unittest.TestCase):
    def test_every_study_can_be_read_and_is_listed(self):
        listed = (STUDIES / "README.md").read_text(encoding="utf-8")
        for path in STUDIES.glob("*.prm"):
            self.assertTrue(scaling.read(path) or study_file.read_series(path) or any(kind.read(path) for kind in main.OWN_KINDS) or
                            study_file.read_study(path), path)
            self.assertTrue(f"`{path.name}`" in listed, f"{path.name} is not in README.md")

    def test_the_program_takes_every_study_of_uncertainty(self):
        """At both ends of every input, and with every alternative, such as a damage table of another concrete."""
        found = [study for path in sorted(STUDIES.glob("*.prm")) for study in [uncertainty.read(path)] if study]
        self.assertGreater(len(found), 4)
        for study in found:
            uncertainty.check(study, BUILD, 2)

    def test_a_default_is_among_the_runs_of_its_chart(self):
        for path in STUDIES.glob("*_accuracy*.prm"):
            study = study_file.read_study(path)
            self.assertEqual(sum(sweep.is_default(study, case) for case in study.cases), 1, path)

    def test_the_coarsest_slabs_around_the_axis_are_near_the_converged_one(self):
        """16 mm: 1.6 points over the projectile's radius; sub-points are within 3 % there, NSNI within 10 %."""
        largest = {"axis, sub-points": 3, "axis, NSNI 1": 10}
        study = study_file.read_study(STUDIES / "slab_accuracy.prm")
        study.cases = [case for case in study.cases if case.series in largest
                       and case.overrides["slab/Rings"] == "31"]
        self.assertEqual(len(study.cases), 2)
        with tempfile.TemporaryDirectory() as folder:
            rows, failures = sweep.run(study, runs.Runs(study, BUILD, pathlib.Path(folder)))
        self.assertEqual(failures, [])
        for row in rows:
            self.assertLess(row["error exit_velocity"], largest[row["series"]], row["label"])
            self.assertGreater(row["cost model_memory_bytes"], 0)


if __name__ == "__main__":
    unittest.main()
