"""Code cells of a page: the Markdown fences whose language is `python`.

The attributes of a fence are `alt`, of the picture below it; `fold`, the title of a box that hides
the code; and `file`, the code's file beside this one, which several pages share.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

_FENCE = re.compile(r"^```python(?P<info>[^\n]*)\n(?P<code>.*?)^```$", re.MULTILINE | re.DOTALL)
_ATTRIBUTE = re.compile(r'(\w+)="([^"]*)"')


@dataclass
class Cell:
    """Code, and the attributes of its fence."""

    code: str
    attributes: dict[str, str]


def split(markdown: str) -> list[str | Cell]:
    """Text and cells of a page, in order."""
    parts: list[str | Cell] = []
    end = 0
    for match in _FENCE.finditer(markdown):
        attributes = dict(_ATTRIBUTE.findall(match["info"]))
        code = match["code"]
        if file := attributes.get("file"):
            code = (Path(__file__).parent / file).read_text(encoding="utf-8")
        parts += [markdown[end : match.start()], Cell(code, attributes)]
        end = match.end()
    return [*parts, markdown[end:]]
