import numpy as np
import pytest

from shackled import Scene, render
from shackled.datasets.icons import pieces as icons
from shackled.datasets.icons._collection import ICONS, find
from shackled.datasets.icons._icon import IconModel
from shackled.scene import Mesh, is_closed
from shackled.scene._staging import signed_volume

#: EIP-7825.
TRANSACTION_GAS = 2**24

WANTED = {
    "ethereum",
    "coin",
    "chain",
    "shackle",
    "padlock",
    "key",
    "diamond",
    "rocket",
    "crown",
    "skull",
    "heart",
    "lightning",
    "block",
    "hourglass",
    "crystals",
    "head",
    "glasses",
    "bell",
    "trophy",
    "mushroom",
    "cactus",
    "cat",
    "robot",
    "planet",
    "sword",
}


def whole(scene: Scene) -> Mesh:
    """The meshes of a scene as one."""
    meshes = [o.mesh for o in scene.objects]
    starts = np.cumsum([0, *(len(mesh.positions) for mesh in meshes)])
    return Mesh(
        np.vstack([mesh.positions for mesh in meshes]),
        np.vstack([mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)]),
        np.vstack([mesh.colors for mesh in meshes]),
    )


def test_there_are_all_that_were_wanted() -> None:
    pieces = list(icons())
    names = [piece.name for piece in pieces]
    assert len(names) == len(set(names)) >= 24
    assert {f"icons/{name}" for name in WANTED} <= set(names)
    assert {piece.dataset for piece in pieces} == {"icons"}
    assert {piece.name: piece.licence for piece in pieces if piece.licence != "MIT"} == {"icons/glasses": "CC0"}
    assert all(piece.commercial and piece.title for piece in pieces)


def test_finding() -> None:
    piece = find("diamond")
    assert piece is not None
    assert (piece.name, piece.title) == ("icons/diamond", "Diamond")
    assert isinstance(piece.make(), Scene)
    assert find("icons/diamond") is None
    assert find("unicorn") is None


@pytest.mark.parametrize("icon", ICONS, ids=lambda icon: icon.name)
def test_model(icon: IconModel) -> None:
    scene = icon.scene()
    mesh = whole(scene)
    positions, faces = mesh.positions, mesh.faces
    assert 20 <= len(faces) <= 600
    # closed, so that culling is right
    assert is_closed(mesh)
    assert all(o.cull for o in scene.objects)
    assert signed_volume(mesh) > 0
    # whole numbers of 16 bits, and no triangle without an area
    assert (positions % 1 == 0).all()
    assert np.abs(positions).max() < 2**15
    a, b, c = positions[faces].transpose(1, 0, 2)
    heights = np.linalg.norm(np.cross(b - a, c - a), axis=1) / np.linalg.norm([b - a, c - b, a - c], axis=2).max(axis=0)
    assert heights.min() > 1e-4 * np.ptp(positions, axis=0).max()
    assert len(np.unique(mesh.colors, axis=0)) >= (1 if icon.name in {"heart", "key"} else 2)


@pytest.mark.parametrize("icon", ICONS, ids=lambda icon: icon.name)
def test_picture(icon: IconModel) -> None:
    image = render(icon.scene(), size=128)
    assert image.gas is not None
    assert image.intrinsic_gas is not None
    assert image.covered_pixels is not None
    assert image.gas + image.intrinsic_gas <= TRANSACTION_GAS
    assert 0.08 < image.covered_pixels / 128**2 < 0.85
    # it fills the picture in one direction, leaves a margin in all, and stands out from the background
    covered = np.abs(image.pixels.astype(int) - image.pixels[:, :1]).max(axis=2) > 24
    rows, columns = np.flatnonzero(covered.any(axis=1)), np.flatnonzero(covered.any(axis=0))
    assert max(np.ptp(rows), np.ptp(columns)) > 112
    assert 2 <= rows.min() <= rows.max() <= 125
    assert 2 <= columns.min() <= columns.max() <= 125
    assert covered.sum() > 0.9 * image.covered_pixels


def test_splitting_and_sorting_do_not_change_a_picture() -> None:
    icon = next(icon for icon in ICONS if icon.name == "padlock")
    scene = icon.scene()
    assert [o.material.shading for o in scene.objects] in (["flat", "smooth"], ["smooth", "flat"])
    mesh = icon.model().mesh(icon.crease)
    smooth = next(o for o in scene.objects if o.material.shading == "smooth")
    one = Scene(
        [type(smooth)(mesh, smooth.position, smooth.rotation, smooth.scale, smooth.material)],
        scene.camera,
        scene.lights,
        scene.background,
    )
    cheap, plain = render(scene), render(one)
    assert cheap.gas is not None
    assert plain.gas is not None
    assert cheap.gas < plain.gas
    difference = np.abs(cheap.pixels.astype(int) - plain.pixels).max(axis=2)
    # the shading differs by roundings; a few pixels where parts meet may go to the other part
    assert (difference > 8).mean() < 0.005
