"""Checks of arguments, each with a message that says what is wrong and what would be right."""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Iterable
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InputError

Number = TypeVar("Number", bound=np.generic)
Kind = TypeVar("Kind")
#: Arrays of numbers; those of values cannot be written to.
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]
#: What a colour is written as.
COLORS = "red, green and blue from 0 to 255, #rgb, #rrggbb, or the name of a colour"
#: Red, green and blue, 0..255.
Color = tuple[int, int, int]


def number(value: object, name: str = "a value", low: float = -math.inf, high: float = math.inf) -> float:
    """Return `value` as a float within low..high. InputError for anything else."""
    try:
        result = float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise InputError(f"{name} must be a number, not {value!r:.60}") from None
    if not math.isfinite(result) or not low <= result <= high:
        raise InputError(f"{name} must be a finite number{_range(low, high)}, not {value!r:.60}")
    return result


def optional_number(value: object, name: str = "a value", low: float = -math.inf) -> float | None:
    """Return None for None, and otherwise the result of `number`."""
    return None if value is None else number(value, name, low)


def integer(value: object) -> int | None:
    """Return `value` as an int, if it is one of Python or NumPy; None for anything else, such as a truth value."""
    try:
        return None if isinstance(value, bool | np.bool_) else operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        return None


def whole(value: object, name: str = "a value", low: float = -math.inf, high: float = math.inf) -> int:
    """Return `value` as an int within low..high; 12.0 is one too, 12.5 is not. InputError for anything else."""
    is_float = isinstance(value, float | np.floating)
    found = int(value) if is_float and value % 1 == 0 else integer(value)  # type: ignore[call-overload, operator]
    if found is None or not low <= found <= high:
        raise InputError(f"{name} must be a whole number{_range(low, high)}, not {value!r:.60}")
    return int(found)


def flag(value: object, name: str = "a flag") -> bool:
    """Return `value` as a bool, if it is one of Python or NumPy, or 0 or 1. InputError for anything else."""
    if isinstance(value, bool | np.bool_) or integer(value) in (0, 1):
        return bool(value)
    raise InputError(f"{name} must be True or False, not {value!r:.60}")


def instance(value: object, name: str, kind: type[Kind]) -> Kind:
    """Return `value`, if it is an instance of a class of the package. InputError for anything else."""
    if not isinstance(value, kind):
        raise InputError(f"{name} must be a shackled.{kind.__name__}, not {value!r:.60}")
    return value


def fixed(value: ArrayLike, dtype: type[Number]) -> NDArray[Number]:
    """Return `value` as a read-only array of any shape: a copy, unless it is one already that owns its numbers.

    TypeError, ValueError or OverflowError if it cannot be one.
    """
    if isinstance(value, np.ndarray) and value.dtype == dtype:
        flags = value.flags
        if flags.owndata and flags.c_contiguous and not flags.writeable:
            return value
    array = np.array(value, dtype=dtype, order="C")
    array.flags.writeable = False
    return array


def vector(value: ArrayLike, name: str = "a vector", size: int = 3) -> Floats:
    """Return `value` as a read-only array of `size` finite floats. InputError for anything else."""
    try:
        result = fixed(value, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be {size} numbers, not {value!r:.60}") from None
    if result.shape != (size,) or not np.isfinite(result).all():
        raise InputError(f"{name} must be {size} finite numbers, not {value!r:.60}")
    return result


def optional_vector(value: ArrayLike | None, name: str = "a vector", size: int = 3) -> Floats | None:
    """Return None for None, and otherwise the result of `vector`."""
    return None if value is None else vector(value, name, size)


def channels(values: ArrayLike) -> ArrayLike:
    """Return colours as numbers 0..255. Floats none of which is above 1 are shares of 255; others stay as they are."""
    try:
        array = np.asarray(values)
    except (TypeError, ValueError):
        return values
    if array.dtype.kind == "f" and array.size and ((array >= 0) & (array <= 1)).all():
        return np.asarray(np.rint(255.0 * array))
    return values


def color(value: ArrayLike | str, name: str = "a colour") -> Color:
    """Return red, green and blue, 0..255, of an opaque colour as `rgba` takes it. InputError for anything else."""
    *levels, alpha = rgba(value, name)
    if alpha != 255:
        raise InputError(f"{name} must be opaque, not {value!r:.60}; an Object has an opacity")
    red, green, blue = levels
    return red, green, blue


def rgba(value: ArrayLike | str, name: str = "a colour") -> tuple[int, int, int, int]:
    """Return red, green, blue and alpha, 0..255, of a colour; it is opaque where it does not say otherwise.

    value: 3 or 4 whole numbers 0..255 or floats 0..1, "#rgb", "#rgba", "#rrggbb", "#rrggbbaa", or a name of CSS, such
        as "tomato". InputError for anything else.
    """
    if isinstance(value, str):
        return _rgba_of_text(value, name)
    try:
        levels = np.array(channels(value), dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        levels = np.zeros(0)
    if levels.shape not in ((3,), (4,)) or not ((levels >= 0) & (levels <= 255) & (levels % 1 == 0)).all():
        raise InputError(f"{name} must be red, green and blue from 0 to 255, not {value!r:.60}")
    red, green, blue, alpha = (int(level) for level in (*levels, 255)[:4])
    return red, green, blue, alpha


def _rgba_of_text(text: str, name: str) -> tuple[int, int, int, int]:
    from PIL import ImageColor

    word = text.strip().lower()
    known = "#0000" if word == "transparent" else ImageColor.colormap.get(word, word)
    digits = known if isinstance(known, str) else "#{:02x}{:02x}{:02x}".format(*known)
    if not re.fullmatch("#[0-9a-f]{3,4}|#?[0-9a-f]{6}|#[0-9a-f]{8}", digits):
        raise InputError(f"{name} must be {COLORS}, not {text!r:.60}")
    digits = digits.removeprefix("#")
    if len(digits) < 6:
        digits = "".join(2 * digit for digit in digits)
    red, green, blue, alpha = bytes.fromhex(digits.ljust(8, "f"))
    return red, green, blue, alpha


def choice(value: object, name: str = "a word", choices: Iterable[str] = ()) -> str:
    """Return `value`, if it is one of `choices`. InputError for anything else."""
    if value not in (known := tuple(choices)):
        raise InputError(f"{name} must be one of {', '.join(known)}, not {value!r:.60}")
    return str(value)


def _range(low: float, high: float) -> str:
    if low == -math.inf and high == math.inf:
        return ""
    least, most = (str(limit) if isinstance(limit, int) else f"{limit:g}" for limit in (low, high))
    if high == math.inf:
        return f", at least {least}"
    if low == -math.inf:
        return f", at most {most}"
    return f" from {least} to {most}"
