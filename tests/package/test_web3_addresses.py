"""web3:// addresses, opened on a node by web3protocol, the client of browsers and gateways."""

from __future__ import annotations

import base64
import io
import json
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from PIL import Image as PillowImage
from tools.docs import draw_library
from tools.examples import compile_example
from tools.pages import IMAGES

from compiler import needs_compiler
from nodes import KEY, anvil, needs_anvil
from shackled import render
from shackled.chain import Connection
from shackled.datasets._pieces import require
from shackled.datasets.genesis import seed_of
from shackled.deploy import Deployer, Transactor, deployment, deployments, environment_account
from shackled.ethereum._encoding import checksum_address
from shackled.library import chosen_items
from shackled.scene._scene import Scene
from shackled.tokens import SceneToStore, plan_storage, store

HERE = Path(__file__).resolve().parent

pytestmark = [
    pytest.mark.skipif(
        not shutil.which("node") or not (HERE / "node_modules" / "web3protocol").is_dir(),
        reason="web3protocol is not installed: python tools/prepare.py node",
    ),
    needs_compiler,
    needs_anvil,
]


class Answer(NamedTuple):
    """What a browser gets."""

    status: int
    headers: dict[str, str]
    body: bytes


Fetch = Callable[..., list[Answer]]


@pytest.fixture(scope="module")
def fetch() -> Iterator[Fetch]:
    """Fetch addresses of a chain with the contracts, that of the example and an icon; {Web} stands for an address."""
    wanted = deployments(["Web"])
    addresses = {each.name: each.address.rjust(32, b"\0") for each in wanted}
    creation, _ = compile_example("examples/library/PedestalSite.sol")
    arguments = addresses["Library"] + addresses["Studio"]
    wanted.append(deployment("PedestalSite", creation + arguments, list(addresses)))
    (crown,) = chosen_items(["crown"])
    hosts = {each.name: f"web3://{checksum_address(each.address)}:31337" for each in wanted}
    with anvil() as node, pytest.MonkeyPatch.context() as patch:
        patch.setenv("SIGNER", KEY)
        connection = Connection(node.url)
        transactor = Transactor(connection, environment_account("SIGNER"))
        deployer = Deployer(connection)
        deployer.execute(deployer.plan(wanted), transactor)
        store(plan_storage(connection, [SceneToStore(crown.name, crown.scene)]), transactor)

        def get(*addresses: str) -> list[Answer]:
            command = ["node", str(HERE / "fetch_web3.mjs"), node.url, *(each.format(**hosts) for each in addresses)]
            said = map(json.loads, subprocess.check_output(command, text=True).splitlines())
            return [Answer(e["status"], e["headers"], base64.b64decode(e["body"], validate=True)) for e in said]

        yield get


def check_picture(answer: Answer, scene: Scene, scale: int) -> None:
    assert (answer.status, answer.headers["Content-Type"]) == (200, "image/png")
    with PillowImage.open(io.BytesIO(answer.body)) as opened:
        assert np.array_equal(np.asarray(opened), render(scene).pixels.repeat(scale, 0).repeat(scale, 1))


def test_pages_and_pictures(fetch: Fetch) -> None:
    (crown,) = chosen_items(["crown"])
    page, normal, small, piece = fetch(
        "{Web}/", "{Web}/icons/crown.png", "{Web}/icons/crown.png?scale=2", "{Web}/genesis/12.png"
    )
    assert (page.status, page.headers["Content-Type"]) == (200, "text/html")
    assert '<a href="/icons/crown.png">' in page.body.decode()
    check_picture(normal, crown.scene, 4)
    check_picture(small, crown.scene, 2)
    check_picture(piece, require("genesis/12").make(), 4)
    wrong = {"/icons/nothing.png": 404, "/icons/coin.png": 404, "/icons/crown.png?scale=9": 400}
    for answer, status in zip(fetch(*("{Web}" + path for path in wrong)), wrong.values(), strict=True):
        assert (answer.status, answer.headers) == (status, {"Content-Type": "text/plain"})
        assert answer.body.endswith(b".")


def test_the_auto_mode(fetch: Fetch) -> None:
    """The function and its arguments stand in the path; the type of the file does, too."""
    (crown,) = chosen_items(["crown"])
    pointer = checksum_address(crown.pointer)
    picture, model, bitmap, uri, same_model, same_picture = fetch(
        f"{{Studio}}/renderPNG/{pointer}/4?mime.type=png",
        f"{{Studio}}/glb/{pointer}?mime.type=glb",
        f"{{Genesis}}/render/0x{seed_of(12).hex()}?mime.type=bmp",
        f"{{Studio}}/renderDataURI/{pointer}/4",
        "{Web}/icons/crown.glb",
        "{Web}/icons/crown.png",
    )
    check_picture(picture, crown.scene, 4)
    assert model.headers == {"Content-Type": "model/gltf-binary"}
    assert model.body == same_model.body
    assert bitmap.headers == {"Content-Type": "image/bmp"}
    assert bitmap.body == render(require("genesis/12").make()).bmp
    # a string in place of bytes
    assert base64.b64decode(uri.body.decode("ascii").removeprefix("data:image/png;base64,")) == same_picture.body


def test_a_site_of_ones_own(fetch: Fetch) -> None:
    answer, page, missing = fetch("{PedestalSite}/crown", "{PedestalSite}/", "{PedestalSite}/gold")
    assert (answer.status, answer.headers) == (200, {"Content-Type": "image/png"})
    with (
        PillowImage.open(io.BytesIO(answer.body)) as opened,
        PillowImage.open(IMAGES / "library-pedestal.png") as shown,
    ):
        crown = np.asarray(shown)[:128, 128 * draw_library.ON_PEDESTALS.index("crown") :][:, :128]
        assert np.abs(np.asarray(opened)[::4, ::4].astype(int) - crown).mean() < 0.5
    assert '<a href="/teapot">' in page.body.decode()
    assert missing.status == 404
