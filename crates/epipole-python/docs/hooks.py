"""Executes the code cells of the pages as MkDocs builds them, and links to the book."""

from __future__ import annotations

import ast
import base64
import html
import io
import json
import logging
import os
import posixpath
import re
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import matplotlib.font_manager  # noqa: F401 - its cache is built here, not in a cell
import nbformat
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File
from mkdocs.structure.nav import Link
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError, CellTimeoutError, DeadKernelError
from PIL import Image

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

from cells import Cell, split  # noqa: E402

PACKAGE = HERE.parent / "python" / "epipole"
CHAPTERS = HERE.parents[2] / "content"
LONGEST_CELL_S = 300
# Pictures have two pixels per CSS pixel.
PIXELS_PER_CSS_PIXEL = 2

# Cells write files, which go when the build ends.
_scratch = tempfile.TemporaryDirectory()

log = logging.getLogger("mkdocs.hooks.cells")


def on_config(config: Any) -> Any:
    # Kernels inherit these.
    os.environ["TMPDIR"] = _scratch.name
    os.environ["MATPLOTLIBRC"] = str(HERE / "matplotlibrc")
    paths = [str(PACKAGE.parent), os.environ.get("PYTHONPATH", "")]
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, paths))
    return config


def on_nav(nav: Any, config: Any, files: Any) -> Any:
    nav.items.append(Link("The book", "../index.html"))
    return nav


def on_page_markdown(markdown: str, page: Any, config: Any, files: Any) -> str:
    markdown = markdown.replace("<!-- names of epipole -->", _names())
    markdown = markdown.replace("<!-- own names of epipole -->", _own_names())
    parts = split(markdown)
    if not any(isinstance(part, Cell) for part in parts):
        return markdown
    start = time.monotonic()
    notebook = _execute(page.file.src_uri, parts)
    log.info("%s: executed in %.1f s", page.file.src_uri, time.monotonic() - start)
    name = posixpath.splitext(page.file.src_uri)[0]
    text, pictures = [], 0
    for cell, part in zip(notebook.cells, parts, strict=True):
        if isinstance(part, str):
            text.append(part)
            continue
        block = f"```python\n{part.code}```\n"
        if fold := part.attributes.get("fold"):
            block = f'??? example "{fold}"\n\n' + _indented(block)
        text.append(block + "\n")
        for output in cell.outputs:
            if output.output_type == "stream" and output.name == "stderr":
                raise PluginError(f"{page.file.src_uri}: a cell warns:\n{output.text}")
            data = output.get("data", {"text/plain": output.get("text", "")})
            if "image/png" in data:
                pictures += 1
                path = f"{name}-{pictures}.webp"
                image = Image.open(io.BytesIO(base64.b64decode(data["image/png"])))
                files.append(File.generated(config, path, content=_webp(image)))
                text.append(_picture(page.file.src_uri, path, image.size, part))
            else:
                text.append(_output(data["text/plain"]))
    # Readers run it: without outputs it is small.
    for cell in notebook.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    content = nbformat.writes(notebook) + "\n"
    files.append(File.generated(config, f"{name}.ipynb", content=content))
    download = f"[Download as a notebook]({posixpath.basename(name)}.ipynb){{ .download }}\n"
    whole = "\n".join(text)
    return re.sub(r"\A(# [^\n]*\n)", lambda m: f"{m[1]}\n{download}", whole.lstrip())


def on_page_content(content: str, page: Any, config: Any, files: Any) -> str:
    """Turns `book:epipolar.html` into a link beside the folder of this site."""
    up = "../" * (page.file.dest_uri.count("/") + 1)

    def link(match: re.Match[str]) -> str:
        if not (CHAPTERS / f"{match[1]}.md").exists():
            raise PluginError(f"{page.file.src_uri}: the book has no chapter {match[1]}")
        return f'href="{up}{match[1]}.html'

    return re.sub(r'href="book:([\w-]+)\.html', link, content)


