"""Runs the notebooks that the builder makes of the chapters, each in a kernel of its own.

    python tests/listings/notebooks.py FOLDER

Every code cell must print what the notebook shows. The check of a programming task must say "Not yet" in
the chapter's notebook, and "Right" in the one with solutions.
"""

import copy
import pathlib
import sys
import traceback

import nbformat
from nbclient import NotebookClient

import run


def printed(cell):
    """What a code cell has printed. Pictures and warnings are not compared."""
    streams = [output for output in cell.outputs if output.output_type == "stream"]
    return "".join(stream.text for stream in streams if stream.name == "stdout")


def execute(notebook, folder):
    """The notebook after all of its cells have run; an error in a cell is an exception."""
    done = copy.deepcopy(notebook)
    resources = {"metadata": {"path": folder}}
    quiet = ["--log-level=ERROR"]
    client = NotebookClient(
        done, timeout=120, kernel_name="python3", resources=resources, extra_arguments=quiet
    )
    client.execute()
    return done


def check(path):
    """Raises if something in the notebook is not as it says."""
    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    chapter = path.stem.removesuffix("-solutions")
    wanted = "Right" if path.stem != chapter else "Not yet"
    blocks = run.blocks(run.CONTENT / f"{chapter}.md")
    checks = {f"{block.name}-check" for block in blocks if block.kind == "task"}
    before = {cell.id: cell for cell in notebook.cells}
    for cell in execute(notebook, str(path.parent)).cells:
        if cell.cell_type != "code":
            continue
        if cell.id in checks:
            assert printed(cell).startswith(wanted), f"{path.name}, {cell.id}: {printed(cell)!r}"
        else:
            assert printed(cell) == printed(before[cell.id]), f"{path.name}, {cell.id}: {printed(cell)}"


def main(folder):
    paths = sorted(pathlib.Path(folder).resolve().glob("*.ipynb"))
    failed = 0
    for path in paths:
        try:
            check(path)
        except Exception:
            failed += 1
            print(f"{path.name}:", file=sys.stderr)
            traceback.print_exc()
    print(f"notebooks: {len(paths) - failed} passed, {failed} failed")
    return 1 if failed or not paths else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
