"""Files that contracts make in one call."""

from __future__ import annotations

import os
from pathlib import Path

from attrs import field, frozen

from .base.whole_file import check_output_file, write_output
from .image import data_uri


@frozen
class ContractFile:
    """A file, byte for byte as a contract made it.

    gas: of the execution; None where it is not counted. made_by: the EVM or node.
    """

    content: bytes = field(repr=False)
    media_type: str
    gas: int | None
    intrinsic_gas: int
    made_by: str

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the file atomically."""
        write_output(check_output_file(Path(path), "file"), self.content)

    def data_uri(self) -> str:
        """Return a URI that holds the file, as for the `animation_url` of a token."""
        return data_uri(self.media_type, self.content)
