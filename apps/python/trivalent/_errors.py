"""The errors of the libraries, with the same messages as the program's."""


class Error(Exception):
    """Base of everything that trivalent raises on purpose."""


class InvalidOption(Error, ValueError):
    """An option is out of its range, or does not go with another."""


class InvalidArray(Error, ValueError):
    """An array has the wrong shape, type or values; the message names it."""


class InvalidMesh(Error, ValueError):
    """A surface that cannot be used; the message names the place and a way out."""


class InvalidNetwork(Error, ValueError):
    """Bonds or rings that cannot be; the message names the element."""


class InvalidAtoms(Error, ValueError):
    """Atoms without an energy: not finite, on top of each other, without a cell."""


class FileError(Error, OSError):
    """A file is missing, malformed or cannot be written; the message names the line."""


for _error in (Error, InvalidOption, InvalidArray, InvalidMesh, InvalidNetwork, InvalidAtoms, FileError):
    _error.__module__ = "trivalent"
del _error
