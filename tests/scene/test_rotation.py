import numpy as np
import pytest

from shackled.errors import InputError
from shackled.scene import from_euler, rotate
from shackled.scene._arithmetic import from_axis_angle

X, Y, Z = np.eye(3)


def test_euler_angles_equal_the_product_of_matrices() -> None:
    a, b, c = np.radians([20, -75, 130])
    about_x = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]])
    about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    about_z = np.array([[np.cos(c), -np.sin(c), 0], [np.sin(c), np.cos(c), 0], [0, 0, 1]])
    np.testing.assert_allclose(rotate(from_euler((20, -75, 130)), np.eye(3)).T, about_z @ about_y @ about_x, atol=1e-12)


def test_whole_turns_are_none() -> None:
    assert from_euler((360, -720, 0)).tolist() == [0, 0, 0, 1]


def test_axis_and_quaternion_of_any_length() -> None:
    rotation = from_axis_angle((0, 0, 7), 90)
    np.testing.assert_allclose(rotate(1e9 * rotation, [[1, 0, 0], [0, 1, 5]]), [[0, 1, 0], [-1, 0, 5]], atol=1e-12)


def test_zero_is_refused() -> None:
    with pytest.raises(InputError, match=r"^the axis of a rotation must not be zero$"):
        from_axis_angle((0, 0, 0), 3)
    with pytest.raises(InputError, match=r"^a rotation must not be the zero quaternion; the identity is"):
        rotate((0, 0, 0, 0), X)
