"""Fit linear functions to measurements."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Column = NDArray[np.float64]


class LinearFit(NamedTuple):
    """Least squares: gas = sum of coefficients times columns; the first coefficient is the constant.

    r2: the share of the variance that the fit explains.
    """

    coefficients: list[float]
    r2: float


def fit(columns: Sequence[ArrayLike], gas: ArrayLike) -> LinearFit:
    """Fit a linear function with a constant by least squares."""
    values = np.asarray(gas, np.float64)
    matrix = np.stack([np.ones_like(values), *(np.asarray(column, np.float64) for column in columns)], axis=1)
    scale = np.abs(matrix).max(axis=0)
    solution = np.linalg.lstsq(matrix / scale, values, rcond=None)[0]
    rest, around = values - matrix / scale @ solution, values - values.mean()
    return LinearFit((solution / scale).tolist(), float(1 - (rest @ rest) / (around @ around)))


def quadratic_share(columns: list[Column], gas: Column) -> float:
    """Return the share of the gas of the last scene that a term with the square of the first column takes in a fit."""
    with_square = fit([*columns, columns[0] ** 2], gas)
    return float(with_square.coefficients[-1] * columns[0][-1] ** 2 / gas[-1])
