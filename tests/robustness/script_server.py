"""Runs scripts many times without importing their libraries each time: what fork_server.cc does, for Python. The first word of a
command line is the script."""

import os
import resource
import runpy
import sys

import h5py  # noqa: F401  imported before the copies are made
import jinja2  # noqa: F401
import matplotlib
import numpy  # noqa: F401

matplotlib.use("Agg")

import matplotlib.figure  # noqa: E402,F401
from matplotlib.backends import backend_agg, backend_svg  # noqa: E402,F401


def redirect(path, flags, descriptor):
    opened = os.open(path, flags, 0o644)
    os.dup2(opened, descriptor)
    os.close(opened)


def work(folder, out, error, memory, script, *arguments):
    os.chdir(folder)
    redirect(os.devnull, os.O_RDONLY, 0)
    redirect(out, os.O_WRONLY | os.O_CREAT, 1)
    redirect(error, os.O_WRONLY | os.O_CREAT, 2)
    resource.setrlimit(resource.RLIMIT_AS, (int(memory), int(memory)))
    sys.argv = [os.fsdecode(word) for word in (script, *arguments)]
    sys.path[0] = os.path.dirname(sys.argv[0])
    sys.stdin, sys.stdout, sys.stderr = (open(number, mode, closefd=False) for number, mode in ((0, "r"), (1, "w"), (2, "w")))
    try:
        runpy.run_path(sys.argv[0], run_name="__main__")
        code = 0
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
    except BaseException:
        sys.excepthook(*sys.exc_info())
        code = 1
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            code = code or 120
    os._exit(code)


def main():
    for request in iter(sys.stdin.buffer.readline, b""):
        with open(request.rstrip(b"\n"), "rb") as stream:
            texts = stream.read().split(b"\0")[:-1]
        child = os.fork()
        if child == 0:
            work(*texts)
        print(child, flush=True)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)


if __name__ == "__main__":
    main()
