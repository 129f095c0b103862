"""Draw the pictures of docs/studio.md: all items, requested from the contract Web, and the scenes of an example.

    python -m tools.docs.draw_library

Needs the compiler: `npm ci` in contracts/.
"""

from __future__ import annotations

import io
from collections.abc import Iterable
from typing import Any

import numpy as np
from eth_abi.abi import decode, encode
from numpy.typing import NDArray
from PIL import Image as PillowImage

from shackled.artifacts import artifact
from shackled.chain import open_chain
from shackled.chain._embedded import EmbeddedChain
from shackled.chain._failures import describe_revert
from shackled.ethereum._encoding import word
from shackled.evm._instance import Instance, Status
from shackled.library import Item, chosen_items, items
from shackled.studio._storage import STUDIO
from tools.docs.draw_pictures import contact_sheet
from tools.examples import compile_example
from tools.pages import IMAGES

EXAMPLE = "examples/library/Pedestal.sol"
GAS = 1_000_000_000

#: What stands on pedestals, and in the compartments.
ON_PEDESTALS = ("crown", "teapot", "glasses")
IN_COMPARTMENTS = ("skull", "rocket", "torus-knot")


class Shelf:
    """A chain with the contracts and with items of the library."""

    def __init__(self, stored: Iterable[Item]) -> None:
        """Store the items."""
        chain = open_chain()
        assert isinstance(chain, EmbeddedChain)
        self.addresses = {name: chain.address(name) for name in ("Library", "Web", "Genesis", STUDIO)}
        self.evm = Instance()
        self.evm.hold(chain.codes())
        for item in stored:
            for each in item.transactions:
                answer = self.evm.send(self.addresses[STUDIO], each.data, GAS)
                assert answer.status == Status.SUCCESS, item.name

    def ask(self, site: bytes, path: str, **parameters: str) -> tuple[int, bytes, dict[str, str]]:
        """Return the response of a contract to a request (ERC-5219): status, body, headers."""
        # the body is bytes, which the ABI of the contracts calls text
        request = artifact("Web").interface.encode("request", path.split("/")[1:], list(parameters.items()))
        status, body, headers = decode(["uint16", "bytes", "(string,string)[]"], self.call(site, request))
        return status, body, dict(headers)

    def call(self, contract: bytes, data: bytes) -> bytes:
        """Return the result of a call. LookupError if it reverts."""
        answer = self.evm.call(contract, data, GAS)
        if answer.status != Status.SUCCESS:
            raise LookupError(describe_revert(answer.output))
        return answer.output

    def deploy(self, example: str) -> tuple[bytes, dict[str, bytes]]:
        """Deploy a contract whose constructor takes the library and the Studio; return its address and selectors."""
        creation, selectors = compile_example(example)
        parts = [self.addresses[name].rjust(32, b"\0") for name in ("Library", STUDIO)]
        answer = self.evm.deploy(creation + b"".join(parts), GAS)
        assert answer.status == Status.SUCCESS, example
        return answer.output, selectors

    def draw(self, scene: bytes) -> NDArray[np.uint8]:
        """Return the picture of an ABI-encoded scene, which may refer to stored meshes."""
        data = artifact(STUDIO).selectors["drawPNG"] + word(64) + word(1) + scene[32:]
        (png,) = decode(["bytes"], self.call(self.addresses[STUDIO], data))
        return pixels(png)


def pixels(png: bytes) -> NDArray[np.uint8]:
    """Decode a PNG file."""
    with PillowImage.open(io.BytesIO(png)) as opened:
        return np.asarray(opened)


def scenes(shelf: Shelf) -> list[bytes]:
    """Return the scenes of the example, ABI-encoded."""
    contract, selectors = shelf.deploy(EXAMPLE)

    def scene(function: str, value: Any) -> bytes:
        kind = function[function.index("(") + 1 : -1]
        return shelf.call(contract, selectors[function] + encode([kind], [value]))

    standing = [scene("onPedestal(string)", name) for name in ON_PEDESTALS]
    return [*standing, scene("inCompartments(string[3])", IN_COMPARTMENTS)]


def picture(shelf: Shelf, item: Item) -> NDArray[np.uint8]:
    """Return the picture of an item that is at its path."""
    folder = "icons" if item.is_icon else "objects"
    status, body, _ = shelf.ask(shelf.addresses["Web"], f"/{folder}/{item.name}.png", scale="1")
    assert status == 200, body
    return pixels(body)


def example_picture() -> PillowImage.Image:
    """Return the scenes of the example: the pedestals in a row, the compartments below."""
    shelf = Shelf(chosen_items((*ON_PEDESTALS, *IN_COMPARTMENTS)))
    *standing, compartments = [shelf.draw(scene) for scene in scenes(shelf)]
    return PillowImage.fromarray(np.vstack([np.hstack(standing), compartments]))


def main() -> None:
    """Draw the pictures."""
    shelf = Shelf(items())
    sheet = contact_sheet([picture(shelf, item) for item in items()], (item.name for item in items()), columns=8)
    sheet.save(IMAGES / "library.png", optimize=True)
    example_picture().save(IMAGES / "library-pedestal.png", optimize=True)


if __name__ == "__main__":
    main()
