"""Fixed-point numbers in errors of the contracts, as their authors write them: 35 instead of 150323855360."""

from __future__ import annotations

import re

#: Fractional bits of the quantities in errors; of other errors the numbers are whole, or their scale is the fault.
BITS = {
    **dict.fromkeys(("HalfHeightOutOfRange", "NearOutOfRange", "CameraOutOfRange", "LightOutOfRange"), 32),
    **dict.fromkeys(("CoefficientOutOfRange", "ScaleOutOfRange", "RotationOutOfRange", "SpotOutOfRange"), 32),
    **dict.fromkeys(("SpotAngles", "FogOutOfRange", "GroundOutOfRange", "AngleOutOfRange"), 32),
    **dict.fromkeys(("SpotAnglesOutOfRange", "FieldOfViewOutOfRange", "HeightOutOfRange"), 32),
    "OpacityOutOfRange": 24,
    "ExposureOutOfRange": 16,
}
ERROR = re.compile(r"(\w+)\((.*)\)", re.DOTALL)
QUANTITY = re.compile(r"\b(?!object=|light=)(\w+=)(-?\d+)\b")


def in_units(error: str) -> str:
    """Return an error, such as "FogOutOfRange(near=4294967296, far=0)", with its quantities in units."""
    match = ERROR.fullmatch(error)
    bits = BITS.get(match[1], 0) if match else 0
    # the error of the scene builder, which has no object, has whole units
    if error.startswith("PositionOutOfRange(object="):
        bits = 32
    return QUANTITY.sub(lambda found: f"{found[1]}{int(found[2]) / (1 << bits):.12g}", error) if bits else error
