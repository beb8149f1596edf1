"""Docstrings: their examples run, and they name every parameter."""

import doctest
import inspect
import re
import types

import epipole
import epipole.convert
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


def documented_parameters(docstring):
    """Names in the section of parameters, in NumPy's style."""
    pattern = r"^Parameters\n-{10}\n(.*?)(?=^\w+\n---|\Z)"
    section = re.search(pattern, inspect.cleandoc(docstring or ""), re.M | re.S)
    lines = [line for line in section[1].splitlines() if line.strip()] if section else []
    heads = [line.partition(" : ")[0] for line in lines if not line.startswith(" ")]
    return [name.strip().lstrip("*") for head in heads for name in head.split(",")]


def public_callables(module):
    """Functions, constructors and methods that a module defines, with their docstrings."""
    for name in module.__all__:
        value = getattr(module, name)
        if isinstance(value, type) and not issubclass(value, Exception):
            if value.__text_signature__ and "__new__" in vars(value):
                yield name, value
            for key, attribute in vars(value).items():
                method = getattr(value, key)
                if not key.startswith("_") and callable(method) and not isinstance(attribute, type):
                    yield f"{name}.{key}", method
        elif callable(value) and not isinstance(value, type):
            yield name, value


def undocumented(module):
    """Parameters that the docstrings of a module do not name, by callable."""
    found = {}
    for name, value in public_callables(module):
        parameters = [p for p in inspect.signature(value).parameters if p not in ("self", "cls")]
        known = documented_parameters(value.__doc__)
        missing = [parameter for parameter in parameters if parameter not in known]
        if missing or not inspect.getdoc(value):
            found[name] = missing
    return found


@pytest.mark.parametrize(
    "module", [*MODULES, epipole.convert], ids=lambda module: module.__name__
)
def test_docstrings_name_every_parameter(module):
    assert undocumented(module) == {}


def test_docstrings_of_pictures_name_every_parameter():
    pytest.importorskip("matplotlib")
    import epipole.plot

    assert undocumented(epipole.plot) == {}


def test_a_parameter_without_a_line_is_found():
    def made(a, b):
        """Sum.

        Parameters
        ----------
        a : int
        """

    module = types.SimpleNamespace(__all__=["made"], made=made)
    assert undocumented(module) == {"made": ["b"]}
