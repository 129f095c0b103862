import numpy as np
import pytest

from shackled.datasets.icons import modelling as m
from shackled.datasets.icons import outlines
from shackled.errors import InputError
from shackled.scene._staging import is_closed

SQUARE = [(0, 0), (2, 0), (2, 2), (0, 2)]
#: A comb of two teeth: concave, and clockwise.
COMB = [(0, 0), (0, 3), (1, 3), (1, 1), (2, 1), (2, 3), (3, 3), (3, 0)]


def circle_part(segments: int) -> float:
    """What a regular polygon has of the area of the circle around it."""
    return float(np.sin(2 * np.pi / segments) * segments / 2 / np.pi)


@pytest.mark.parametrize("outline", [SQUARE, COMB, outlines.star(7, 1, 0.3), outlines.stroke(COMB[:4], 0.3)])
def test_triangles_of_a_polygon_cover_it_and_run_alike(outline: list[tuple[float, float]]) -> None:
    triangles = outlines.triangulate(outline)
    assert len(triangles) == len(outline) - 2
    areas = [outlines.area(np.asarray(outline)[list(triangle)]) for triangle in triangles]
    assert np.sign(areas).tolist() == [np.sign(outlines.area(outline))] * len(areas)
    assert sum(areas) == pytest.approx(outlines.area(outline))


def test_outlines() -> None:
    assert outlines.area(COMB) == -7
    assert outlines.area(outlines.counter_clockwise(COMB)) == 7
    assert outlines.area(outlines.star(4, 2**0.5, 1, 45)) == pytest.approx(4)
    assert outlines.inset(SQUARE, 0.25).tolist() == [[0.25, 0.25], [1.75, 0.25], [1.75, 1.75], [0.25, 1.75]]
    # a perimeter of 16, and six corners outward, two inward
    assert outlines.area(outlines.inset(COMB, 0.1)) == pytest.approx(7 - 16 * 0.1 + 4 * 0.1**2)
    corner = outlines.stroke([(0, 0), (4, 0), (4, 4)], 1)
    assert outlines.area(corner) == pytest.approx(8)
    assert [4.5, -0.5] in corner.tolist()
    with pytest.raises(InputError, match="crosses itself"):
        outlines.triangulate([(0, 0), (2, 2), (2, 0), (0, 2)])


@pytest.mark.parametrize(
    ("solid", "volume", "triangles"),
    [
        (m.box(1, 2, 3), 6, 12),
        (m.bevelled_box(2, 2, 2, 0.5), 8 - 12 * 0.125 * 2 + 8 * (0.125 - 0.5**3 / 6 * 2), 44),
        (m.prism(COMB, 2), 14, 28),
        (m.prism(SQUARE, 1, 0.2), 4 * 0.6 + 2 * 0.2 * (4 + 1.6**2 + 2 * 1.6) / 3, 28),
        (m.cylinder(2, 3, 32), 3 * 4 * np.pi * circle_part(32), 124),
        (m.cylinder(2, 3, 32, top=1), 3 * np.pi * circle_part(32) * (4 + 2 + 1) / 3, 124),
        (m.cone(1, 3, 24), np.pi * circle_part(24), 46),
        (m.revolve([(0, -1), (1, 0), (0, 1)], 4), 4 / 3, 8),
        (m.torus(3, 1, 64, 32), 2 * np.pi * 3 * np.pi * circle_part(64) * circle_part(32), 4096),
        (m.tube([(0, 0, 0), (0, 5, 0)], 1, 8), 5 * np.pi * circle_part(8), 28),
        (m.sweep(SQUARE, [(0, 0, 0), (0, 0, 3)], scales=[1, 0]), 4, 6),
        (m.pixels(["ab", "aa"], {"a": "#ff0000", "b": "#00ff00"}, 2), 8, 36),
    ],
)
def test_volumes_of_closed_solids(solid: m.Solid, volume: float, triangles: int) -> None:
    assert len(solid.corners) == triangles
    assert solid.volume() == pytest.approx(volume, rel=1e-9)
    assert is_closed(solid.mesh())


def test_round_solids_are_closed_and_of_their_size() -> None:
    for ball, triangles in ((m.sphere(2, 32, 16), 2 * 32 * 15), (m.icosphere(2, 3), 20 * 64)):
        assert len(ball.corners) == triangles
        np.testing.assert_allclose(np.linalg.norm(ball.corners, axis=2), 2)
        assert ball.volume() == pytest.approx(4 / 3 * np.pi * 8, rel=0.02)
        assert is_closed(ball.mesh())
    link = m.link(4, 2, 0.25, 12, 12)
    assert len(link.corners) == 2 * 26 * 12
    np.testing.assert_allclose(np.ptp(link.corners, axis=(0, 1)), (4.5, 2.5, 0.5), atol=0.03)
    assert link.volume() == pytest.approx((4 + 2 * np.pi) * np.pi * 0.25**2 * circle_part(12), rel=0.01)
    assert is_closed(link.mesh())


def test_moving() -> None:
    box = m.box(2, 2, 2)
    assert box.moved(1, 2, 3).corners.mean(axis=(0, 1)) == pytest.approx([1, 2, 3])
    turned = m.box(6, 4, 2).turned(z=90)
    np.testing.assert_allclose(np.ptp(turned.corners, axis=(0, 1)), (4, 6, 2), atol=1e-12)
    assert box.scaled(2, 3, -1).volume() == pytest.approx(48)
    assert box.moved(x=3).mirrored().corners[..., 0].max() == -2
    assert m.both(box.moved(x=3)).volume() == pytest.approx(16)
    ring = m.around(box.moved(x=3), 4, start=90)
    assert ring.corners.mean(axis=(0, 1)) == pytest.approx([0, 0, 0])
    assert len(ring.corners) == 48


def test_painting() -> None:
    box = m.box(2, 2, 2).painted("#102030").painted((255, 0, 0), m.above(0.9))
    top = (box.corners[..., 1] > 0.9).all(axis=1)
    assert top.sum() == 2
    assert (box.colors[top] == (255, 0, 0)).all()
    assert (box.colors[~top] == (16, 32, 48)).all()
    shaded = m.box(2, 2, 2).shaded("#000000", "#ff8000")
    assert (shaded.colors[shaded.corners[..., 1] == 1] == (255, 128, 0)).all()
    assert (shaded.colors[shaded.corners[..., 1] == -1] == 0).all()
    # vertices are shared where colours are equal, and are whole numbers
    assert len(m.box(1, 1, 1).mesh().positions) == 8
    two = m.box(1, 1, 1).painted("#ff0000", m.above(0.4)).mesh()
    assert len(two.positions) == 12
    assert np.abs(two.positions).max() == m.STEPS / 2


def test_creases() -> None:
    can = m.cylinder(1, 2, 16)
    sharp = can.mesh(crease=30)
    positions, normals = sharp.positions, np.asarray(sharp.normals)
    assert len(positions) == 64  # each rim twice: for the side and for the end
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-6)
    side = np.abs(normals[:, 1]) < 0.5
    np.testing.assert_allclose(normals[side][:, [0, 2]], positions[side][:, [0, 2]] / m.STEPS, atol=1e-3)
    np.testing.assert_allclose(np.abs(normals[~side]), [(0, 1, 0)] * 32, atol=1e-6)
    assert len(can.mesh(crease=10).positions) == 16 * 4 + 32
    assert len(can.mesh(crease=100).positions) == 32
