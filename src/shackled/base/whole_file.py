"""Atomic writes: a file is replaced completely or not at all."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..errors import InputError, OutputError

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

#: Bytes of a file's name that are repeated in that of its temporary file; names have at most 255.
NAME = 200
#: Errors of a path, and not of the disk: those that have classes, and the others.
WRONG_PATH = (PermissionError, FileNotFoundError, IsADirectoryError, NotADirectoryError)
WRONG_PATH_NUMBERS = (errno.ELOOP, errno.ENAMETOOLONG, errno.EROFS)


def write_output(path: Path, data: bytes, is_verified: bool = False) -> None:
    """Write a file that the user has named, as `write_whole` does.

    InputError where the path is wrong, OutputError where the disk is full or fails.
    """
    with _of_user(path):
        write_whole(path, data, is_verified=is_verified)


def make_output_folder(path: Path) -> None:
    """Make a folder that the user has named, and its parents. Errors as in `write_output`."""
    with _of_user(path):
        check_output_folder(path).mkdir(parents=True, exist_ok=True)


def check_output_folder(path: Path) -> Path:
    """Return the path, if it is a folder or does not exist; otherwise InputError."""
    with _of_user(path):
        if path.exists() and not path.is_dir():
            raise InputError(f"{path} is a file, not a folder to write to")
    return path


def check_output_file(path: Path, what: str, in_new_folder: bool = False) -> Path:
    """Return the path, if a file can be written there, otherwise InputError.

    what: the word for it in messages. in_new_folder: whether its folder will be made if it does not exist.
    """
    with _of_user(path):
        if path.is_dir():
            raise InputError(f"{path} is a folder, not the file of a {what}")
        is_special = path.exists() and not path.is_file()
        folder = path.parent if not path.is_symlink() else Path(os.path.realpath(path)).parent
        if in_new_folder and not folder.exists():
            return path
        if not folder.is_dir():
            raise InputError(f"the folder {folder} of the {what} {path.name} does not exist")
    if not is_special and not os.access(folder, os.W_OK):
        raise InputError(f"the {what} {path} cannot be written: nothing can be written to its folder")
    return path


def write_whole(path: Path, data: bytes, mode: int = 0o666, is_verified: bool = False) -> None:
    """Write a file atomically, replacing any other. If it raises OSError, no file has changed.

    A symbolic link is followed. Pipes and devices are written to directly. mode: less what the umask takes away.
    is_verified: whether readers notice a file that is empty after a power failure; the disk is not waited for.
    """
    is_there = path.exists()
    if is_there and not path.is_file():
        path.write_bytes(data)
        return
    target = Path(os.path.realpath(path, strict=is_there))
    if target.is_symlink():
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    prefix = f".{os.fsdecode(os.fsencode(target.name)[:NAME])}."
    with tempfile.NamedTemporaryFile(dir=target.parent, prefix=prefix, delete=False) as file:
        try:
            file.write(data)
            file.flush()
            if not is_verified:
                os.fsync(file.fileno())  # otherwise it may be empty after a power failure
            os.chmod(file.name, mode & ~_umask())
            file.close()
            os.replace(file.name, target)
        except BaseException:
            with suppress(FileNotFoundError):
                os.unlink(file.name)
            raise


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, for which other processes wait; none where the system has no such locks."""
    if fcntl is None:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # a disk of another machine may have none
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)


@contextmanager
def _of_user(path: Path) -> Iterator[None]:
    """Raise an InputError or OutputError for an OSError of a path that the user has named."""
    try:
        yield
    except OSError as error:
        if isinstance(error, OutputError):
            raise
        failure = OutputError(error.errno, error.strerror, str(path))
        is_path = isinstance(error, WRONG_PATH) or error.errno in WRONG_PATH_NUMBERS
        raise (InputError(str(failure)) if is_path else failure) from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
