"""Make contracts/src/library/ItemTable.sol, the table of the library on chain.

The table has the addresses at which the Studio keeps the items, which are made of their bytes and the address of the
Studio: run it after tools/build_contracts.py whenever the Studio has changed, then compile the group "library".
"""

from __future__ import annotations

from pathlib import Path

from shackled.library import Item, items
from shackled.scene._codec import SHADINGS

ROOT = Path(__file__).resolve().parent.parent
TABLE = ROOT / "contracts" / "src" / "library" / "ItemTable.sol"
#: Digits of a line.
WIDTH = 120
IS_ICON = 0x80


def row(item: Item) -> bytes:
    """Return the row of an item, as Library.sol says."""
    name = item.name.encode()
    numbers = [*item.low, *item.high]
    meshes = b"".join(
        pointer
        + bytes(
            [
                SHADINGS[each.shading],
                *(round(100 * part) for part in (each.ambient, each.diffuse, each.specular)),
                round(each.shininess),
            ]
        )
        for pointer, each in zip(item.meshes, item.materials, strict=True)
    )
    return (
        bytes([len(name)])
        + name
        + bytes([(IS_ICON if item.is_icon else 0) | len(item.meshes)])
        + item.pointer
        + b"".join(int(value).to_bytes(2, "big", signed=True) for value in numbers)
        + item.scene.triangles.to_bytes(2, "big")
        + meshes
    )


def files() -> dict[Path, str]:
    """Return the source with the table of all items, by its path."""
    rows = "".join(_literal(row(item).hex(), item.name) for item in items())
    source = f"""// SPDX-License-Identifier: MIT
pragma solidity 0.8.37;

// Written by tools/library.py.

/// @notice The table of the library: a row for each item, in the format of `Library.sol`.
library ItemTable {{
    /// @notice The number of items.
    uint256 internal constant COUNT = {len(items())};

    function table() internal pure returns (bytes memory) {{
        return
{rows.rstrip()};
    }}
}}
"""
    return {TABLE: source}


def _literal(digits: str, name: str) -> str:
    lines = [digits[at : at + WIDTH] for at in range(0, len(digits), WIDTH)]
    return f"            // {name}\n" + "".join(f'            hex"{line}"\n' for line in lines)
