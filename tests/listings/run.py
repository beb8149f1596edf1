"""Runs the Python listings of the chapters: all blocks of a chapter, in order, in one namespace.

    python tests/listings/run.py [--bless] [CHAPTER.md ...]

What a tab of a `{{#listing}}` prints is compared with content/listings/<chapter>.<name>.<tab>.txt;
a picture that it writes as result.png with
<chapter>.<name>.png; --bless writes these files instead. A `{{#task}}` must refuse what it starts from and accept its solution.
"""

import contextlib
import io
import os
import pathlib
import re
import shutil
import sys
import textwrap
import tempfile
import traceback

import cv2
import numpy as np

CONTENT = pathlib.Path(__file__).resolve().parents[2] / "content"
RECORDED = CONTENT / "listings"
DATA = RECORDED / "data"
OPENING = re.compile(r"\s*\{\{#(listing|task) ([a-z0-9-]+)")
ENDING = re.compile(r"\s*\{\{/(listing|task)\}\}")
FENCE = re.compile(r"(\s*)```python\s*(\w*)\s*$")


class Block:
    """A fence with Python: what it belongs to, its code, and the line of the chapter that it starts at."""

    def __init__(self, kind, name, word, code, line):
        self.kind, self.name, self.word, self.code, self.line = kind, name, word, code, line


def blocks(chapter):
    """All blocks of a chapter in their order; those outside of listings and tasks are of the kind "plain"."""
    kind, name, found, fence = "plain", "", [], None
    for number, line in enumerate(chapter.read_text(encoding="utf-8").splitlines(), 1):
        if fence is None:
            if match := OPENING.match(line):
                kind, name = match.groups()
            elif ENDING.match(line):
                kind, name = "plain", ""
            elif match := FENCE.match(line):
                word = match.group(2) or ("numpy" if kind == "listing" else "")
                fence = Block(kind, name, word, "", number + 1)
        elif line.strip() == "```":
            fence.code = textwrap.dedent(fence.code)
            found.append(fence)
            fence = None
        else:
            fence.code += line + "\n"
    return found


def run(block, chapter, namespace):
    """What the block prints."""
    # Empty lines, so that tracebacks name the chapter's lines.
    code = compile("\n" * (block.line - 1) + block.code, str(chapter), "exec")
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        exec(code, namespace)
    return said.getvalue()


def compare_picture(block, chapter, bless):
    """Raises if the block has made a picture, and that is not the recorded one, pixel by pixel."""
    made, recorded = pathlib.Path("result.png"), RECORDED / f"{chapter.stem}.{block.name}.png"
    if not made.exists():
        return
    pixels = cv2.imread(str(made))
    if bless and not np.array_equal(pixels, cv2.imread(str(recorded)) if recorded.exists() else None):
        shutil.copy(made, recorded)
    made.unlink()
    if not recorded.exists() or not np.array_equal(pixels, cv2.imread(str(recorded))):
        raise AssertionError(f"{chapter}:{block.line}: it makes another picture than {recorded.name}")


def compare(block, chapter, printed, bless):
    """Raises if what was printed is not what is recorded."""
    compare_picture(block, chapter, bless)
    file = RECORDED / f"{chapter.stem}.{block.name}.{block.word}.txt"
    if bless:
        RECORDED.mkdir(exist_ok=True)
        file.write_text(printed, encoding="utf-8")
        return
    recorded = file.read_text(encoding="utf-8") if file.exists() else None
    if recorded != printed:
        raise AssertionError(f"{chapter}:{block.line}: it prints\n{printed}recorded is\n{recorded}")


def check_task(parts, chapter, namespace):
    """Raises unless the check refuses the start with words and accepts the solution."""
    start, check, solution = (parts[word] for word in ("start", "check", "solution"))
    for given, wanted in ((start, "Not yet"), (solution, "Right")):
        own = dict(namespace)
        run(given, chapter, own)
        said = run(check, chapter, own)
        if not said.startswith(wanted):
            raise AssertionError(f"{chapter}:{check.line}: the check says {said!r} of the {given.word}")


def run_chapter(chapter, bless):
    """How many blocks of the chapter passed and failed."""
    namespace, parts = {"__name__": chapter.stem}, {}
    passed = failed = 0
    for block in blocks(chapter):
        try:
            if block.kind == "task":
                parts[block.word] = block
                if block.word != "solution":
                    continue
                check_task(parts, chapter, namespace)
                parts = {}
            else:
                printed = run(block, chapter, namespace)
                if block.kind == "listing":
                    compare(block, chapter, printed, bless)
            passed += 1
        except Exception:
            failed += 1
            traceback.print_exc()
    return passed, failed


def main(arguments):
    bless = "--bless" in arguments
    names = [argument for argument in arguments if argument != "--bless"]
    chapters = [pathlib.Path(name).resolve() for name in names] or sorted(CONTENT.rglob("*.md"))
    # Run them in a folder with their data, in which they may write.
    with tempfile.TemporaryDirectory() as folder:
        if DATA.is_dir():
            shutil.copytree(DATA, folder, dirs_exist_ok=True)
        os.chdir(folder)
        results = [run_chapter(chapter, bless) for chapter in chapters]
        os.chdir(CONTENT)
    passed, failed = (sum(column) for column in zip(*results))
    print(f"listings: {passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
