"""The errors and warnings of the library. A message is one line and names parameters in backticks, such as `size`."""

from __future__ import annotations

import os
import re
import sys
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

#: Where frames of the package are: in its folder, and in the code that attrs generates for its classes.
_INSIDE = (os.path.dirname(__file__) + os.sep, "<attrs generated")

#: A line of a program: its file, number, module, and the registry of the warnings that it has given.
Place = tuple[str, int, str, dict[Any, Any]]


class _OneLine:
    """An error that a notebook shows in one line, since all that is to be done about it is in the message."""

    def _render_traceback_(self) -> list[str]:
        """Return what IPython shows in place of the traceback, which `traceback.print_exc` prints as ever."""
        return [f"{type(self).__name__}: {self}"]


class ShackledError(_OneLine, Exception):
    """Base of all errors of the library."""


class KeywordError(_OneLine, TypeError):
    """A keyword that is not known, or given twice. The message says what would be right."""

    def __init__(self, message: str, keyword: str = "") -> None:
        """Take the message, and the keyword if it is not known."""
        super().__init__(message)
        self.keyword = keyword


class InputError(ShackledError, ValueError):
    """An invalid value or file. The message says what is wrong, where, and what would be right."""

    def __init__(self, message: str = "") -> None:
        """Take the message, of which line breaks, as arrays have when they are shown, become spaces."""
        super().__init__(re.sub(r"\s*\n\s*", " ", message))


def not_installed(what: str, extra: str) -> InputError:
    """Return the error for what needs the package of an extra."""
    return InputError(f"{what} needs a package that is not installed: pip install 'shackled[{extra}]'")


class InputWarning(UserWarning):
    """What was asked for is not what is drawn: a part of a file is ignored, or a picture is made to fit."""


def caller() -> Place:
    """Return the line outside of the package that led here, as it is in the thread that runs."""
    frame = sys._getframe()
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_INSIDE):
        frame = frame.f_back
    code, names = frame.f_code, frame.f_globals
    return code.co_filename, frame.f_lineno, names.get("__name__") or "", names.setdefault("__warningregistry__", {})


#: What stands in messages, and what is said in its place.
_NAMES: ContextVar[tuple[tuple[str, str], ...]] = ContextVar("_NAMES", default=())


def _renamed(message: str) -> str:
    for said, name in _NAMES.get():
        message = message.replace(said, name)
    return message


@contextmanager
def renaming(path: str, name: str) -> Iterator[None]:
    """Let messages about a file, and about what is beside it, not name where it is stored."""
    before = _NAMES.set(((path, name), (f"{os.path.dirname(path)}{os.sep}", ""), *_NAMES.get()))
    try:
        yield
    except InputError as error:
        raise InputError(_renamed(str(error))) from None
    finally:
        _NAMES.reset(before)


def warn(message: str, category: type[Warning] = InputWarning, place: Place | None = None) -> None:
    """Warn, by default at the line of `caller`."""
    file, line, module, registry = place or caller()
    warnings.warn_explicit(_renamed(message), category, file, line, module, registry)


class OutputError(ShackledError, OSError):
    """A file could not be written, for instance because the disk is full."""

    def __str__(self) -> str:
        return f"{self.filename} cannot be written: {self.strerror or 'no reason is given'}"


class FetchError(ShackledError):
    """A file could not be downloaded or stored."""


class ChainError(ShackledError):
    """Base of all errors of contracts, nodes and transactions."""


class RenderError(ChainError):
    """A contract refused a scene or did not return a picture."""


class OutOfGasError(ChainError):
    """A call needed more gas than its limit, which is None if it is not known."""

    limit: int | None = None


class RevertError(ChainError):
    """A call reverted. data: the revert data, empty if the contract or the node gives none."""

    def __init__(self, message: str, data: bytes = b"") -> None:
        """Take the message and the revert data."""
        super().__init__(message)
        self.data = data


class VerificationError(ChainError):
    """Data on a chain is not as expected."""


class TransactionError(ChainError):
    """A transaction was not accepted, failed, or is still pending."""


class NodeError(ChainError):
    """A fault of a node, not of the contract that it ran."""


class NoAnswerError(NodeError):
    """Base of errors after which a node may answer later."""


class NodeUnreachableError(NoAnswerError):
    """No complete answer: nothing listens, the connection broke, or the server is not a node."""


class NodeBusyError(NoAnswerError):
    """A node is busy. retry_after: the delay in seconds that it requests, or None."""

    def __init__(self, message: str, retry_after: float | None = None) -> None:
        """Take the message and the requested delay."""
        super().__init__(message)
        self.retry_after = retry_after


class NodeTimeoutError(NoAnswerError):
    """A node took too long, or aborted a call that did."""


class TooLargeError(NodeError):
    """A request or an answer exceeds the size limit of a node."""


class WrongChainError(NodeError):
    """A node belongs to another chain than expected, or to one that cannot run the contracts."""
