"""The errors that people see."""


class InputError(ValueError):
    """Something that was handed in is wrong. The message is one line: what is wrong, where, and what would be right."""


class RenderError(RuntimeError):
    """A contract refused the call, or the call could not be made. The message is one line."""


class FetchError(RuntimeError):
    """A file could not be fetched, or not kept. The message is one line."""


class OutOfGasError(RenderError):
    """The gas of a call did not suffice."""
