"""What the page needs: the script of the elements, that of their worker, and the two modules; and pictures of the
figures for viewers that show none of that."""

import base64
import functools
import json
import pathlib

import epipole_figures

STATIC = pathlib.Path(epipole_figures.__file__).parent / "static"

#: As `glue.js` calls them.
FILES = {
    "code": "index.js",
    "worker": "worker.js",
    "figures": "epipole-figures.wasm",
    "jobs": "epipole-jobs.wasm",
}


@functools.cache
def contents() -> dict[str, bytes]:
    """All files, by the names of `FILES`."""
    missing = [name for name in FILES.values() if not (STATIC / name).is_file()]
    if missing:
        raise FileNotFoundError(f"{', '.join(missing)} not in {STATIC}: `make python-figures` puts them there")
    return {key: (STATIC / name).read_bytes() for key, name in FILES.items()}


@functools.cache
def inline_source() -> str:
    """The glue with all files inside, for pages without a kernel."""
    inside = {key: base64.b64encode(content).decode() for key, content in contents().items()}
    glue = (pathlib.Path(__file__).parent / "glue.js").read_text(encoding="utf-8")
    return f"const INSIDE = {json.dumps(inside)};\n{glue}"


@functools.cache
def _words() -> dict[str, str]:
    try:
        return json.loads((STATIC / "stills/words.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}


def still(name: str) -> tuple[bytes | None, str]:
    """A small picture of a figure at its defaults, a PNG, and what it shows; nothing of a figure that there is not."""
    words = _words().get(name)
    if words is None:
        return None, ""
    return (STATIC / "stills" / f"{name}.png").read_bytes(), words
