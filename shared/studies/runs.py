"""The runs of a study: those that the record has are taken from it, the others are computed side by side."""

import os

import sweep
from workers import HERE, Pool, Progress, Record, Worker, digest_of

# One thread per run where several run at once, unless the study sets it.
ONE_THREAD = {"penetrate": {"Run/Threads": "1"}}


def one_thread(program, settings, pool):
    """Returns the words that give a run one thread, if several run at once and the study does not say how many it has."""
    added = ONE_THREAD.get(program, {}) if pool.count > 1 else {}
    return [f"{key}={value}" for key, value in added.items() if key not in settings]


class Runs:
    """Runs of one program on one input."""

    def __init__(self, study, build, output, workers=None, force=False):
        """@raises ProgramMissing, BadStudy if the folder holds runs of another program or other inputs"""
        self.study, self.output = study, output
        self.program = sweep.program_of(study, build)
        self.pool = Pool(workers or [Worker(1)])
        output.mkdir(parents=True, exist_ok=True)
        self.record = Record(output, digest_of(self.program, study.input, *getattr(study, "files", ())), force)

    def compute(self, cases, wanted, report=lambda index, found, progress: None, repeats=1, folder=None):
        """Returns, for each case (overrides), {name: value} of the wanted keys of the summary, or {"failure": message}.

        After each run it calls report(index, found, words of progress). What failed before is tried again. Of repeated runs
        the smallest number counts, which is meant for costs. folder: name of the one that keeps the results of a single case;
        otherwise the next run of a worker replaces them."""
        found, progress = [None] * len(cases), Progress(len(cases))

        def finish(index, result):
            found[index], kept = result
            if not kept and "failure" not in found[index]:
                self.record.add(self.key(cases[index], wanted, repeats), found[index])
            report(index, found[index], progress.after(kept))

        self.pool.each(lambda worker, case: self.one(worker, case, wanted, repeats, folder), cases, finish)
        return found

    def settle(self, worker, case, wanted):
        """Returns what one run on a worker gives, and whether the record had it. For work that chooses its next run by itself."""
        found, kept = self.one(worker, case, wanted, 1)
        if not kept and "failure" not in found:
            self.record.add(self.key(case, wanted, 1), found)
        return found, kept

    def key(self, case, wanted, repeats):
        return " ".join([*self.words(case), "->", *wanted, *([f"x {repeats}"] if repeats > 1 else [])])

    def words(self, case):
        return [f"{key}={value}" for key, value in (self.study.fixed | case).items()]

    def one(self, worker, case, wanted, repeats, folder=None):
        """Returns what a run gives, and whether the record had it."""
        if (kept := self.record.done.get(self.key(case, wanted, repeats))) is not None:
            return kept, True
        try:
            all_of_them = [self.once(worker, case, wanted, folder) for _ in range(repeats)]
        except sweep.RunFailed as failed:
            return {"failure": str(failed)}, False
        first = all_of_them[0]
        return {name: min(one[name] for one in all_of_them) if isinstance(first[name], (int, float)) else first[name]
                for name in wanted}, False

    def once(self, worker, case, wanted, folder=None):
        """@raises RunFailed with the program's message"""
        folder = self.output / (folder or f"run_{worker.number}")
        more = one_thread(self.study.program, self.study.fixed | case, self.pool)
        environment = os.environ | {"DEAL_II_NUM_THREADS": "1"} if self.pool.count > 1 and worker.host == HERE else None
        code, _, err = self.pool.execute(
            worker, [self.program, self.study.input, "--output", folder, "--force", *self.words(case), *more], environment)
        if code:
            raise sweep.RunFailed(f"{' '.join(self.words(case))}: exit code {code}: {err.strip()}")
        summary = sweep.read_summary(folder, " ".join(self.words(case)))
        return {name: sweep.answer(folder, summary, name) if "@" in name else summary.get(name) for name in wanted}

