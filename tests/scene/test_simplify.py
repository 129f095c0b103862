import numpy as np
import pytest
from attrs import evolve

from shackled.datasets import teapot
from shackled.datasets.common import shapes
from shackled.errors import InputError
from shackled.scene._mesh import Mesh
from shackled.scene._simplify import simplify
from shackled.scene._staging import is_closed, signed_volume


def sphere() -> Mesh:
    """A closed sphere of 2,112 triangles, red above and blue below."""
    ball = shapes.sphere(48, 23)
    return evolve(ball, colors=np.where(ball.positions[:, 1:2] > 0, (255, 0, 0), (0, 0, 255)))


@pytest.mark.parametrize("is_loose", [False, True])
def test_shape_and_colours_stay(is_loose: bool) -> None:
    """Also where triangles have no vertices in common."""
    whole = sphere()
    assert is_closed(whole)
    corners = whole.faces.reshape(-1)
    loose = Mesh(whole.positions[corners], np.arange(len(corners)).reshape(-1, 3), whole.colors[corners])
    small = simplify(loose if is_loose else whole, 300)
    assert 250 <= len(small.faces) <= 300
    assert signed_volume(small) == pytest.approx(signed_volume(whole), rel=0.05)
    assert is_closed(small)
    assert small.normals is None
    heights = small.positions[:, 1]
    assert (small.colors[heights > 0.1] == (255, 0, 0)).all()
    assert (small.colors[heights < -0.1] == (0, 0, 255)).all()


def test_a_vertex_takes_the_colour_of_the_nearest() -> None:
    """Not of any of those that became one: a gradient over a sphere is still one."""
    whole = sphere()
    height = whole.positions[:, 1]
    levels = np.rint(127.5 + 127.5 * height / np.abs(height).max())
    small = simplify(Mesh(whole.positions, whole.faces, np.stack([levels] * 3, axis=1).astype(np.uint8)), 100)
    expected = 127.5 + 127.5 * small.positions[:, 1] / np.abs(height).max()
    assert np.abs(small.colors[:, 0] - expected).max() < 12


@pytest.mark.parametrize("limit", [1000, 200, 60])
def test_the_limit_holds(limit: int) -> None:
    small = simplify(teapot(6), limit)
    assert limit * 0.8 <= len(small.faces) <= limit


@pytest.mark.parametrize("limit", [0, -3, 1.5, True])
def test_limits_that_are_none(limit: int) -> None:
    with pytest.raises(
        InputError, match=r"^the number of triangles to simplify to must be a whole number, at least 1, "
    ):
        simplify(sphere(), limit)


def test_what_cannot_be_simplified_so_far() -> None:
    with pytest.raises(InputError, match=r"^a mesh of 2112 triangles cannot be simplified to 1: "):
        simplify(sphere(), 1)
    with pytest.raises(InputError, match=r"^a mesh of 2112 triangles cannot be simplified to 400: [4-9]\d\d remain$"):
        simplify(sphere(), 400, [(3, 1.0)])


def test_where_the_package_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shackled.scene._simplify.find_spec", lambda name: None)
    pot = teapot(2)
    assert simplify(pot, 10_000) is pot
    with pytest.raises(InputError, match="needs the package fast-simplification, which is not installed"):
        simplify(pot, 20)
