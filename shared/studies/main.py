"""Command line of shared/study."""

import argparse
import os
import pathlib
import sys

import chart
import curve
import limit
import scaling
import series as series_of_runs
import stability_map
import sweep
import tornado
import uncertainty
from runs import Runs
from study_file import BadStudy, read_series, read_study
from workers import RECORD, workers_of
from writing import Parser, Refused, own

BUILD = pathlib.Path(__file__).resolve().parents[2] / "build"

EXAMPLE = """a study file:

  subsection Study
    set Program   = microcell                  # or penetrate
    set Input     = ../microcells/case_a.prm   # relative to this file
    set Reference = Mesh/Degree=3 Mesh/Elements=10
    set Answers   = peak_stress, damage@2e-4   # keys of summary.json; COLUMN@STRAIN of curve.csv
    set Cost      = wall_seconds               # keys of summary.json, a chart for each
    set Fixed     = Output/Field states=0      # every run has these
    set Repeats   = 3                          # the fastest counts
    set Refined by = Mesh/Elements             # the largest error of a run and of its refinements counts
    set Default   = Mesh/Degree=3 Mesh/Elements=4
  end
  subsection Sweep
    set Mesh/Degree   = 1 | 2 | 3
    set Mesh/Elements = 2 | 4 | 8
  end

Each subsection `Sweep NAME` (any name) is a series of runs with every combination of its values. Keys that change
together are written `set A/B + C/D = 1, 2 | 3, 4`. Sections inside sections make longer keys (`slab/AFC/T_max`); a body
whose name has spaces cannot be named in a study. Instead of Reference, `set Exact = peak_stress 2.24e6, ...` gives values
that are known from elsewhere. Errors are differences from the reference run in percent of its answer (for damages in
percent of 1).

A stability map (Study/Kind = map) runs every row at every value of each sweep, with one axis per sweep, and says which
runs hold, are inexact, raise a warning, or fail:

  subsection Study
    set Kind      = map
    set Program   = penetrate
    set Input     = ../scenes/taylor_aluminium.prm
    set Reference = Integration/Scheme=NSNI bar/Rings=10 bar/Layers=62
    set Answers   = final_length_ratio 1 %, foot_diameter 5 %   # largest errors of a run that holds
    set Limits    = energy_balance_error 1e-3                   # keys of summary.json and what they may be
    set Physical  = bar/Velocity                                # swept keys that change the reference too
  end
  subsection Rows
    set NSNI = Integration/Scheme=NSNI
    set DNI  = Integration/Scheme=DNI
  end
  subsection Sweep time step
    set Time/Step factor = 0.5 | 1 | 1.5
  end

A tornado chart (Study/Kind = tornado) runs the input as it is (with Fixed), then with each constant at its other
values, one constant at a time, and draws the changes of the answers with the largest on top:

  subsection Study
    set Kind    = tornado
    set Program = penetrate
    set Input   = ../scenes/slab_127.prm
    set Answers = exit_velocity
  end
  subsection Constants
    set friction = Contact/Friction=0 | Contact/Friction=0.1
  end

`include OTHER.prm` before a subsection takes the lines of another study; a later line replaces an earlier one, also if
it comes from an include. A # begins a comment at the start of a line or after a blank; a value with such a # stands in
double quotes.

Uncertainty (Study/Kind = uncertainty) runs the input as it is, then with random values of all uncertain inputs at once: a
Latin hypercube, which keeps its samples when Samples is raised (25, 50, 100, 200, ... are complete ones). The report has the
band of each answer, what each input contributes, and how the band changes with the number of samples. samples.csv has
every run. Samples with 59 or more values bound both ends of the band. The same seed gives the same samples on any machine:

  subsection Study
    set Kind    = uncertainty
    set Program = penetrate
    set Input   = ../scenes/slab_127_axis.prm
    set Answers = exit_velocity
    set Fixed   = slab/Jitter=0.2
    set Samples = 100
    set Seed    = 1
  end
  subsection Distributions             # NAME = Section/Key=DISTRIBUTION
    set friction = Contact/Friction=uniform 0 0.1
    set strength = slab/AFC/T_max=normal 2.47 0.2 MPa truncated 2 SD   # or truncated LOW HIGH
    set energy   = slab/AFC/Shear damage reference length=lognormal 0.1 1.5 m
    set floor    = slab/AFC/Failure strain floor=triangular 0 0.01 0.03
    set table    = slab/AFC/Damage table=choice weak.h5 | mean.h5 weight 2 | strong.h5
    set two      = slab/AFC/C1 + slab/AFC/C2=uniform 500 502 MPa, uniform 474 478 MPa   # one draw for both
    set layout   = slab/Jitter seed=integers 1 1000
  end

A curve (Study/Kind = curve) runs the input at every value of one key and draws the answers against it with their numerical
bands, what tests in data/experiments have measured, and what the formulas of engineers say. An exit velocity over an impact
velocity is fitted: Recht-Ipson, Lambert-Jonas, and a line that falls to zero. Runs that failed or have no answer are drawn as such.
curve.csv has every run:

  subsection Study
    set Kind    = curve
    set Program = penetrate
    set Input   = ../scenes/slab_127_axis.prm
    set Answers = exit_velocity
    set Fits    = Recht-Ipson, Lambert-Jonas   # if not set all that apply
  end
  subsection Curve                     # one line; further keys that change with the first one: A/B + C/D = 1, 2 | 3, 4
    set projectile/Velocity = 150 | 200 | 313 m/s
  end

A limit (Study/Kind = limit) is the velocity that just perforates, or the thickness that is just perforated or scabbed, by
bisection. limit.csv has every run, limit.json the limit with the range that the numerical error leaves open, and the scatter
over layouts of the points. A section Distributions, with Samples and Spread, asks for the velocity or thickness that half of the
shots perforate (V50) when inputs are random, and for its slope:

  subsection Study
    set Kind      = limit
    set Program   = penetrate
    set Input     = ../scenes/slab_127_axis.prm
    set Key       = projectile/Velocity
    set Low       = 100 m/s            # the two must have different answers
    set High      = 313 m/s
    set Width     = 2 m/s              # of what is left between them at the end
    set Criterion = perforation        # or scabbing
    set Samples   = 100                # of the statistics, at random places
    set Spread    = 40 m/s             # about the limit, to both sides
    set Seed      = 1
  end
  subsection Models                    # cheaper ones, the cheapest first; a run counts if its numerical band decides
    set coarse = Run/Accuracy=25
  end
  subsection Layouts                   # each has a limit of its own
    set first = slab/Jitter=0.2 slab/Jitter seed=1
  end
  subsection Distributions             # as above
    set friction = Contact/Friction=uniform 0 0.1
  end

A series (Study/Kind = series) runs inputs as they are, each with its own results, and reports on all of them together.
A run may name another program, and a value `@NAME/FILE` is a file among the results of the earlier run NAME:

  subsection Study
    set Kind    = series
    set Program = penetrate
  end
  subsection Runs
    set slab_127 = ../scenes/slab_127.prm
    set no_friction = ../scenes/slab_127.prm Contact/Friction=0
    set cell = microcell ../microcells/wes5000.prm
    set own_table = ../scenes/slab_127.prm slab/AFC/Damage table=@cell/damage_table.h5
  end

Scaling (Study/Kind = scaling) measures the time of runs on one rank and two, counts messages and bytes on many ranks
(which may be more than there are cores), and reports both with a model of many more ranks. Lines are
RANKS = Section/Key=value ...:

  subsection Study
    set Kind    = scaling
    set Program = penetrate
    set Input   = ../scenes/slab_127.prm
    set Repeats = 3                    # of timed runs, the fastest counts
  end
  subsection Strong timed              # the same points on all ranks; Weak: as many points more as ranks
    set 1 | 2 = slab/Rings=30
  end
  subsection Strong counted
    set 1 | 8 | 64 = slab/Rings=20
  end
  subsection Model
    set Points    = 1e8
    set Ranks     = 1000 | 10000
    set Latency   = 2e-6               # s
    set Bandwidth = 1e9                # bytes/s of a rank
  end"""


