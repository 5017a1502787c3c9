"""Results: folders that are owned, restarts, checkpoints that are damaged, full disks, closed streams, signals."""

import fcntl
import os
import resource
import shutil
import signal
import time

import h5py
import numpy as np

from fixtures import BAR, BRITTLE_CELL, CELL, ENSEMBLE, MATERIAL, PATH, TINY_BAR, TINY_CELL, TINY_ENSEMBLE
from harness import Case
from sealed import check_seal, seal

START = {"penetrate": [BAR, *TINY_BAR], "microcell": [CELL, *TINY_CELL]}
FOLDER = {"penetrate": "bar", "microcell": "cell"}


def cases(fixtures):
    yield from folders(fixtures)
    yield from checkpoints(fixtures)
    yield from samples(fixtures)
    yield from disks()
    yield from streams()
    yield from signals()


def copied(fixtures, name, then=None):
    """Begins with the results of an earlier run in r."""
    def before(work):
        shutil.copytree(fixtures / name, work / "r")
        held = then(work / "r") if then else None
        return held if isinstance(held, Lock) else None
    return before


class Lock:
    """A folder that another run owns."""

    def __init__(self, folder):
        self.handle = os.open(folder, os.O_RDONLY)
        fcntl.flock(self.handle, fcntl.LOCK_EX)

    def close(self):
        os.close(self.handle)


def lock(folder):
    return Lock(folder)  # the harness keeps it until the command has ended


def linked(name, target="/dev/null"):
    def change(folder):
        if (folder / name).is_dir():
            (folder / name).rename(folder / "elsewhere")
        else:
            (folder / name).unlink(missing_ok=True)
        (folder / name).symlink_to(target)
    return change


def folders(fixtures):
    for program, words in START.items():
        there, to = FOLDER[program], ["--output", "r"]

        def case(name, more, says, then=None, folder=there, **others):
            return Case("folders of results", name, program, [*words, *more], says=says,
                        before=copied(fixtures, folder, then), **others)

        yield case("results are there", to, ["r", "--force"])
        yield case("results of another program are there", to, ["r", "--force"],
                   folder="cell" if program == "penetrate" else "bar")
        yield case("another run owns the folder", to, ["belongs to another run"], lock)
        yield case("another run owns the folder, --force", [*to, "--force"], ["belongs to another run"], lock)
        yield case("another run owns the folder, --restart", [*to, "--restart"], ["belongs to another run"], lock)
        for result in ("summary.json", "resolved.prm"):
            yield case(f"{result} is a link, --force", [*to, "--force"], [result, "link"], linked(result))
            yield case(f"{result} is a link to nothing, --force", [*to, "--force"], [result, "link"], linked(result, "nowhere"))
        yield case("a finished run, --restart", [*to, "--restart"], [], code=0)
        yield case("--force", [*to, "--force"], [], code=0)
        yield case("an input that is a result, --force", [*to, "--force", "--output=r"], ["twice"])
        yield Case("folders of results", "--restart without a folder", program, [*words, *to, "--restart"], says=["does not exist"])
        yield Case("folders of results", "--restart in an empty folder", program, [*words, *to, "--restart"], says=["--restart"],
                   before=lambda work: (work / "r").mkdir())
        yield Case("folders of results", "its own resolved.prm as input, --force", program, ["r/resolved.prm", *to, "--force"],
                   says=["resolved.prm", "--force"], before=copied(fixtures, there))
        yield Case("folders of results", "a link to its own resolved.prm as input, --force", program, ["in.prm", *to, "--force"],
                   says=["in.prm", "--force"],
                   before=copied(fixtures, there, lambda folder: (folder.parent / "in.prm").symlink_to("r/resolved.prm")))
        yield case("temporary files of a killed run, --force", [*to, "--force"], [], code=0,
                   then=lambda folder: (folder / ".spall-0123456789abcdef.part").write_text("x"),
                   after=lambda work: "temporary file is still there" if list((work / "r").glob(".spall-*")) else "")
        yield case("the scene has another input, --restart", [*to, "--restart", *changed_input(program)], ["--restart"])
    yield Case("folders of results", "craters of a slab in the folder of a bar, --force", "penetrate",
               [*START["penetrate"], "--output", "r", "--force"], code=0,
               before=copied(fixtures, "bar", lambda folder: (folder / "craters.csv").write_text("of a slab")),
               after=lambda work: "craters.csv is still there" if (work / "r" / "craters.csv").exists() else "")
    yield Case("folders of results", "a cell that fails leaves no table of another one", "microcell",
               [CELL, *BRITTLE_CELL, "--output", "r", "--force", "Loading/Snap-back=refuse"], code=3,
               before=copied(fixtures, "cell"),
               after=lambda work: "the old table is still there" if (work / "r" / "damage_table.h5").exists() else "")
    for name in ("history.csv", "fields", "fields.h5", "checkpoint.h5"):
        for option in ("--force", "--restart"):
            yield Case("folders of results", f"{name} is a link, {option}", "penetrate",
                       [*START["penetrate"], "--output", "r", option], says=[name, "link"],
                       before=copied(fixtures, "bar", linked(name, "elsewhere")))
    for name, words, says in (
            ("over its path", [MATERIAL, "a.csv", "--output", "a.csv", "--force"], ["a.csv"]),
            ("over its path by a link", [MATERIAL, "a.csv", "--output", "b.csv", "--force"], ["link"]),
            ("over its path by another name", [MATERIAL, "./a.csv", "--output", "{here}/a.csv", "--force"], ["a.csv"]),
            ("a file is there", [MATERIAL, PATH, "--output", "a.csv"], ["--force"]),
            ("a link is there", [MATERIAL, PATH, "--output", "b.csv", "--force"], ["link"]),
            ("a folder is there", [MATERIAL, PATH, "--output", "{here}", "--force"], [])):
        yield Case("folders of results", f"material_point: {name}", "material_point", words, says=says, before=path_and_link)