def on_post_build(config: Any) -> None:
    site = Path(config.site_dir)
    # Both need the address of the site, which is unknown.
    for name in ("404.html", "sitemap.xml", "sitemap.xml.gz"):
        (site / name).unlink(missing_ok=True)
    _write_sections(site / "search")


def _write_sections(folder: Path) -> None:
    """Writes the sections of the search index in the format of the book's own search."""
    docs = json.loads((folder / "search_index.json").read_text("utf-8"))["docs"]
    pages = {doc["location"]: _plain(doc["title"]) for doc in docs if "#" not in doc["location"]}
    sections = [
        {
            "u": doc["location"],
            "c": f"Python: {pages[doc['location'].partition('#')[0]]}",
            "t": _plain(doc["title"]),
            "w": _plain(doc["text"]),
        }
        for doc in docs
    ]
    text = json.dumps(sections, ensure_ascii=False, separators=(",", ":"))
    (folder / "sections.json").write_text(text, "utf-8")


def _plain(text: str) -> str:
    """Words of a piece of HTML."""
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", text)).split())


def _execute(name: str, parts: list[str | Cell]) -> Any:
    cells = []
    for n, part in enumerate(parts):
        if isinstance(part, str):
            cell = nbformat.v4.new_markdown_cell(part.strip())
        else:
            cell = nbformat.v4.new_code_cell(part.code.rstrip("\n"))
        cell.id = f"cell-{n}"
        cells.append(cell)
    kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
    notebook = nbformat.v4.new_notebook(cells=cells, metadata=kernel)
    client = NotebookClient(notebook, timeout=LONGEST_CELL_S, record_timing=False)
    client.create_kernel_manager().transport = "ipc"
    try:
        client.execute()
    except (CellExecutionError, CellTimeoutError, DeadKernelError) as error:
        raise PluginError(f"{name}: {error}") from error
    # The version of the kernel is no part of the page.
    notebook.metadata.pop("language_info", None)
    return notebook


def _webp(image: Image.Image) -> bytes:
    """A tenth of the bytes of a PNG, for photographs with noise."""
    buffer = io.BytesIO()
    image.save(buffer, "webp", quality=85)
    return buffer.getvalue()


def _picture(page: str, path: str, size: tuple[int, int], cell: Cell) -> str:
    if "alt" not in cell.attributes:
        raise PluginError(
            f'{page}: a cell with a picture needs alt="..." in its fence:\n{cell.code}'
        )
    width, height = (side // PIXELS_PER_CSS_PIXEL for side in size)
    alt, file = html.escape(cell.attributes["alt"]), posixpath.basename(path)
    return f'![{alt}]({file}){{ .picture width="{width}" height="{height}" loading="lazy" }}\n'


def _output(text: str) -> str:
    lines = text.rstrip("\n")
    return f'<div class="output" markdown>\n\n```text\n{lines}\n```\n\n</div>\n'


def _indented(text: str) -> str:
    return "".join(f"    {line}" if line.strip() else line for line in text.splitlines(True))


def _imports() -> dict[str, list[str]]:
    """Names that `epipole` takes from each of its modules."""
    found = {}
    for node in ast.parse((PACKAGE / "__init__.py").read_text()).body:
        if isinstance(node, ast.ImportFrom):
            found[node.module] = [alias.name for alias in node.names]
    return found


def _names() -> str:
    """Table of the names of modules that are also in `epipole`."""
    rows = ["| Module | Names |", "|---|---|"]
    for module, names in _imports().items():
        if module != "epipole._epipole":
            links = ", ".join(f"[`{name}`][{module}.{name}]" for name in names)
            rows.append(f"| [`{module.removeprefix('epipole.')}`][{module}] | {links} |")
    return "\n".join(rows)


def _own_names() -> str:
    """Reference of the functions and errors of `epipole` that are in no module."""
    stub = ast.parse((PACKAGE / "_epipole.pyi").read_text()).body
    defined = {node.name for node in stub if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    options = "    options:\n      heading_level: 3\n      show_root_heading: true\n"
    names = [name for name in _imports()["epipole._epipole"] if name in defined]
    return "\n".join(f"::: epipole.{name}\n{options}" for name in names)
