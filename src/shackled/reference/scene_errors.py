"""What can be wrong with a scene: the errors of the contract."""

from __future__ import annotations

from ..errors import RenderError


class Reverted(RenderError):
    """The call reverts with a custom error of the contract: its name and values."""

    def __init__(self, error: str, **values: int) -> None:
        """`error`: its name."""
        described = ", ".join(f"{name}={value}" for name, value in values.items())
        super().__init__(f"the contract refused: {error}({described})")
