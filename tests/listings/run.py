"""Runs the Python listings of the chapters: all blocks of a chapter, in order, in one namespace.

    python tests/listings/run.py [CHAPTER.md ...]
"""

import pathlib
import re
import sys
import traceback

CONTENT = pathlib.Path(__file__).resolve().parents[2] / "content"
BLOCK = re.compile(r"^```python\n(.*?)^```", re.M | re.S)


def listings(chapter):
    """The code of each block, behind empty lines so that tracebacks name the chapter's lines."""
    text = chapter.read_text(encoding="utf-8")
    for match in BLOCK.finditer(text):
        yield "\n" * text.count("\n", 0, match.start(1)) + match.group(1)


def main(names):
    chapters = [pathlib.Path(name) for name in names] or sorted(CONTENT.rglob("*.md"))
    passed = failed = 0
    for chapter in chapters:
        namespace = {"__name__": chapter.stem}
        for code in listings(chapter):
            try:
                exec(compile(code, str(chapter), "exec"), namespace)
                passed += 1
            except Exception:
                failed += 1
                traceback.print_exc()
    print(f"listings: {passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