def changed_input(program):
    return ["bar/J2/Yield stress=300 MPa"] if program == "penetrate" else ["Cell/Initial crack=0.3"]


def path_and_link(work):
    shutil.copyfile(PATH.replace("{data}", str(__import__("harness").ROOT / "data")), work / "a.csv")
    (work / "b.csv").symlink_to("a.csv")


def checkpoints(fixtures):
    words = [BAR, *TINY_BAR, "Time/End time=1.1 us", "--output", "r", "--restart"]
    words.remove("Time/End time=1 us")

    def case(name, then, says=(), **more):
        return Case("checkpoints", name, "penetrate", words, says=["checkpoint", *says], before=copied(fixtures, "bar", then), **more)

    def with_bytes(change):
        def then(folder):
            path = folder / "checkpoint.h5"
            path.write_bytes(change(path.read_bytes()))
        return then

    def with_hdf5(change):
        def then(folder):
            with h5py.File(folder / "checkpoint.h5", "r+") as file:
                change(file)
            seal(folder / "checkpoint.h5")
        return then

    yield Case("checkpoints", "a whole one", "penetrate", words, code=0, before=copied(fixtures, "bar"))
    for share in (0, 0.01, 0.5, 0.99):
        yield case(f"cut to {share:.0%}", with_bytes(lambda data, share=share: data[:int(share * len(data))]))
    for k in range(24):
        yield case(f"a byte in part {k} of 24 is another one", with_bytes(lambda data, k=k: flip(data, (2 * k + 1) * len(data) // 48)))
    yield case("a text", with_bytes(lambda data: b"no checkpoint\n" * 1000))
    yield case("missing", lambda folder: (folder / "checkpoint.h5").unlink(), ["no checkpoint"])
    yield case("a pipe", lambda folder: ((folder / "checkpoint.h5").unlink(), os.mkfifo(folder / "checkpoint.h5")))
    yield case("a folder", lambda folder: ((folder / "checkpoint.h5").unlink(), (folder / "checkpoint.h5").mkdir()))
    yield case("a damage table", lambda folder: shutil.copyfile(fixtures / "cell" / "damage_table.h5", folder / "checkpoint.h5"))
    for name, change in (
            ("another format", lambda file: file.attrs.modify("format_version", 99)),
            ("format a list", lambda file: file.attrs.create("format_version", [8] * 1000)),
            ("no lists", lambda file: file.__delitem__("lists")),
            ("no common state", lambda file: file.__delitem__("lists/common")),
            ("negative ends", lambda file: rewrite(file, "ends", lambda ends: -ends - 1)),
            ("ends beyond the file", lambda file: rewrite(file, "ends", lambda ends: ends + (1 << 60))),
            ("ends that are too early", lambda file: rewrite(file, "ends", lambda ends: ends - 1)),
            ("ends that fall", lambda file: rewrite(file, "ends", lambda ends: np.concatenate([ends, ends[:1] - 1]))),
            ("no ends", lambda file: rewrite(file, "ends", lambda ends: ends[:0])),
            ("no checksums", lambda file: rewrite(file, "checksums", lambda sums: sums[:0])),
            ("other checksums", lambda file: rewrite(file, "checksums", lambda sums: sums + 1)),
            ("input a list", lambda file: file.attrs.create("input", np.array([b"x"] * 100)))):
        yield case(f"sealed: {name}", with_hdf5(change))
    yield Case("checkpoints", "the newest is damaged, the one before is whole", "penetrate", words, code=0, says=["refused"],
               before=copied(fixtures, "bar", newest_damaged))
    yield Case("checkpoints", "the damage table has changed", "penetrate",
               ["{data}/scenes/slab_127.prm", "--restart", "--output", "r", "slab/AFC/Damage table=t.h5", *SLAB_WORDS],
               says=["t.h5"], before=lambda work: table_changed(fixtures, work))


SLAB_WORDS = ["slab/Diameter=0.3 m", "slab/Rings=8", "slab/Layers=4", "Time/End time=10 us", "Run/Threads=1"]


def table_changed(fixtures, work):
    shutil.copytree(fixtures / "slab", work / "r")
    shutil.copyfile(fixtures / "t.h5", work / "t.h5")
    # The checkpoint names the table by its whole path.
    with h5py.File(work / "r" / "checkpoint.h5", "r+") as file:
        for name in ("input", "files"):
            text = file.attrs[name]
            text = text if isinstance(text, bytes) else text.encode()
            text = text.replace(str(fixtures / "t.h5").encode(), str(work / "t.h5").encode())
            del file.attrs[name]
            file.attrs[name] = np.bytes_(text)
    seal(work / "r" / "checkpoint.h5")
    with h5py.File(work / "t.h5", "r+") as file:
        file.attrs["remark"] = "changed"
    seal(work / "t.h5")


def rewrite(file, name, change):
    for group in file["lists"].values():
        values = change(np.array(group[name]))
        del group[name]
        group.create_dataset(name, data=values)


def flip(data, place):
    return data[:place] + bytes([data[place] ^ 0x10]) + data[place + 1:]


def newest_damaged(folder):
    shutil.copyfile(folder / "checkpoint.h5", folder / "checkpoint_previous.h5")
    data = (folder / "checkpoint.h5").read_bytes()
    (folder / "checkpoint.h5").write_bytes(flip(data, len(data) // 2))


def samples(fixtures):
    words = [ENSEMBLE, *TINY_ENSEMBLE, "--output", "r", "--restart"]

    def damage(folder):
        path = folder / "samples" / "sample_000001.h5"
        path.write_bytes(flip(path.read_bytes(), path.stat().st_size // 2))

    def is_whole(work):
        check_seal(work / "r" / "samples" / "sample_000001.h5")
        return "" if '"samples_failed": 0' in (work / "r" / "summary.json").read_text() else "a sample has failed"

    yield Case("ensembles", "a damaged sample is computed again", "microcell", words, code=0,
               before=copied(fixtures, "ensemble", damage), after=is_whole)
    yield Case("ensembles", "a sample of no bytes is computed again", "microcell", words, code=0, after=is_whole,
               before=copied(fixtures, "ensemble", lambda folder: (folder / "samples" / "sample_000001.h5").write_bytes(b"")))
    yield Case("ensembles", "another input", "microcell", [*words, "Cell/Initial crack=0.2"], says=["--restart"],
               before=copied(fixtures, "ensemble"))
    yield Case("ensembles", "a sample is a link", "microcell", words, code=0, after=is_whole,
               before=copied(fixtures, "ensemble", lambda folder: linked("sample_000001.h5")(folder / "samples")))


def disks():
    """Files that cannot be larger than so many bytes, as if the disk were full at that moment."""
    for size in (0, 100, 1000, 4096, 10000, 30000, 60000, 100000, 200000, 400000, 800000):
        for program, words in START.items():
            yield Case("full disks", f"{size} bytes", program, [*words, "--output", "r"], code=(0, 3),
                       limits={resource.RLIMIT_FSIZE: size}, after=whole_results)
        yield Case("full disks", f"{size} bytes, ensemble", "microcell", [ENSEMBLE, *TINY_ENSEMBLE, "--output", "r"], code=(0, 3),
                   limits={resource.RLIMIT_FSIZE: size}, after=whole_results)
        yield Case("full disks", f"{size} bytes", "material_point", [MATERIAL, PATH, "--output", "a.csv"], code=(0, 3),
                   limits={resource.RLIMIT_FSIZE: size}, after=whole_results)


def whole_results(work):
    """Whatever is there is whole."""
    for path in work.rglob("*"):
        if path.name.startswith(".spall-"):
            return f"{path.name} is left"
        if path.suffix == ".h5":
            check_seal(path)
        if path.name == "summary.json":
            __import__("json").loads(path.read_text())
        if path.name == "history.csv" and path.stat().st_size and not path.read_text().endswith("\n"):
            return "history.csv ends with half a row"
    return ""


def streams():
    programs = {**START, "material_point": [MATERIAL, PATH]}
    for program, words in programs.items():
        to = ["--output", "r/a.csv" if program == "material_point" else "r"]
        for name, closed in (("input", (0,)), ("output", (1,)), ("errors", (2,)), ("all", (0, 1, 2))):
            yield Case("streams", f"closed: {name}", program, [*words, *to], code=0, streams=dict.fromkeys(closed, "closed"),
                       after=no_words_in_results)
        silent = program == "material_point"  # its rows go into the file, and it says nothing
        yield Case("streams", "full output", program, [*words, *to], code=0 if silent else 3,
                   says=[] if silent else ["standard output"], streams={1: "/dev/full"})
        for option in ("--help", "--version"):
            yield Case("streams", f"{option} into a full output", program, [option], code=3, streams={1: "/dev/full"})
        yield Case("streams", "full errors", program, ["none.prm", *words[1:2]], streams={2: "/dev/full"})
    yield Case("streams", "rows into a closed output", "material_point", [MATERIAL, PATH], says=["--output"], streams={1: "closed"})
    yield Case("streams", "rows into a full output", "material_point", [MATERIAL, PATH], code=3, streams={1: "/dev/full"})


def no_words_in_results(work):
    for path in work.rglob("*"):
        if path.is_file() and path.suffix in (".csv", ".prm", ".json") and b"results in" in path.read_bytes():
            return f"words are in {path.name}"
    return ""


LONG_BAR = [BAR, "bar/Rings=8", "bar/Layers=50", "Output/History interval=0.01 us", "Run/Threads=1", "--output", "r"]


def after_a_row(number):
    """Sends a signal when history.csv has rows."""
    def send(process, work):
        path = work / "r" / "history.csv"
        for _ in range(2000):
            if path.is_file() and path.read_bytes().count(b"\n") > 5:
                break
            time.sleep(0.01)
        process.send_signal(number)
    return send


def after_seconds(number, seconds):
    def send(process, _):
        time.sleep(seconds)
        process.send_signal(number)
    return send


def signals():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        yield Case("signals", f"penetrate: {number.name}", "penetrate", LONG_BAR, code=130, says=["interrupted", "--restart"],
                   signal=after_a_row(number), after=lambda work: "" if (work / "r" / "checkpoint.h5").is_file() else "no checkpoint")
        yield Case("signals", f"microcell: {number.name}", "microcell",
                   ["{data}/microcells/ensemble.prm", "Ensemble/Samples=2000", "Ensemble/Threads=1", "--output", "r"], code=130,
                   signal=after_seconds(number, 1.5), after=whole_results)
        yield Case("signals", f"material_point: {number.name}", "material_point",
                   [MATERIAL, "long.csv", "Path/Substeps=1000", "--output", "a.csv"], code=130, says=["interrupted"],
                   before=long_path, signal=after_seconds(number, 1.0),
                   after=lambda work: "" if (work / "a.csv").read_text().count("\n") > 10 else "no rows")


def long_path(work):
    rows = "".join(f"{i},{1e-6 * i:.6g},0,0,0,0,0\n" for i in range(100000))
    (work / "long.csv").write_text("time,exx,eyy,ezz,exy,eyz,exz\n" + rows)
