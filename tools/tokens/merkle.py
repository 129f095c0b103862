"""Build the Merkle tree of an allow list independently: leaves in order, pairs sorted."""

from __future__ import annotations

from collections.abc import Mapping

from tools.tokens.world import keccak


def leaf(address: str, quantity: int) -> bytes:
    """Hash an entry."""
    return keccak(keccak(bytes.fromhex(address[2:]).rjust(32, b"\0") + quantity.to_bytes(32, "big")))


def pair(*nodes: bytes) -> bytes:
    """Hash two nodes, in either order; a single node is returned unchanged."""
    return nodes[0] if len(nodes) == 1 else keccak(b"".join(sorted(nodes)))


def _layers(entries: Mapping[str, int]) -> list[list[bytes]]:
    layers = [sorted(leaf(*entry) for entry in entries.items())]
    while len(layers[-1]) > 1:
        layers.append([pair(*layers[-1][at : at + 2]) for at in range(0, len(layers[-1]), 2)])
    return layers


def root_of(entries: Mapping[str, int]) -> bytes:
    """Return the root of the tree of accounts and quantities."""
    return _layers(entries)[-1][0]


def proof_of(entries: Mapping[str, int], address: str) -> list[bytes]:
    """Return the nodes that lead from the entry of an account to the root."""
    proof, layers = [], _layers(entries)
    place = layers[0].index(leaf(address, entries[address]))
    for layer in layers[:-1]:
        proof += layer[place ^ 1 : (place ^ 1) + 1]
        place //= 2
    return proof
