"""Allow lists: which accounts may mint before the public sale, and how many tokens, as a Merkle tree.

The contract stores the root. The tree is that of OpenZeppelin's StandardMerkleTree for ["address", "uint256"], whose
files are written, not read. Leaves are hashed twice, so that no inner node can be taken for a leaf.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..ethereum._encoding import checksum_address, keccak256, parse_address, to_hex, word


@dataclass(frozen=True)
class AllowList:
    """An allow list. allowances: number of tokens that each account may mint in all, by checksummed address."""

    allowances: Mapping[str, int]

    @property
    def root(self) -> bytes:
        """The root of the tree, which the contract stores."""
        return self._tree[0]

    def allowance(self, account: str) -> int:
        """Return the number of tokens that an account may mint. Raises InputError if it is not on the list."""
        address = checksum_address(parse_address(account, "the account"))
        if address not in self.allowances:
            raise InputError(
                f"the account {address} is not among the {len(self.allowances):,} accounts of the allow list"
            )
        return self.allowances[address]

    def proof(self, account: str) -> list[bytes]:
        """Return the Merkle proof of an account. Raises InputError if it is not on the list."""
        place = self._place(leaf_of(account, self.allowance(account)))
        proof = []
        while place > 0:
            proof.append(self._tree[place + 1 if place % 2 else place - 1])
            place = (place - 1) // 2
        return proof

    def document(self) -> dict[str, Any]:
        """Return the list in OpenZeppelin's JSON format."""
        values = [
            {"value": [account, str(quantity)], "treeIndex": self._place(leaf_of(account, quantity))}
            for account, quantity in self.allowances.items()
        ]
        tree = [to_hex(node) for node in self._tree]
        return {"format": "standard-v1", "leafEncoding": ["address", "uint256"], "tree": tree, "values": values}

    @cached_property
    def _leaves(self) -> list[bytes]:
        return sorted(leaf_of(account, quantity) for account, quantity in self.allowances.items())

    def _place(self, leaf: bytes) -> int:
        return len(self._tree) - 1 - bisect_left(self._leaves, leaf)

    @cached_property
    def _tree(self) -> list[bytes]:
        """The nodes, root first; the children of node k are 2k + 1 and 2k + 2. Leaves come last, in falling order."""
        leaves = self._leaves
        nodes = [b""] * (len(leaves) - 1) + leaves[::-1]
        for place in reversed(range(len(leaves) - 1)):
            nodes[place] = hash_pair(nodes[2 * place + 1], nodes[2 * place + 2])
        return nodes


def leaf_of(account: str, quantity: int) -> bytes:
    """Hash an entry: keccak256(keccak256(abi.encode(account, quantity)))."""
    return keccak256(keccak256(word(bytes.fromhex(account.removeprefix("0x"))) + word(quantity)))


def hash_pair(one: bytes, other: bytes) -> bytes:
    """Return the parent of two nodes, whose order does not matter."""
    return keccak256(min(one, other) + max(one, other))


def make_allow_list(entries: Iterable[Sequence[object]], where: str = "the allow list") -> AllowList:
    """Make a list from (account, quantity) entries. Raises InputError if one is invalid, or an account occurs twice."""
    allowances: dict[str, int] = {}
    for number, entry in enumerate(entries, 1):
        at, texts = f"{where}, entry {number}", [str(each).strip() for each in entry]
        if len(texts) != 2:
            raise InputError(f"{at}: it must be account,quantity, not {','.join(texts)!r:.80}")
        address, quantity = checksum_address(parse_address(texts[0], f"{at}: the account")), texts[1]
        if not re.fullmatch("[0-9]{1,78}", quantity) or not 0 < int(quantity) < 2**256:
            raise InputError(f"{at}: the quantity must be a whole number from 1, not {quantity!r:.60}")
        if address in allowances:
            raise InputError(f"{at}: the account {address} occurs twice")
        allowances[address] = int(quantity)
    if not allowances:
        raise InputError(f"{where} is empty: it needs lines such as 0x70997970C51812dc3A010C7d01b50e0d17dc79C8,2")
    return AllowList(allowances)


def read_allow_list(path: str | Path) -> AllowList:
    """Read lines of `account,quantity`; empty lines, lines that begin with #, and a heading are skipped.

    Raises InputError if the file is invalid.
    """
    try:
        text = Path(path).read_text("utf-8-sig")
    except OSError as error:
        raise InputError(f"the allow list {path} cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise InputError(f"the allow list {path} is not text") from None
    lines = [line.replace('"', "").strip() for line in text.splitlines()]
    lines = [line for line in lines if line and not line.startswith("#")]
    # a heading has no number
    if lines and not re.search("[0-9]", lines[0]):
        del lines[0]
    return make_allow_list((line.split(",") for line in lines), f"the allow list {path}")
