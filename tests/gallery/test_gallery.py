"""The scenes of data/gallery on few points: test_gallery.py BUILD NAME ...

Every scene is short, runs, conserves energy and momentum, and has the answer that the gallery is about."""

import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
GALLERY = ROOT / "data" / "gallery"
sys.path.insert(0, str(ROOT / "shared" / "studies"))

import study_file  # noqa: E402

LONGEST = 25             # lines of a scene
ENERGY, MOMENTUM = 1e-2, 1e-6  # largest errors, of the energy and the momentum at the start
# What a scene shows, as a sentence and a test of its summary.
SHOWN = {
    "slab": ("it is perforated", lambda s: 0 < s["exit_velocity"] < 313),
    "bar": ("the bar becomes shorter, its foot wider", lambda s: s["final_length_ratio"] < 0.8 and s["foot_diameter"] > 9e-3),
    "spaced_slabs": ("both are perforated, the second one later and by a slower projectile", lambda s: s["slab_perforated"] and
                     s["second_slab_perforated"] and s["slab_perforated_at"] < s["second_slab_perforated_at"] and
                     s["projectile_second_slab_exit_velocity"] < s["exit_velocity"]),
    "sphere_spall": ("the sphere stays in the slab, with a crater in front", lambda s: not s["perforated"] and
                     s["front_crater_diameter"] > 0.0206),
    "depth": ("the projectile stays in the block", lambda s: s["outcome"] == "stopped" and 0.05 < s["penetration_depth"] < 0.25),
    "nose_flat": ("it is perforated", lambda s: 0 < s["exit_velocity"] < 313),
    "nose_cone": ("it is perforated", lambda s: 0 < s["exit_velocity"] < 313),
    "nose_hemisphere": ("it is perforated", lambda s: 0 < s["exit_velocity"] < 313),
    "ricochet": ("the projectile glances off", lambda s: s["outcome"] == "rebounded" and s["rebound_velocity"] > 0),
    "steel_plate": ("what leaves the plate has the mass of a plug, 30 g", lambda s: s["perforated"] and 0.015 < s["debris_mass"] < 0.045),
    "double_hit": ("both go through", lambda s: s["slab_perforated_by"] == "projectile, second"),
    "culvert": ("it is perforated", lambda s: 0 < s["exit_velocity"] < 313),
    "reinforced_slab": ("bars break, and it is perforated", lambda s: 0 < s["exit_velocity"] < 313 and s["bar_segments_ruptured"] > 0),
    "soil": ("the soil slows it further", lambda s: 0 < s["projectile_soil_exit_velocity"] < s["exit_velocity"] < 313),
    "surface": ("it is perforated", lambda s: 0 < s["exit_velocity"] < 500),
    "fragments": ("both go through, the oblique one more slowly", lambda s: 0 < s["fragments_9_slab_exit_velocity"] < s["exit_velocity"] < 900)}
# Studies: lines behind the one of the gallery that make it coarse, the file of the result, and what it shows.
STUDIES = {
    "curve": ("subsection Study\n set Fixed = slab/Fine spacing=16 mm Output/Frame interval=20 ms\nend\n"
              "subsection Curve\n set projectile/Velocity = 250 | 313 | 400 | 500 m/s\nend\n", "curve.json",
              ("a fit and the test are beside it", lambda s: len(s["answers"]["exit_velocity"]["fits"]) >= 2 and
               s["answers"]["exit_velocity"]["measured"] == [[313.0, 224.0, None]])),
    "limit": ("subsection Study\n set Fixed = slab/Fine spacing=16 mm slab/Coarse spacing=30 mm slab/Jitter=0.1 Output/Frame interval=20 ms Time/End time=30 ms\n"
              " set Width = 20 m/s\nend\nsubsection Models\n set coarse = slab/Fine spacing=20 mm\nend\n", "limit.json",
              ("the limit has a band", lambda s: 60 < s["limit"] < 200 and s["band"][0] <= s["limit"] <= s["band"][1]))}


def run(words):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if done.returncode:
        raise AssertionError(f"exit code {done.returncode}: {done.stderr.strip()[-2000:]}")


def check_scene(name, build, output):
    text = (GALLERY / f"{name}.prm").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= LONGEST, f"more than {LONGEST} lines"
    one = study_file.read_series(GALLERY / "coarse.prm").runs[name]
    run([build / "macro" / "penetrate", one.input, "--output", output, *(f"{key}={value}" for key, value in one.overrides.items())])
    summary = json.loads((output / "summary.json").read_text(encoding="utf-8"))
    assert summary["energy_balance_error"] < ENERGY, summary["energy_balance_error"]
    assert summary["momentum_balance_error"] < MOMENTUM, summary["momentum_balance_error"]
    words, shown = SHOWN[name]
    assert shown(summary), f"not shown: {words}: {({key: summary.get(key) for key in ('outcome', 'exit_velocity', 'ended')})}"


def check_study(name, build, output):
    more, file, (words, shown) = STUDIES[name]
    study = output.parent / f"{name}.prm"
    scene = ROOT / "data" / "scenes" / "slab_127_axis.prm"  # the input of a study is relative to the file that is run
    study.write_text(f"include {GALLERY / name}.prm\n{more}subsection Study\n set Input = {scene}\nend\n", encoding="utf-8")
    run([ROOT / "shared" / "study", study, "--build", build, "--output", output])
    assert shown(json.loads((output / file).read_text(encoding="utf-8"))), f"not shown: {words}"


def main(build, names):
    assert set(SHOWN) == set(study_file.read_series(GALLERY / "gallery.prm").runs), "a scene of gallery.prm has no test"
    failures = 0
    for name in names:
        with tempfile.TemporaryDirectory() as folder:
            try:
                (check_scene if name in SHOWN else check_study)(name, build, pathlib.Path(folder) / name)
                print(f"{name}: ok", flush=True)
            except AssertionError as error:
                failures += 1
                print(f"{name}: {error}", flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]), sys.argv[2:]))
