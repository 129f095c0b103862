import pytest
from PIL import Image

from shackled.scene._texture import sample

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)


def checker() -> Image.Image:
    """Red and green above, blue and white below."""
    image = Image.new("RGB", (2, 2))
    for place, color in zip([(0, 0), (1, 0), (0, 1), (1, 1)], [RED, GREEN, BLUE, WHITE], strict=True):
        image.putpixel(place, color)
    return image


@pytest.mark.parametrize(
    ("coordinates", "expected"),
    [
        ([[0, 1], [1, 1], [0, 0], [1, 0]], [RED, GREEN, BLUE, WHITE]),
        # between texels, and beyond the borders, where the image repeats
        ([[0.5, 1], [0.5, 0.5]], [(128, 128, 0), (128, 128, 128)]),
        ([[1.75, 1.75], [-1, 3]], [GREEN, BLUE]),
        ([[float("nan"), float("inf")]], [BLUE]),
    ],
)
def test_samples(coordinates: list[list[float]], expected: list[tuple[int, ...]]) -> None:
    assert sample(checker(), coordinates).tolist() == [list(color) for color in expected]


def test_palettes_and_greys_are_read() -> None:
    assert sample(Image.new("L", (1, 1), 77), [[0.3, 0.3]]).tolist() == [[77, 77, 77]]
    assert sample(checker().convert("P"), [[0, 1]]).tolist() == [list(RED)]
