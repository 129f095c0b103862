"""The custom errors of the contract."""

from __future__ import annotations

from ..errors import RenderError


class Reverted(RenderError):
    """The call reverts with a custom error of the contract."""

    def __init__(self, error: str, **values: int) -> None:
        """Take the name and the values of the error."""
        described = ", ".join(f"{name}={value}" for name, value in values.items())
        super().__init__(f"the contract refused: {error}({described})")