# What a study leaves in its folder, besides those of its runs.
RESULTS = ("study.csv", "stability.csv", "tornado.csv", "scaling.json", "uncertainty.json", "samples.csv", curve.TABLE, curve.RECORD,
           limit.TABLE, limit.RECORD)
# Kinds that read, check and run themselves, on all cores.
OWN_KINDS = (uncertainty, curve, limit)


def main(arguments):
    parser = Parser(prog="study", description=__doc__, epilog=EXAMPLE,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", help="STUDY.prm")
    parser.add_argument("--output", metavar="DIR", help="default: out/study_NAME")
    parser.add_argument("--build", default=str(BUILD), metavar="DIR", help="where the programs were built (default: build/ beside shared/)")
    parser.add_argument("--jobs", type=jobs, metavar="N", help="runs at a time, one thread each; default: all cores, but 1 for a "
                        "chart of costs, whose runs disturb each other's times, and for scaling")
    parser.add_argument("--hosts", metavar="FILE", help="lines HOST [RUNS AT A TIME]: machines that ssh reaches without a "
                        "password and that see this folder under the same name; localhost is this one")
    parser.add_argument("--force", action="store_true", help="replaces the results of an earlier study in DIR; without it a "
                        "study of the same inputs keeps its runs that are finished and goes on with the others")
    options = parser.parse_args(arguments)
    source, build = pathlib.Path(options.study), pathlib.Path(options.build)
    output = pathlib.Path(options.output or f"out/study_{source.stem}")
    try:
        if study := scaling.read(source):
            with own(output, RESULTS, options.force):
                return told(scaling.run(study, build, output))
        if study := read_series(source):
            with own(output, RESULTS, options.force):
                return told(series_of_runs.run(study, build, output, workers_of(options.jobs or cores(), options.hosts),
                                               options.force))
        kind, study = own_kind(source)
        study = study or read_study(source)
        sweep.program_of(study, build)
        workers = workers_of(options.jobs or (1 if not kind and study.cases else cores()), options.hosts)
        if kind:
            kind.check(study, build, options.jobs or cores())
        with own(output, () if (output / RECORD).is_file() else RESULTS, options.force):
            runs = Runs(study, build, output, workers, options.force)
            if not kind:
                return run_study(study, runs, output)
            code = told(kind.run(study, runs))
            print(f"  results in {output} ({study.results})")
            return code
    except (BadStudy, sweep.ProgramMissing) as error:
        raise Refused(error) from error
    except sweep.RunFailed as error:
        print(f"study: {error}", file=sys.stderr)
        return 3


def own_kind(source):
    """Returns (module, study) of a study whose kind has a module of its own, or (None, None). @raises BadStudy"""
    for kind in OWN_KINDS:
        if study := kind.read(source):
            return kind, study
    return None, None


def jobs(text):
    if not text.isdigit() or not 1 <= int(text) <= 1024:
        raise argparse.ArgumentTypeError(f"found '{text}', allowed: 1 to 1024")
    return int(text)


def cores():
    return len(os.sched_getaffinity(0))


def told(failures):
    for failure in failures:
        print(f"  failed: {failure}")
    return 3 if failures else 0


def run_study(study, runs, output):
    """Runs a map, a tornado chart or an accuracy chart and returns the exit code."""
    if study.is_map:
        cells = stability_map.run(study, runs)
        stability_map.draw(study, cells, output)
        print(f"  results in {output} (stability.csv, map_*.png, map_*.svg)")
        return 0
    if study.constants:
        rows = tornado.run(study, runs)
        for answer in study.answers:
            tornado.draw(study, rows, answer, output)
        print(f"  results in {output} (tornado.csv, tornado_*.png, tornado_*.svg)")
        return 0
    rows, failures = sweep.run(study, runs)
    chart.add_lasting_errors(rows, study.answers)
    sweep.write_study(rows, failures, output)
    drawn = [*study.answers, *([chart.ALL] if len(study.answers) > 1 else [])]
    for answer in drawn if rows else []:
        for cost in study.costs:
            chart.draw(study, rows, answer, cost, output)
    code = told(failures)
    print(f"  {len(rows)} runs; results in {output} (study.csv, chart_*.png, chart_*.svg)")
    return code
