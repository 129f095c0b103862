"""The errors of the library. Each message is one line and names parameters as `size`, in backticks."""

from __future__ import annotations


class ShackledError(Exception):
    """The base of all errors of the library."""


class InputError(ShackledError, ValueError):
    """A value or a file is wrong. The message says what is wrong, where, and what would be right."""


class InputWarning(UserWarning):
    """A part of a file is ignored."""


class OutputError(ShackledError, OSError):
    """A file could not be written, for instance because the disk is full."""

    def __str__(self) -> str:
        """Return the name of the file, and why it could not be written."""
        return f"{self.filename} cannot be written: {self.strerror or 'no reason is given'}"


class FetchError(ShackledError):
    """A file could not be downloaded or written."""


class ChainError(ShackledError):
    """A contract, a node or a transaction failed. The base of all errors of that kind."""


class RenderError(ChainError):
    """A contract refused a scene, or did not return a picture."""


class OutOfGasError(ChainError):
    """A call needed more gas than it had."""


class RevertError(ChainError):
    """A call was reverted. data: the revert data, empty if there is none or the node does not return it."""

    def __init__(self, message: str, data: bytes = b"") -> None:
        """Take the message, and the data of the revert."""
        super().__init__(message)
        self.data = data


class VerificationError(ChainError):
    """Data of a chain differs from what it must be."""


class TransactionError(ChainError):
    """A transaction was not accepted, failed, or is still pending."""


class NodeError(ChainError):
    """A node failed, not the contract that it ran."""


class NoAnswerError(NodeError):
    """A node did not answer, but may answer later. The base of errors of that kind."""


class NodeUnreachableError(NoAnswerError):
    """There is no complete answer: the connection failed, or the server is not a node."""


class NodeBusyError(NoAnswerError):
    """A node is busy. retry_after: the seconds of its Retry-After header, if any."""

    def __init__(self, message: str, retry_after: float | None = None) -> None:
        """Take the message, and the seconds to wait."""
        super().__init__(message)
        self.retry_after = retry_after


class NodeTimeoutError(NoAnswerError):
    """A call took too long."""


class TooLargeError(NodeError):
    """A request or an answer exceeds a limit of a node."""


class WrongChainError(NodeError):
    """A node belongs to another chain, or to one that cannot run the contracts."""
