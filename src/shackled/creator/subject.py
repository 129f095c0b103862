"""A picture with all that it is made of, for those who write it down."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ..scene import Scene
from .link import LOCAL, is_local
from .scene import Facts
from .state import State
from .store import Stored


@dataclass(frozen=True, eq=False)
class Subject:
    """source: the scene of the state's source, whose facts are given; scene: what is drawn. stored: the file of an
    upload. link: the address that restores the picture, for comments.
    """

    state: State
    facts: Facts
    source: Scene
    scene: Scene
    stored: Stored | None = None
    link: str = ""

    @property
    def stem(self) -> str:
        """A name for files: "genesis-12", or that of the file that was handed in."""
        source = self.state.source
        name = self.facts.title.rpartition(".")[0] if source.kind == "upload" else source.name
        stem = re.sub(r"[^0-9A-Za-z]+", "-", name).strip("-")
        return stem[:24].strip("-") or "picture"

    @property
    def comments(self) -> list[str]:
        """Lines that belong to every written form: the link, and whom to name."""
        local = LOCAL if is_local(self.link) else ""
        return [" ".join(text.split()) for text in (self.link, local, self.facts.notice) if text.strip()]
