from PIL import Image

from shackled.scene._texture import sample

RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)


def checker() -> Image.Image:
    """Red and green above, blue and white below."""
    image = Image.new("RGB", (2, 2))
    for place, color in zip([(0, 0), (1, 0), (0, 1), (1, 1)], [RED, GREEN, BLUE, WHITE], strict=True):
        image.putpixel(place, color)
    return image


def test_corners_of_the_image_are_its_corner_texels() -> None:
    assert sample(checker(), [[0, 1], [1, 1], [0, 0], [1, 0]]).tolist() == [list(c) for c in (RED, GREEN, BLUE, WHITE)]


def test_between_texels_colors_are_mixed() -> None:
    assert sample(checker(), [[0.5, 1]]).tolist() == [[128, 128, 0]]
    assert sample(checker(), [[0.5, 0.5]]).tolist() == [[128, 128, 128]]


def test_beyond_its_borders_the_image_repeats() -> None:
    assert sample(checker(), [[1.1, 0.1], [-0.9, 3.1]]).tolist() == sample(checker(), [[0.1, 0.1], [0.1, 0.1]]).tolist()


def test_what_is_no_number_does_no_harm() -> None:
    assert sample(checker(), [[float("nan"), float("inf")]]).tolist() == [list(BLUE)]


def test_palettes_and_greys_are_read() -> None:
    assert sample(Image.new("L", (1, 1), 77), [[0.3, 0.3]]).tolist() == [[77, 77, 77]]
    assert sample(checker().convert("P"), [[0, 1]]).tolist() == [list(RED)]
