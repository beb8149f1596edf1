"""Presentation of the stubs in the reference: names in docstrings, constructors, defaults."""

from __future__ import annotations

import ast
import re
from typing import Any

import griffe

# `Name` in single backticks is a cross reference, as in NumPy's docstrings.
_NAME = re.compile(r"(?<![`\w\[])`([A-Za-z_][\w.]*)`(?!`)")
# Not a tuple and a call: Griffe leaves a type that is no expression as it is.
_SHAPE = re.compile(r"(, shape) (?=\()")
# Griffe takes doctests in a section of examples alone.
_DOCTEST = re.compile(r"(?:^>>> [^\n]*\n?)+", re.MULTILINE)
_OPTIONS = re.compile(r"(\*\*options : )(\w+)")


class Names(griffe.Extension):
    """Resolves names in docstrings, and shows constructors, operators and defaults."""

    def on_class_members(self, *, node: Any, cls: griffe.Class, agent: Any, **_: Any) -> None:
        # Results have no parameters in their docstrings: nobody but pickle constructs them.
        new = cls.members.pop("__new__", None)
        if isinstance(new, griffe.Function) and _has_parameters(cls):
            new.name = "__init__"
            new.parameters["cls"].name = "self"
            new.returns = None
            cls.set_member("__init__", new)
        for name, overloads in cls.overloads.items():
            if overloads and name not in cls.members:
                first = overloads[0]
                first.overloads = list(overloads)
                cls.set_member(name, first)

    def on_attribute_instance(
        self, *, node: Any, attr: griffe.Attribute, agent: Any, **_: Any
    ) -> None:
        # In options.py the default follows as a comment.
        if (
            isinstance(node, ast.AnnAssign)
            and node.value is None
            and attr.module.name == "options"
        ):
            line = attr.module.lines_collection[attr.filepath][node.lineno - 1]
            _, found, default = line.partition("  # ")
            attr.value = default if found else None

    def on_package(self, *, pkg: griffe.Module, loader: Any, **_: Any) -> None:
        for member in _everything(pkg):
            if member.docstring is not None:
                text = _OPTIONS.sub(r"\1options.\2", member.docstring.value)
                text = _SHAPE.sub("\\1\N{NO-BREAK SPACE}", text)
                if member.is_module:
                    text = _DOCTEST.sub(lambda m: f"```pycon\n{m[0].rstrip()}\n```\n", text)
                member.docstring.value = _NAME.sub(lambda m: _link(m, member, pkg), text)
            if member.is_function:
                for parameter in member.parameters:
                    if parameter.kind is griffe.ParameterKind.var_keyword:
                        parameter.default = None


def _has_parameters(cls: griffe.Class) -> bool:
    return cls.docstring is not None and "\nParameters\n---" in cls.docstring.value


def _everything(module: griffe.Object) -> Any:
    for member in module.members.values():
        if not member.is_alias:
            yield member
            if member.is_module or member.is_class:
                yield from _everything(member)


def _link(match: re.Match[str], scope: griffe.Object, pkg: griffe.Module) -> str:
    name = match[1]
    first, *rest = name.split(".")
    try:
        path = ".".join([pkg.path if first == pkg.name else scope.resolve(first), *rest])
    except griffe.NameResolutionError:
        return f"``{name}``"
    path = path.replace("epipole._epipole.", "epipole.")
    try:
        pkg[path.removeprefix(f"{pkg.path}.")]
    except KeyError:
        return f"``{name}``"
    return f"[`{name}`][{path}]"
