"""What is made of the arguments before they are parsed."""

from __future__ import annotations

from collections.abc import Sequence


def with_cluster(arguments: Sequence[str]) -> list[str]:
    """The arguments, with "--cluster=" for a --cluster that no address follows. An address has a colon in it."""
    found = list(arguments)
    for place, argument in enumerate(arguments):
        if argument == "--":
            break
        if argument == "--cluster" and ":" not in "".join(found[place + 1 : place + 2]):
            found[place] = "--cluster="
    return found
