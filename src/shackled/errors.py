"""The errors that people see. Each message is one line."""

from __future__ import annotations


class InputError(ValueError):
    """Something that was handed in is wrong. The message is one line: what is wrong, where, and what would be right."""


class InputWarning(UserWarning):
    """Something that was handed in cannot be used, and is left out. The message is one line."""


class OutputError(OSError):
    """A file could not be written: the disk is full, for instance. The message is one line."""

    def __str__(self) -> str:
        """What, and why."""
        return f"{self.filename} cannot be written: {self.strerror or 'no reason is given'}"


class FetchError(RuntimeError):
    """A file could not be fetched, or not kept. The message is one line."""


class RenderError(RuntimeError):
    """A contract refused the call, or the call could not be made. The message is one line."""


class OutOfGasError(RenderError):
    """The gas of a call did not suffice."""


class RevertError(RenderError):
    """A call was reverted. data: what the contract said, empty if it said nothing or the node keeps it to itself."""

    def __init__(self, message: str, data: bytes = b"") -> None:
        """The message is one line."""
        super().__init__(message)
        self.data = data


class NodeError(RenderError):
    """A node failed, not the contract that it ran."""


class NodeUnreachableError(NodeError):
    """There is no whole answer: nobody listens, the connection broke, or something else than a node answers."""


class NodeBusyError(NodeError):
    """A node wants to be asked later. retry_after: in how many seconds, if it says so."""

    def __init__(self, message: str, retry_after: float | None = None) -> None:
        """The message is one line."""
        super().__init__(message)
        self.retry_after = retry_after


class NodeTimeoutError(NodeError):
    """A node took too long, or gave up a call that did."""


class TooLargeError(NodeError):
    """A request or an answer is larger than a node takes or gives."""


class TransactionError(RenderError):
    """A transaction was not accepted, failed, or is still on its way."""


class WrongChainError(NodeError):
    """A node belongs to another chain than the one that is wanted, or to one that cannot run the contracts."""
