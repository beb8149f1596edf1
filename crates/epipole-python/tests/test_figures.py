"""Figures in notebooks, as viewers without widgets show them."""

import base64
import struct

import pytest

pytest.importorskip("anywidget")

from epipole.figures import Figure, _assets  # noqa: E402

needs_pictures = pytest.mark.skipif(
    not (_assets.STATIC / "stills").is_dir(), reason="`make python-figures` writes the pictures"
)


def bundle(figure):
    """Text and picture, and the metadata of the picture."""
    data, metadata = figure._repr_mimebundle_()
    picture = data.get("image/png")
    return data["text/plain"], picture and base64.b64decode(picture), metadata.get("image/png")


@needs_pictures
def test_a_figure_that_was_never_on_a_page_has_a_picture():
    text, picture, metadata = bundle(Figure("ransac-race"))
    assert picture[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", picture[16:24])
    assert width >= 320
    assert height > 100
    assert text.startswith("Interactive figure ransac-race. ")
    assert _assets.still("ransac-race")[1] in text
    assert metadata == {"alt": text}


@needs_pictures
def test_every_figure_has_a_picture_of_its_own():
    names = _assets._words()
    assert len(names) >= 31
    pictures = {bundle(Figure(name))[1] for name in names}
    assert len(pictures) == len(names)
    assert all(pictures)


@needs_pictures
def test_text_names_parameters_that_differ_from_the_defaults():
    text, picture, _ = bundle(Figure("ransac-race", outliers=0.4))
    assert text.startswith("Interactive figure ransac-race, outliers=0.4. At its defaults: ")
    assert picture == _assets.still("ransac-race")[0]


def test_the_picture_of_the_page_holds_until_the_state_changes():
    race = Figure("ransac-race", outliers=0.4)
    race.description = "As it is on the page."
    race._on_message(race, {"kind": "picture", "state": {"outliers": "0.4"}}, [b"live"])
    text, picture, _ = bundle(race)
    assert picture == b"live"
    assert text == "Interactive figure ransac-race, outliers=0.4. As it is on the page."
    race.set(points=40)
    text, picture, _ = bundle(race)
    assert picture == _assets.still("ransac-race")[0]
    assert "As it is on the page" not in text


def test_an_unknown_figure_has_no_picture():
    text, picture, metadata = bundle(Figure("../words", seed=3))
    assert (text, picture, metadata) == ("Interactive figure ../words, seed=3.", None, None)


def test_state_is_text_and_hyphens_are_underscores():
    figure = Figure("ransac-race", min_samples=4, labels=True)
    assert figure.state == {"min-samples": "4", "labels": "true"}
    figure.set(labels=False)
    assert figure.state == {"min-samples": "4", "labels": "false"}
    figure.reset()
    assert figure.state == {}


def test_link_keeps_a_widget_and_a_parameter_equal():
    slider = pytest.importorskip("ipywidgets").FloatSlider(value=0.2)
    figure = Figure("ransac-race")
    unlink = figure.link("outliers", slider)
    slider.value = 0.5
    assert figure.state == {"outliers": "0.5"}
    figure.state = {"outliers": "0.3"}
    assert slider.value == 0.3
    unlink()
    slider.value = 0.7
    assert figure.state == {"outliers": "0.3"}
