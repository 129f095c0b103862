"""Checks of what is handed in, each with a message that says what was wrong and what would be right."""

from __future__ import annotations

import math
import operator
import re

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError


def number(value: object, name: str, low: float = -math.inf, high: float = math.inf) -> float:
    """`value` as a float within low..high."""
    try:
        result = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InputError(f"{name} must be a number, not {value!r}") from None
    if not math.isfinite(result) or not low <= result <= high:
        raise InputError(f"{name} must be a finite number{_range(low, high)}, not {value!r}")
    return result


def integer(value: object) -> int | None:
    """`value` as an int, if it is one of Python or NumPy; None for anything else, such as a truth value."""
    try:
        return None if isinstance(value, bool | np.bool_) else operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        return None


def instance(value: object, name: str, kind: type) -> None:
    """InputError unless `value` is of a class of the package."""
    if not isinstance(value, kind):
        raise InputError(f"{name} must be a shackled.{kind.__name__}, not {value!r:.60}")


def vector(value: ArrayLike, name: str, size: int = 3) -> NDArray[np.float64]:
    """`value` as a new array of `size` finite floats."""
    try:
        result = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{name} must be {size} numbers, not {value!r}") from None
    if result.shape != (size,) or not np.isfinite(result).all():
        raise InputError(f"{name} must be {size} finite numbers, not {value!r}")
    return result


def channels(values: ArrayLike) -> ArrayLike:
    """Colours as numbers 0..255. Floats none of which is above 1 are shares of 255; anything else stays as it is."""
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):
        return values
    if array.dtype.kind == "f" and array.size and ((array >= 0) & (array <= 1)).all():
        return np.asarray(np.rint(255.0 * array))
    return values


def color(value: ArrayLike, name: str) -> tuple[int, int, int]:
    """Red, green and blue, whole numbers 0..255, or floats 0..1; or a string "#rrggbb" of them."""
    if isinstance(value, str):
        if not re.fullmatch("#[0-9a-fA-F]{6}", value):
            raise InputError(f"{name} must be red, green and blue from 0 to 255, or #rrggbb, not {value!r}")
        return int(value[1:3], 16), int(value[3:5], 16), int(value[5:7], 16)
    levels = vector(channels(value), name)
    if (levels < 0).any() or (levels > 255).any() or (levels % 1 != 0).any():
        raise InputError(f"{name} must be red, green and blue from 0 to 255, not {value!r}")
    red, green, blue = (int(level) for level in levels)
    return red, green, blue


def choice(value: object, name: str, choices: tuple[str, ...]) -> str:
    """`value`, if it is one of `choices`."""
    if value not in choices:
        raise InputError(f"{name} must be one of {', '.join(choices)}, not {value!r}")
    return str(value)


def _range(low: float, high: float) -> str:
    if low == -math.inf and high == math.inf:
        return ""
    if high == math.inf:
        return f", at least {low:g}"
    if low == -math.inf:
        return f", at most {high:g}"
    return f" from {low:g} to {high:g}"
