import numpy as np
import pytest
from attrs import evolve

from shackled import Object, Scene, render
from shackled.datasets import Piece
from shackled.datasets.common.shapes import joined
from shackled.datasets.icons import _icons
from shackled.datasets.icons import pieces as icons
from shackled.datasets.icons._icons import CREASE
from shackled.scene._mesh import Mesh
from shackled.scene._staging import is_closed

#: EIP-7825.
TRANSACTION_GAS = 2**24
#: All that were wanted.
WANTED = """ethereum coin chain shackle padlock key diamond rocket crown skull heart lightning block hourglass crystals
    head glasses bell trophy mushroom cactus cat robot planet sword"""


def test_there_are_all_that_were_wanted() -> None:
    pieces = {piece.name: piece for piece in icons()}
    assert {f"icons/{name}" for name in WANTED.split()} <= pieces.keys()
    assert len(pieces) == len(icons()) == 28
    assert {piece.dataset for piece in icons()} == {"icons"}
    assert {piece.name: piece.licence for piece in icons() if piece.licence != "MIT"} == {"icons/glasses": "CC0"}
    assert all(piece.commercial and piece.title for piece in icons())


@pytest.mark.parametrize("icon", icons(), ids=lambda icon: icon.name)
def test_icon(icon: Piece) -> None:
    scene = icon.make()
    mesh = joined(*(Mesh(o.mesh.positions, o.mesh.faces, o.mesh.colors) for o in scene.objects))
    positions, faces = mesh.positions, mesh.faces
    assert 20 <= len(faces) <= 600
    # closed, so that culling is right
    assert is_closed(mesh)
    assert all(o.cull for o in scene.objects)
    # whole numbers of 16 bits, and no triangle without an area
    assert (positions % 1 == 0).all()
    assert np.abs(positions).max() < 2**15
    a, b, c = positions[faces].transpose(1, 0, 2)
    heights = np.linalg.norm(np.cross(b - a, c - a), axis=1) / np.linalg.norm([b - a, c - b, a - c], axis=2).max(axis=0)
    assert heights.min() > 1e-4 * np.ptp(positions, axis=0).max()
    assert len(np.unique(mesh.colors, axis=0)) >= (1 if icon.name in {"icons/heart", "icons/key"} else 2)
    image = render(scene, size=128)
    assert (image.gas or 0) + (image.intrinsic_gas or 0) <= TRANSACTION_GAS
    count = image.covered_pixels or 0
    assert 0.08 < count / 128**2 < 0.85
    # it fills the picture in one direction, leaves a margin in all, and stands out from the background
    covered = np.abs(image.pixels.astype(int) - image.pixels[:, :1]).max(axis=2) > 24
    rows, columns = np.nonzero(covered)
    assert max(np.ptp(rows), np.ptp(columns)) > 112
    assert min(rows.min(), columns.min()) >= 2
    assert max(rows.max(), columns.max()) <= 125
    assert covered.sum() > 0.9 * count


def test_splitting_and_sorting_do_not_change_a_picture() -> None:
    scene = next(icon for icon in icons() if icon.name == "icons/padlock").make()
    smooth: Object = next(o for o in scene.objects if o.material.shading == "smooth")
    assert sorted(o.material.shading for o in scene.objects) == ["flat", "smooth"]
    one: Scene = evolve(scene, objects=[evolve(smooth, mesh=_icons.padlock().mesh(CREASE))])
    cheap, plain = render(scene), render(one)
    assert (cheap.gas or 0) < (plain.gas or 0)
    difference = np.abs(cheap.pixels.astype(int) - plain.pixels).max(axis=2)
    # the shading differs by roundings; a few pixels where parts meet may go to the other part
    assert (difference > 8).mean() < 0.005
