"""Writing of results by the scripts: whole files or none, one owner of a folder, and words that must arrive.

The programs follow the same rules (shared/result_folder.h, shared/output_directory.h, shared/program.h)."""

import argparse
import contextlib
import fcntl
import os
import pathlib
import re
import secrets
import signal
import sys
import threading
import traceback

LONGEST_MESSAGE = 1500  # characters of a message that are shown


def visible(text):
    """Returns a text as one line in which a terminal obeys nothing, as the programs show theirs (shared/input/visible.h)."""
    text = os.fsencode(str(text)).decode("utf-8", "backslashreplace")
    text = re.sub(r"[\x00-\x1f\x7f-\x9f\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]",
                  lambda match: match[0].encode("unicode_escape").decode(), text)
    cut = len(text) - LONGEST_MESSAGE
    half = LONGEST_MESSAGE // 2
    return text if cut <= 0 else f"{text[:half]} [... {cut} characters ...] {text[-half:]}"


def complain(name, message):
    """Prints a line on standard error."""
    print(f"{name}: {visible(message)}", file=sys.stderr)


class Refused(Exception):
    """One line: why nothing was changed on the disk. Exit code 2."""


class Unwritten(Exception):
    """One line: which file could not be written, and why. An older one is untouched. Exit code 3."""


class Parser(argparse.ArgumentParser):
    """Options of a script. What is wrong with a command line is said in one line: a word that is not known, an option that is
    shortened, given twice, or empty."""

    def __init__(self, **more):
        super().__init__(allow_abbrev=False, **more)

    def error(self, message):
        raise Refused(f"command line: {message}; see --help")

    def parse_args(self, arguments):
        names = {name: action for action in self._actions for name in action.option_strings}
        found = []
        for word in arguments:
            name, sign, value = word.partition("=")
            if name in names and (not sign or name.startswith("--")):
                found.append(names[name].dest)
            if word == "" or (name in names and sign and not value):
                self.error(f"found an empty {'word' if not word else name}")
        for dest in found:
            if found.count(dest) > 1 and dest != "help":
                self.error(f"found --{dest} twice, allowed: once")
        return super().parse_args(arguments)


def write(path, content):
    """Writes text or bytes into a new file of a name that cannot be predicted, waits until the disk has it, then renames it: a
    link of that name is replaced, not followed. @raises Unwritten"""
    path = pathlib.Path(path)
    part = path.with_name(f".spall-{secrets.token_hex(8)}.part")
    try:
        if path.exists() and not path.is_file() and not path.is_symlink():
            raise OSError(0, "is no regular file")
        with open(part, "xb") as stream:
            stream.write(content.encode("utf-8", "backslashreplace") if isinstance(content, str) else content)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(part, path)
    except OSError as error:
        raise Unwritten(f"cannot write '{path}': {error.strerror or error}") from error
    finally:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)


@contextlib.contextmanager
def own(folder, results, force):
    """Makes a folder if it is not there, and owns it: the lock ends with the block, and with the process.

    results: patterns of the files in it that are not replaced unless `force`. @raises Refused, also if it cannot be made"""
    folder = pathlib.Path(folder)
    try:
        if folder.exists() and not folder.is_dir():
            raise Refused(f"output folder '{folder}' is a file")
        there = sorted(path for pattern in results for path in folder.glob(pattern))
        if there and not force:
            raise Refused(f"output folder '{folder}' holds results ({there[0].name}), which are not replaced unasked: --force "
                          "replaces them, --output DIR writes elsewhere")
        if links := [path for path in there if path.is_symlink()]:
            raise Refused(f"output folder '{folder}': its '{links[0].name}' is a link, which is not followed: remove it, or give "
                          "another --output")
        folder.mkdir(parents=True, exist_ok=True)
        held = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
        if not os.access(folder, os.W_OK):
            raise Refused(f"output folder '{folder}' cannot be written")
    except (OSError, ValueError) as error:  # ValueError: a name with a NUL
        raise Refused(f"output folder '{folder}' cannot be made: {getattr(error, 'strerror', None) or error}") from error
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


def interrupt(*_):
    raise KeyboardInterrupt


def run_script(name, main):
    """Runs main() and returns the exit code: 2 if it refuses, 3 if something could not be written, standard output included, 130
    if it was interrupted."""
    for descriptor in (0, 1, 2):  # a closed one: no file must take its number, or the words of others would go into it
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    words = sys.stdout = Words(sys.stdout or open(os.devnull, "w", encoding="utf-8"))
    for stream in (words.stream, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    for number in (signal.SIGTERM, signal.SIGHUP):
        if threading.current_thread() is threading.main_thread() and signal.getsignal(number) != signal.SIG_IGN:  # nohup stays
            signal.signal(number, interrupt)
    try:
        code = main()
    except SystemExit as end:  # of argparse
        code = end.code or 0
    except Refused as error:
        code = 2
        complain(name, error)
    except Unwritten as error:
        code = 3
        complain(name, error)
    except KeyboardInterrupt:
        code = 130
    except BrokenPipeError:
        code = 3
    except Exception as error:  # nobody has thought of it: where it is helps those who mend it
        code = 3
        place = traceback.extract_tb(error.__traceback__)[-1]
        complain(name, f"failed unexpectedly: {type(error).__name__}: {error} ({pathlib.Path(place.filename).name}:{place.lineno})")
    words.flush()
    sys.stdout = words.stream
    if words.lost:
        print(f"{name}: standard output could not be written: words are missing there", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # Python writes what it still holds when it ends
        code = code or 3
    return code
