"""The examples in docstrings."""

import doctest
import inspect
import types

import epipole
import epipole.options
import numpy as np
import pytest

MODULES = [m for m in vars(epipole._epipole).values() if isinstance(m, types.ModuleType)]
MODULES.append(epipole._epipole)


def members(module):
    """Functions and classes of a module, and methods of the classes."""
    for name, value in vars(module).items():
        if callable(value):
            yield name, value
        if isinstance(value, type):
            yield from ((f"{name}.{key}", method) for key, method in vars(value).items())


def failures(name, value, names):
    """Runs the examples of one docstring; None if there are none."""
    docstring = inspect.getdoc(value) or ""
    test = doctest.DocTestParser().get_doctest(docstring, names, name, None, 0)
    if not test.examples:
        return None
    report = []
    runner = doctest.DocTestRunner(verbose=False)
    return "".join(report) if runner.run(test, out=report.append).failed else ""


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.__name__)
def test_examples_of_a_module(module):
    names = {"epipole": epipole, "np": np, **vars(module)}
    found = [failures(name, value, dict(names)) for name, value in members(module)]
    found = [report for report in found if report is not None]
    assert not any(found), "".join(found)
    assert found, f"no docstring of {module.__name__} has an example"


def test_examples_of_the_options():
    assert failures("options", epipole.options, {}) == ""
