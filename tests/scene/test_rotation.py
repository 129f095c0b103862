import numpy as np
import pytest
from numpy.typing import NDArray

from shackled.errors import InputError
from shackled.scene import from_euler, rotate
from shackled.scene._arithmetic import from_axis_angle, multiply

X, Y, Z = np.eye(3)


@pytest.mark.parametrize(
    ("degrees", "point", "turned"),
    [((90, 0, 0), Y, Z), ((0, 90, 0), Z, X), ((0, 0, 90), X, Y), ((90, 90, 0), Y, X), ((90, 0, 90), X, Y)],
)
def test_euler_angles_turn_counterclockwise_about_x_then_y_then_z(
    degrees: tuple[float, float, float], point: NDArray[np.float64], turned: NDArray[np.float64]
) -> None:
    np.testing.assert_allclose(rotate(from_euler(degrees), point), turned, atol=1e-12)


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


def test_multiply_does_the_second_after_the_first() -> None:
    first, second = from_axis_angle(X, 90), from_axis_angle(Z, 90)
    np.testing.assert_allclose(rotate(multiply(second, first), Y), rotate(second, rotate(first, Y)), atol=1e-12)


def test_zero_is_refused() -> None:
    with pytest.raises(InputError, match=r"^the axis of a rotation must not be zero$"):
        from_axis_angle((0, 0, 0), 3)
    with pytest.raises(InputError, match=r"^a rotation must not be the zero quaternion; the identity is"):
        rotate((0, 0, 0, 0), X)
