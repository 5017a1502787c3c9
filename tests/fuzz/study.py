"""Mutates the studies of the corpus and of data/studies for some seconds: each is read or refused, and nothing else.

Arguments: seconds, folder for the inputs that fail."""

import pathlib
import random
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "shared" / "studies"))
sys.dont_write_bytecode = True

import scaling  # noqa: E402
import study_file  # noqa: E402
import uncertainty  # noqa: E402
from study_file import BadStudy  # noqa: E402

WORDS = (b"include ", b"subsection ", b"set ", b"end\n", b" = ", b" | ", b", ", b"nan", b"1e999", b"-1", b"../", b"@", b"\0", b"\xff",
         b"\"", b"#", b"Study", b"Runs", b"Sweep", b"Rows", b"Constants", b"series", b"map", b"scaling", b"uncertainty", b"tornado", b"%")


def mutated(random_, seeds):
    """Returns a seed with a few parts cut out, doubled, swapped or replaced."""
    data = bytearray(random_.choice(seeds))
    for _ in range(random_.randint(1, 8)):
        place, end = sorted(random_.randint(0, len(data)) for _ in range(2))
        end = min(end, place + random_.choice((1, 3, 10, 100)))
        choice = random_.randint(0, 4)
        if choice == 0:
            del data[place:end]
        elif choice == 1:
            data[place:place] = data[place:end]
        elif choice == 2 and data:
            data[min(place, len(data) - 1)] = random_.randint(0, 255)
        elif choice == 3:
            data[place:place] = random_.choice(WORDS)
        else:
            other = random_.choice(seeds)
            data[place:end] = other[place:end]
    return bytes(data)


def read(path):
    try:
        _ = scaling.read(path) or study_file.read_series(path) or uncertainty.read(path) or study_file.read_study(path)
    except BadStudy:  # the contract
        pass


def main(seconds, folder):
    random_, begin, calls, failures = random.Random(1), time.monotonic(), 0, []
    seeds = [path.read_bytes() for path in sorted((ROOT / "data" / "studies").glob("*.prm"))]
    with tempfile.TemporaryDirectory() as scratch:
        for name in ("scenes", "microcells", "tables"):  # what studies name beside them
            (pathlib.Path(scratch) / name).symlink_to(ROOT / "data" / name)
        path = pathlib.Path(scratch) / "studies" / "study.prm"
        path.parent.mkdir()
        while time.monotonic() - begin < seconds and len(failures) < 10:
            data = mutated(random_, seeds)
            path.write_bytes(data)
            try:
                read(path)
            except Exception as error:  # whatever it is, the study was to be refused
                failures.append(error)
                (pathlib.Path(folder) / f"failed_{len(failures)}.prm").write_bytes(data)
                print(f"{type(error).__name__}: {error}")
            calls += 1
    print(f"stat::number_of_executed_units: {calls}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]), sys.argv[2]))
