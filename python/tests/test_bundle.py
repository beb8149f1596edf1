"""What viewers without widgets are given."""

import base64
import struct
import unittest

from epipole_figures import Figure, _assets


def bundle(figure):
    """Words and picture, and what is said of the picture."""
    data, metadata = figure._repr_mimebundle_()
    picture = data.get("image/png")
    return data["text/plain"], picture and base64.b64decode(picture), metadata.get("image/png")


class Bundle(unittest.TestCase):
    def test_a_figure_that_was_never_on_a_page_has_a_picture(self):
        words, picture, said = bundle(Figure("ransac-race"))
        self.assertEqual(picture[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", picture[16:24])
        self.assertGreaterEqual(width, 320)
        self.assertGreater(height, 100)
        self.assertTrue(words.startswith("Interactive figure ransac-race. "), words)
        self.assertIn(_assets.still("ransac-race")[1], words)
        self.assertEqual(said, {"alt": words})

    def test_all_figures_have_one_and_all_are_told_apart(self):
        names = _assets._words()
        self.assertGreaterEqual(len(names), 31)
        pictures = {bundle(Figure(name))[1] for name in names}
        self.assertEqual(len(pictures), len(names))
        self.assertTrue(all(pictures))

    def test_other_parameters_are_told(self):
        words, picture, _ = bundle(Figure("ransac-race", outliers=0.4))
        self.assertTrue(words.startswith("Interactive figure ransac-race, outliers=0.4. At its defaults: "), words)
        self.assertEqual(picture, _assets.still("ransac-race")[0])

    def test_what_the_page_has_shown_takes_its_place_until_the_state_is_another(self):
        race = Figure("ransac-race", outliers=0.4)
        race.description = "As it is on the page."
        race._on_message(race, {"kind": "picture", "state": {"outliers": "0.4"}}, [b"live"])
        words, picture, _ = bundle(race)
        self.assertEqual(picture, b"live")
        self.assertEqual(words, "Interactive figure ransac-race, outliers=0.4. As it is on the page.")
        race.set(points=40)
        words, picture, _ = bundle(race)
        self.assertEqual(picture, _assets.still("ransac-race")[0])
        self.assertIn("At its defaults", words)

    def test_a_figure_that_there_is_not_has_none(self):
        words, picture, said = bundle(Figure("../words", seed=3))
        self.assertEqual((words, picture, said), ("Interactive figure ../words, seed=3.", None, None))


if __name__ == "__main__":
    unittest.main()
