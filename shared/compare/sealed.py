"""HDF5 files of the programs, opened only if they are whole.

Run as a program it puts the seal on a file that another program has written, such as a damage table of your own.

Each ends with a seal, a checksum of all that is before it (shared/seal.h): HDF5 does not notice changed bytes, and some of them
make it crash. Nothing outside of the file is read: links to other files and arrays whose values are elsewhere are refused."""

import contextlib
import struct
import sys
import zlib

import h5py

from files import Unreadable, fault_of_file
from writing import Parser, Refused, Unwritten, run_script, visible

MARK = b"SPALLCRC"
TAIL = struct.Struct("<QQQ8s")  # number of parts that are left out, size of the contents, CRC-32, mark
PART = struct.Struct("<QQ")  # first byte and count
BLOCK = 1 << 20


def checksum(stream, parts, size):
    """Returns the checksum of the contents without the parts, then of the list of these, their number and the size."""
    total, at = 0, 0
    for first, count in [*parts, (size, 0)]:
        if first < at or first + count > size:
            return None
        stream.seek(at)
        while at < first:
            block = stream.read(min(BLOCK, first - at))
            if not block:
                return None
            total, at = zlib.crc32(block, total), at + len(block)
        at = first + count
    return zlib.crc32(b"".join(PART.pack(*part) for part in parts) + struct.pack("<QQ", len(parts), size), total)


def check_seal(path):
    """@raises Unreadable: the file is damaged, or was not written by a program of this version"""
    if fault := fault_of_file(path):
        raise Unreadable(f"{path}: {fault}")
    try:
        with open(path, "rb") as stream:
            length = stream.seek(0, 2)
            stream.seek(max(0, length - TAIL.size))
            tail = stream.read()
            if len(tail) < TAIL.size or not tail.endswith(MARK):
                raise Unreadable(f"{path}: is truncated, of an earlier version, or written by another program: it does not end with "
                                 "a checksum")
            number, size, total, _ = TAIL.unpack(tail)
            parts = []
            if fits := number <= 10000 and size + number * PART.size + TAIL.size == length:
                stream.seek(size)
                parts = list(PART.iter_unpack(stream.read(number * PART.size)))
            if not fits or checksum(stream, parts, size) != total:
                raise Unreadable(f"{path}: is damaged: its checksum is another one")
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from error


def seal(path):
    """Adds the seal to a file. @raises OSError"""
    with open(path, "r+b") as stream:
        size = stream.seek(0, 2)
        total = checksum(stream, [], size)
        stream.seek(size)
        stream.write(TAIL.pack(0, size, total, MARK))


def main(arguments):
    parser = Parser(prog="sealed.py", description="Puts the checksum on HDF5 files that another program has written, such as a damage "
                    "table of your own: programs and report read no other ones.")
    parser.add_argument("files", nargs="+", metavar="FILE")
    for path in parser.parse_args(arguments).files:
        if fault := fault_of_file(path):
            raise Refused(f"{path}: {fault}")
        try:
            check_seal(path)
            print(f"{visible(path)}: has its checksum")
        except Unreadable:
            if not h5py.is_hdf5(path):
                raise Refused(f"{path}: is no HDF5 file") from None
            try:
                seal(path)
            except OSError as error:
                raise Unwritten(f"cannot write '{path}': {error.strerror}") from error
            print(f"{visible(path)}: has got its checksum")
    return 0


@contextlib.contextmanager
def opened(path):
    """Opens a file for reading. @raises Unreadable"""
    check_seal(path)
    try:
        with h5py.File(path, "r") as file:
            yield file
    except (OSError, KeyError, ValueError, TypeError, RuntimeError) as error:
        raise Unreadable(f"{path}: {error}") from error


def is_own(group, name):
    """Returns whether a name in a group is an object of the file itself."""
    return isinstance(group.get(name, getlink=True), h5py.HardLink)


def names(group):
    """Returns the names of the objects of a group that are in the file itself."""
    return [name for name in group if is_own(group, name)]


def values(group, name):
    """Returns an array. @raises ValueError if it is no object of the file itself, or its values are elsewhere"""
    if name not in group or not is_own(group, name):
        raise ValueError(f"'{name}' is no object of the file itself")
    found = group[name]
    if not isinstance(found, h5py.Dataset) or found.external or found.is_virtual or found.nbytes > found.id.get_storage_size():
        raise ValueError(f"'{name}' has its values elsewhere")
    return found[:]


if __name__ == "__main__":
    sys.exit(run_script("sealed.py", lambda: main(sys.argv[1:])))
