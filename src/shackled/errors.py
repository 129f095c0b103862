"""The errors of the library. Each message is one line and names parameters as `size`, in backticks."""

from __future__ import annotations


class ShackledError(Exception):
    """The base of all errors of the library."""


class InputError(ShackledError, ValueError):
    """A value or a file is wrong. The message says what is wrong, where, and what would be right."""


class InputWarning(UserWarning):
    """Something in a file cannot be used, and is left out."""


class OutputError(ShackledError, OSError):
    """A file could not be written, for instance because the disk is full."""

    def __str__(self) -> str:
        """Return the name of the file, and why it could not be written."""
        return f"{self.filename} cannot be written: {self.strerror or 'no reason is given'}"


class FetchError(ShackledError):
    """A file could not be downloaded, or not be kept."""


class ChainError(ShackledError):
    """A contract, a node or a transaction failed. The base of all errors of that kind."""


class RenderError(ChainError):
    """A contract refused a scene, or did not return a picture."""


class OutOfGasError(ChainError):
    """A call needed more gas than it had."""


class RevertError(ChainError):
    """A call was reverted. data: what the contract said, empty if it said nothing or the node keeps it to itself."""

    def __init__(self, message: str, data: bytes = b"") -> None:
        """Take the message, and the data of the revert."""
        super().__init__(message)
        self.data = data


class VerificationError(ChainError):
    """What a chain keeps or tells is not what it should be."""


class TransactionError(ChainError):
    """A transaction was not accepted, failed, or is still on its way."""


class NodeError(ChainError):
    """A node failed, not the contract that it ran."""


class NoAnswerError(NodeError):
    """A node gave no answer now; it may give one later. The base of errors of that kind."""


class NodeUnreachableError(NoAnswerError):
    """There is no whole answer: nobody listens, the connection broke, or something else than a node answers."""


class NodeBusyError(NoAnswerError):
    """A node is busy. retry_after: the seconds after which it wants to be asked again, if it says so."""

    def __init__(self, message: str, retry_after: float | None = None) -> None:
        """Take the message, and the seconds of the pause."""
        super().__init__(message)
        self.retry_after = retry_after


class NodeTimeoutError(NoAnswerError):
    """A node took too long, or gave up a call that did."""


class TooLargeError(NodeError):
    """A request or an answer is larger than a node takes or gives."""


class WrongChainError(NodeError):
    """A node belongs to another chain than the one that is wanted, or to one that cannot run the contracts."""
