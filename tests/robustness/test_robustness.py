"""The catalogue of hostile and unlucky inputs: every case ends as the contract says. Prints the counts by kind.

Arguments: the build folder [words that the names of the cases to run contain]."""

import collections
import os
import pathlib
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import catalogue  # noqa: E402
from fixtures import make_fixtures  # noqa: E402
from harness import Runner  # noqa: E402


def main(build, wanted):
    with tempfile.TemporaryDirectory(prefix="spall_robustness_") as scratch:
        scratch = pathlib.Path(scratch)
        fixtures = make_fixtures(build, scratch)
        runner = Runner(build, scratch, fixtures)
        cases = [case for case in catalogue.cases(fixtures) if all(word in f"{case.kind}: {case.name}" for word in wanted)]
        tried, kept, begin = collections.Counter(), collections.Counter(), time.monotonic()
        with ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            for case, wrong in zip(cases, pool.map(runner.run, cases)):
                tried[case.kind] += 1
                kept[case.kind] += not wrong
                for text in wrong:
                    print(f"{case.kind}: {case.name} ({case.program}): {text}", flush=True)
        runner.close()
    print(f"{'kind':34} tried  as contracted")
    for kind in tried:
        print(f"{kind:34} {tried[kind]:5}  {kept[kind]:5}")
    print(f"{'all':34} {sum(tried.values()):5}  {sum(kept.values()):5}")
    print(f"{time.monotonic() - begin:.0f} s")
    return 0 if tried == kept and tried else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2:]))
