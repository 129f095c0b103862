"""Random numbers from a seed, without state: the same tag and words always give the same number.

As contracts/src/genesis/Random.sol.
"""

from __future__ import annotations

from dataclasses import dataclass

from Crypto.Hash import keccak


def keccak256(data: bytes) -> bytes:
    """Return the hash that Ethereum uses."""
    return keccak.new(digest_bits=256, data=data).digest()


@dataclass(frozen=True)
class Random:
    """The random numbers of one piece."""

    seed: bytes

    def hash(self, tag: str, *words: int) -> int:
        """Return a number of 256 bits."""
        tail = b"".join(word.to_bytes(32, "big") for word in words)
        return int.from_bytes(keccak256(self.seed + tag.encode("ascii") + tail), "big")

    def draw(self, tag: str, *words: int, low: int, high: int) -> int:
        """Return a number from `low` to `high`, both included; `low` if `high` is below it."""
        return low + self.hash(tag, *words) % max(1, high - low + 1)

    def chance(self, percent: int, tag: str, *words: int) -> bool:
        """Return True in `percent` + 1 of 101 cases."""
        return self.draw(tag, *words, low=0, high=100) <= percent
