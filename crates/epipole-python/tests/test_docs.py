"""The pages of the documentation: their code runs, and the reference has every module."""

import os
import pkgutil
import tempfile
import warnings
from pathlib import Path

import epipole
import pytest

DOCS = Path(__file__).parents[1] / "docs"
PAGES = DOCS / "pages"
pytestmark = pytest.mark.skipif(
    not DOCS.exists(), reason="the documentation is beside the sources of the package only"
)


def pages_with_cells():
    return [
        page
        for page in sorted(PAGES.glob("*.md"))
        if "\n```python" in page.read_text(encoding="utf-8")
    ]


@pytest.mark.parametrize("page", pages_with_cells(), ids=lambda page: page.stem)
def test_code_of_a_page(page, tmp_path, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib", reason="the pages draw with matplotlib")
    matplotlib.use("agg")
    from matplotlib import pyplot

    monkeypatch.syspath_prepend(DOCS)
    from cells import split

    monkeypatch.setattr(tempfile, "tempdir", os.fspath(tmp_path))
    namespace = {"__name__": "__main__"}
    parts = split(page.read_text(encoding="utf-8"))
    cells = [part.code for part in parts if not isinstance(part, str)]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for n, code in enumerate(cells):
            exec(compile(code, f"{page.name}, cell {n + 1}", "exec"), namespace)
    pyplot.close("all")


def modules():
    found = [module.name for module in pkgutil.iter_modules(epipole.__path__)]
    native = [
        name for name, value in vars(epipole._epipole).items() if type(value) is type(epipole)
    ]
    return sorted({name for name in found + native if not name.startswith("_")})


@pytest.mark.parametrize("name", modules())
def test_a_module_has_its_page(name):
    page = PAGES / "reference" / f"{name}.md"
    assert f"::: epipole.{name}\n" in page.read_text(encoding="utf-8")
    assert f"reference/{name}.md\n" in (DOCS / "mkdocs.yml").read_text(encoding="utf-8")
    assert f"({name}.md)" in (PAGES / "reference" / "index.md").read_text(encoding="utf-8")


def test_pages_are_in_the_navigation():
    navigation = (DOCS / "mkdocs.yml").read_text(encoding="utf-8")
    for page in PAGES.rglob("*.md"):
        assert f": {page.relative_to(PAGES).as_posix()}\n" in navigation
