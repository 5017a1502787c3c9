"""Writing of results by the scripts: whole files or none, one owner of a folder, and words that must arrive.

The programs follow the same rules (shared/result_folder.h, shared/output_directory.h, shared/program.h)."""

import contextlib
import fcntl
import os
import pathlib
import sys


class Refused(Exception):
    """One line: why nothing was changed on the disk. Exit code 2."""


class Unwritten(Exception):
    """One line: which file could not be written, and why. An older one is untouched. Exit code 3."""


def write(path, content):
    """Writes text or bytes under a temporary name, waits until the disk has it, then renames it. @raises Unwritten"""
    path = pathlib.Path(path)
    part = path.with_name(path.name + ".part")
    try:
        with open(part, "wb") as stream:
            stream.write(content.encode("utf-8") if isinstance(content, str) else content)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(part, path)
    except OSError as error:
        try:
            part.unlink(missing_ok=True)
        except OSError:
            pass
        raise Unwritten(f"cannot write '{path}': {error.strerror or error}") from error


@contextlib.contextmanager
def own(folder, results, force):
    """Makes a folder if it is not there, and owns it: the lock ends with the block, and with the process.

    results: patterns of the files in it that are not replaced unless `force`. @raises Refused, and Unwritten if the folder cannot
    be made."""
    folder = pathlib.Path(folder)
    if folder.exists() and not folder.is_dir():
        raise Refused(f"output folder '{folder}' is a file")
    found = next((path.name for pattern in results for path in folder.glob(pattern)), None)
    if found and not force:
        raise Refused(f"output folder '{folder}' holds results ({found}), which are not replaced unasked: --force replaces them, "
                      "--output DIR writes elsewhere")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        held = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    except OSError as error:
        raise Unwritten(f"output folder '{folder}': {error.strerror}") from error
    try:
        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            raise Refused(f"output folder '{folder}' belongs to another run that has not ended") from error
        except OSError as error:  # some network file systems have no locks on folders
            print(f"warning: output folder '{folder}' cannot be locked ({error.strerror}): no other run must write into it",
                  file=sys.stderr)
        yield
    finally:
        os.close(held)


class Words:
    """Standard output that remembers whether a word was lost, instead of ending the work with an exception."""

    def __init__(self, stream):
        self.stream, self.lost = stream, False

    def write(self, text):
        try:
            return self.stream.write(text)
        except OSError:
            self.lost = True
            return len(text)

    def flush(self):
        try:
            self.stream.flush()
        except OSError:
            self.lost = True

    def __getattr__(self, name):
        return getattr(self.stream, name)


def run_script(name, main):
    """Runs main() and returns the exit code: 2 if it refuses, 3 if something could not be written, standard output included, 130
    if it was interrupted."""
    for descriptor in (0, 1, 2):  # a closed one: no file must take its number, or the words of others would go into it
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    words = sys.stdout = Words(sys.stdout or open(os.devnull, "w", encoding="utf-8"))
    try:
        code = main()
    except SystemExit as end:  # of argparse
        code = end.code or 0
    except Refused as error:
        code = 2
        print(f"{name}: {error}", file=sys.stderr)
    except Unwritten as error:
        code = 3
        print(f"{name}: {error}", file=sys.stderr)
    except KeyboardInterrupt:
        code = 130
    words.flush()
    sys.stdout = words.stream
    if words.lost:
        print(f"{name}: standard output could not be written: words are missing there", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # Python writes what it still holds when it ends
        code = code or 3
    return code
