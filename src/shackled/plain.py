"""What strangers say, on a chain, from a node or in the name of a file, made safe for a terminal."""

from __future__ import annotations


def plain(text: str) -> str:
    """The text with a question mark for every character that a terminal could take for a command."""
    return "".join(letter if letter.isprintable() else "?" for letter in text)
