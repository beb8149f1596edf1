"""Writes the type stubs of the native modules and `epipole/options.py`.

Usage: ``python stubs.py`` writes, ``python stubs.py --check`` fails if a file is stale.

Names, signatures and docstrings come from the built package. Types come from the Rust signatures,
or where these take any object, from "Parameters" and "Returns" in the docstrings. Keyword options
come from the tables `_options` of the modules. A missing type is an error.
"""

import inspect
import re
import sys
import textwrap
import types
from pathlib import Path

HERE = Path(__file__).parent
PACKAGE = HERE / "python" / "epipole"
sys.path.insert(0, str(PACKAGE.parent))

from epipole import _epipole  # noqa: E402

GENERATED = "# Written by stubs.py. Do not edit.\n\n"

# Types of docstrings as (argument, result).
NAMED = {
    "array_like": ("ArrayLike", "ArrayLike"),
    "callable": ("Callable[..., Any]", "Callable[..., Any]"),
    "dict": ("Mapping[str, Any]", "dict[str, Any]"),
    "os.PathLike": ("os.PathLike[str]", "os.PathLike[str]"),
    "object": ("object", "Any"),
    "Any": ("Any", "Any"),
    "tuple": ("tuple[Any, ...]", "tuple[Any, ...]"),
    "uint8": ("ArrayLike", "NDArray[np.uint8]"),
} | {name: (name, name) for name in ("None", "bool", "bytes", "float", "int", "slice", "str")}
DTYPES = {"": "float64", "float": "float64", "int": "int64", "bool": "bool_"}
DTYPES |= {name: name for name in ("uint8", "uint16", "uint32", "int32", "int64", "float32", "float64")}

# Scalars of Rust.
RUST = {"bool": "bool", "String": "str", "str": "str", "()": "None", "char": "str"}
RUST |= {f"{kind}{bits}": "int" for kind in "iu" for bits in (8, 16, 32, 64, "size")}
RUST |= {"Any": "Any", "_Model": "_Model", "f32": "float", "f64": "float", "PathBuf": "str | os.PathLike[str]"}

# Attribute whose type is the parameter of a class.
GENERIC = {"RansacReport": "model", "LeastMedian": "model"}

# Special methods that need no docstring.
SPECIAL = {
    "__eq__": "(self, other: object, /) -> bool",
    "__len__": "(self) -> int",
    "__enter__": "(self, /) -> None",
    "__exit__": "(self, /, *exception: object) -> None",
    "__bool__": "(self) -> bool",
    "__class_getitem__": "(cls, model: Any) -> Any",
    "__contains__": "(self, item: object, /) -> bool",
    "__iter__": "(self, /) -> Ransac",
    "__next__": "(self, /) -> Trial",
    "__getnewargs_ex__": "(self, /) -> tuple[tuple[Any, ...], dict[str, Any]]",
}
# Those that `object` has.
HIDDEN = {"__new__", "__repr__", "__str__", "__reduce__", "__hash__", "__doc__", "__module__"}

PROGRESS = "Callable[[str, float], object] | None"
PARENTHESES = r"\((?:[^()]|\([^()]*\))*\)"
SHAPE = rf",? (?:of )?shape {PARENTHESES}(?:(?:,| or|, or) {PARENTHESES})*|,? of the same shape"

problems = []


class Opaque(Exception):
    """A Rust type that says nothing about the Python type."""


class Unknown(Exception):
    """A word of a docstring that names no type."""


def is_room(value):
    return isinstance(value, types.ModuleType) and value.__name__.startswith("epipole.")


ROOMS = {name: value for name, value in vars(_epipole).items() if is_room(value)}
CLASSES = {}
for room_name, room in ROOMS.items():
    for class_name, value in vars(room).items():
        if isinstance(value, type):
            CLASSES.setdefault(class_name, []).append(room_name)
CLASSES["Threads"] = ["threads"]


def split(text, separators):
    """Splits at separators outside of brackets."""
    parts, depth, start, at = [], 0, 0, 0
    while at < len(text):
        # The arrow of a function type closes nothing.
        depth += text[at] in "([{<"
        depth -= text[at] in ")]}>" and text[at - 1 : at + 1] != "->"
        found = next((s for s in separators if depth == 0 and text.startswith(s, at)), None)
        if found:
            parts.append(text[start:at])
            at = start = at + len(found)
        else:
            at += 1
    return [part.strip() for part in [*parts, text[start:]] if part.strip()]


class Rust:
    """Signatures, documentation and fields in the Rust source of a room."""

    def __init__(self, room):
        files = [HERE / "src" / f"{room}.rs", *sorted((HERE / "src" / room).rglob("*.rs"))]
        self.functions, self.fields = {}, {}
        for file in files:
            if file.exists():
                self.read(file.read_text(encoding="utf-8"))

    def read(self, text):
        for match in re.finditer(r"#\[pymethods\]\s*impl (\w+) \{\n(.*?)\n\}", text, re.S):
            self.read_functions(match[1], match[2])
        self.read_functions(None, text)
        structs = [
            r'"epipole[\w.]*" (\w+) \{(.*?)\n    \}',
            r"#\[pyclass\([^)]*get_all[^)]*\)\].*?struct (\w+) \{(.*?)\n\}",
        ]
        for match in (m for pattern in structs for m in re.finditer(pattern, text, re.S)):
            fields = re.sub(r"///.*|#\[.*?\]", "", match[2])
            for field in split(fields, [","]):
                name, _, kind = field.partition(":")
                name = name.split()[-1]
                self.fields[match[1], name] = kind.strip()

    def read_functions(self, owner, text):
        pattern = r"((?:^ *///.*\n)*)(?:^ *#\[[^\n]*\n|^ *[^\n/{}]*\)\]\n|^ *[\w, =*]+\n)*"
        pattern += r"^ *(?:pub(?:\(\w+\))? )?fn (\w+)(?:<[^>]*>)?\("
        for match in re.finditer(pattern, text, re.M):
            rest = text[match.end() - 1 :]
            inside = re.match(r"\((.*?)\)(?: -> (.*?))? \{\n", rest, re.S)
            if inside is None:
                continue
            parameters = {}
            for part in split(inside[1], [","]):
                name, _, kind = part.partition(":")
                parameters[name.removeprefix("mut ").strip()] = kind.strip()
            doc = re.sub(r"^ */// ?", "", match[1], flags=re.M)
            self.functions.setdefault((owner, match[2]), (parameters, inside[2] or "()", doc))


class Room:
    """Stub of one module, whose Rust source has the name `name`."""

    def __init__(self, name, module):
        self.name, self.module, self.rust = name, module, Rust(name)
        self.imports, self.where = set(), ""

    def fail(self, what):
        problems.append(f"{self.name}.{self.where}: {what}")
        return "Any"

    def class_hint(self, name):
        path, _, name = name.rpartition(".")
        homes = CLASSES.get(name, [])
        wanted = path.removeprefix("epipole").strip(".")
        if wanted in homes:
            home = wanted
        elif self.name in homes:
            home = self.name
        elif len(homes) == 1 and not path.startswith("epipole."):
            home = homes[0]
        else:
            raise Unknown(name)
        if home != self.name:
            self.imports.add(f"from epipole.{home} import {name}")
        return name

    def rust_hint(self, kind, is_argument, owner):
        """Hint of a Rust type; raises Opaque for an object of any kind."""
        kind = re.sub(r"'\w+,? ?|^&(?:mut )?|\bmut ", "", kind.strip()).strip()
        if kind in RUST:
            return RUST[kind]
        if kind == "Self":
            return self.class_hint(owner)
        if kind.startswith("(") and kind.endswith(")"):
            parts = [self.rust_hint(k, is_argument, owner) for k in split(kind[1:-1], [","])]
            return f"tuple[{', '.join(parts)}]"
        if kind.startswith("["):
            inner = self.rust_hint(re.split(r";|\]$", kind[1:])[0], is_argument, owner)
            return f"Sequence[{inner}]" if is_argument else f"list[{inner}]"
        outer, _, inner = kind.partition("<")
        inner = inner.removesuffix(">").strip().strip(",").strip()
        outer = outer.split("::")[-1]
        if outer in ("Bound", "Borrowed", "Py", "PyResult", "PyRef", "Box", "Arc", "Result"):
            return self.rust_hint(split(inner, [","])[0], is_argument, owner)
        if outer == "Option":
            return f"{self.rust_hint(inner, is_argument, owner)} | None"
        if outer == "Vec":
            inner = self.rust_hint(inner, is_argument, owner)
            return f"Sequence[{inner}]" if is_argument else f"list[{inner}]"
        if re.match(r"Py(Readonly)?Array(\d|Dyn)$", outer):
            dtype = {"f64": "float64", "f32": "float32", "bool": "bool_"}.get(inner)
            integer = ("uint" if inner[0] == "u" else "int") + inner[1:]
            return f"NDArray[np.{dtype or integer}]"
        if not inner and outer in CLASSES:
            return self.class_hint(outer)
        raise Opaque(kind)

    def doc_hint(self, text, is_argument):
        """Hint of a type in a docstring."""
        text, optional = re.subn(r", optional$", "", text.strip())
        hints = self.alternatives(text, is_argument)
        if optional and "None" not in hints:
            hints.append("None")
        is_array = any(hint.startswith("NDArray") for hint in hints)
        if not is_argument and is_array and set(hints) & {"float", "int", "bool"}:
            # One point or many, which arrays of numbers do not tell apart.
            return "Any"
        return " | ".join(dict.fromkeys(hints))

    def alternatives(self, text, is_argument):
        text = re.sub(SHAPE, "", text.strip())
        if text.startswith("{"):
            return [f"Literal[{text.strip('{}')}]"]
        parts = split(text, [", or ", ", ", " or "])
        array = re.match(r"(list of )?ndarray of \w+$", parts[0])
        if array and parts[1:] and set(parts[1:]) <= set(DTYPES):
            return ["list[NDArray[Any]]" if array[1] else "NDArray[Any]"]
        return [self.one(part, is_argument) for part in parts]

    def one(self, text, is_argument):
        outer, _, inner = text.partition(" of ")
        if outer == "array_like":
            return "ArrayLike"
        if outer == "ndarray" and inner in DTYPES:
            return f"NDArray[np.{DTYPES[inner]}]"
        if outer in ("list", "sequence", "tuple") and inner:
            inner = " | ".join(self.alternatives(inner, is_argument))
            if is_argument or outer == "sequence":
                return f"Sequence[{inner}]"
            return f"list[{inner}]" if outer == "list" else f"tuple[{inner}, ...]"
        if outer in GENERIC and inner:
            self.class_hint(outer)
            return f"{outer}[{self.one(inner, is_argument)}]"
        if text in NAMED:
            return NAMED[text][0 if is_argument else 1]
        if re.fullmatch(r"[A-Za-z_.0-9]+", text):
            return self.class_hint(text)
        raise Unknown(text)

    def hint(self, kind, doc, is_argument, owner, what):
        """Hint by the Rust type, or else by the type in the docstring."""
        try:
            documented = self.doc_hint(doc, is_argument) if doc else None
        except Unknown as unknown:
            return self.fail(f"the docstring gives {what} the type {doc!r}: what is {unknown}?")
        try:
            exact = self.rust_hint(kind, is_argument, owner) if kind else None
        except (Opaque, Unknown):
            exact = None
        plain = {"bool", "float", "int", "str"}
        if {exact, documented} <= plain and exact != documented:
            return self.fail(f"{what} is {exact}, but {documented} in the docstring")
        if exact and documented and documented.startswith(f"{exact}["):
            return documented
        if exact or documented:
            return exact or documented
        return self.fail(f"the docstring gives {what} no type")

    def parameters(self, signature, rust, doc, owner, is_strict):
        """Parameters with their hints."""
        documented = section(doc, "Parameters")
        parts, kinds = [], inspect.Parameter
        star = False
        previous = None
        for parameter in signature.parameters.values():
            name = parameter.name
            if previous == kinds.POSITIONAL_ONLY != parameter.kind and parts != ["self"]:
                parts.append("/")
            previous = parameter.kind
            if name in ("self", "cls"):
                parts.append(name)
                continue
            if parameter.kind == kinds.VAR_KEYWORD:
                parts.append(f"**{name}: {self.options(documented.get('**' + name))}")
                continue
            if parameter.kind == kinds.VAR_POSITIONAL:
                star = True
                hint = self.hint(None, documented.get("*" + name), True, owner, name)
                parts.append(f"*{name}: {hint}")
                continue
            if parameter.kind == kinds.KEYWORD_ONLY and not star:
                star = True
                parts.append("*")
            if is_strict and name not in documented:
                self.fail(f"the docstring does not list {name}")
            hint = self.hint(rust.get(name), documented.get(name), True, owner, name)
            hint = PROGRESS if name == "progress" else hint
            default = ""
            if parameter.default is not kinds.empty:
                value = parameter.default
                default = " = ..."
                if value is None or isinstance(value, (bool, int, float, str)):
                    default = f" = {value!r}"
                if value is None and "None" not in hint:
                    hint += " | None"
            parts.append(f"{name}: {hint}{default}")
        if previous == kinds.POSITIONAL_ONLY and parts != ["self"]:
            parts.append("/")
        return parts

    def options(self, name):
        """Hint of keyword options."""
        if name is None:
            return self.fail("the docstring lists no **options with the name of their struct")
        if name in OPTIONS:
            self.imports.add("from epipole import options as option_types")
            return f"Unpack[option_types.{name}]"
        try:
            return self.doc_hint(name, True)
        except Unknown:
            return self.fail(f"no module declares the options {name}")

    def result(self, rust, doc, owner):
        """Hint of the result."""
        documented = list(section(doc, "Returns").items())
        if len(documented) > 1:
            hints = [self.hint(None, kind, False, owner, name) for name, kind in documented]
            return f"tuple[{', '.join(hints)}]"
        kind = documented[0][1] if documented else None
        return self.hint(rust, kind, False, owner, "the result")

    def function(self, name, value, owner=None, indent=""):
        """Stub of a function or method."""
        self.where = f"{owner}.{name}" if owner else name
        rust, returned, rust_doc = self.rust.functions.get((owner, name), ({}, None, ""))
        is_special = name.startswith("__")
        doc = inspect.cleandoc(rust_doc if is_special else value.__doc__ or "")
        try:
            signature = inspect.signature(value)
        except ValueError:
            return [f"{indent}# {self.fail('there is no signature')}"]
        if is_special:
            signature = renamed(signature, rust)
        parts = self.parameters(signature, rust, doc, owner, not is_special)
        if owner is None and not section(doc, "Returns") and returned != "PyResult<()>":
            self.fail("the docstring does not list the result")
        result = self.result(returned, doc, owner)
        lines = []
        versions = overloads(parts, result)
        for arguments, result in versions:
            lines += [f"{indent}@overload"] if len(versions) > 1 else []
            if owner and isinstance(vars(getattr(self.module, owner))[name], staticmethod):
                lines.append(f"{indent}@staticmethod")
            elif owner and "self" not in arguments:
                lines.append(f"{indent}@classmethod")
                arguments = ["cls", *(part for part in arguments if part != "cls")]
            lines += definition(name, arguments, result, indent, doc)
        return lines

    def attribute(self, cls, name, value):
        """Stub of an attribute."""
        self.where = f"{cls.__name__}.{name}"
        kind = self.rust.fields.get((cls.__name__, name))
        if kind is None:
            kind = self.rust.functions.get((cls.__name__, name), ({}, None, ""))[1]
        doc = inspect.cleandoc(value.__doc__ or "")
        array = re.search(r"(?:(\w+) (?:array )?of )?shape \(", doc.split("\n\n")[0])
        if array and not section(doc, "Returns"):
            dtype = array[1] if array[1] in DTYPES else "bool" if array[1] == "boolean" else "float"
            # Descriptors of numbers or of bits, images of either depth.
            others = re.findall(r"or (\w+) of shape \(", doc.split("\n\n")[0])
            dtypes = " or ".join([dtype, *(other for other in others if other in DTYPES)])
            result = self.hint(kind, f"ndarray of {dtypes}", False, cls.__name__, name)
        elif GENERIC.get(cls.__name__) == name:
            result = "_Model"
        elif kind in ("Py<PyAny>", "Option<Py<PyAny>>") and not section(doc, "Returns"):
            # Objects of the caller, such as the model of `ransac`.
            result = "Any"
        else:
            result = self.result(kind, doc, cls.__name__)
        return ["    @property", *definition(name, ["self"], result, "    ", doc)]

    def place(self, owner, name):
        """Sort key: attributes first, each in the order of the source, since Python has none."""
        attributes, methods = list(self.rust.fields), list(self.rust.functions)
        is_method = not inspect.isdatadescriptor(vars(getattr(self.module, owner))[name])
        order = [*attributes, *methods]
        key = (owner, name)
        return is_method, order.index(key) if key in order else -1, name

    def class_stub(self, cls):
        name, base = cls.__name__, cls.__base__
        self.where = name
        doc = inspect.cleandoc(cls.__doc__ or "")
        lines = ["@final", f"class {name}:", *docstring(doc, "    ")]
        if base is not object:
            lines[1] = f"class {name}({base.__name__}):"
        if name in GENERIC:
            lines[1] = f"class {name}(Generic[_Model]):"
        names = vars(cls)
        if cls.__text_signature__ and "__new__" in names:
            self.where = f"{name}.__new__"
            rust = {f: k for (c, f), k in self.rust.fields.items() if c == name}
            # A record takes objects of any kind where it has them.
            rust = {f: k.replace("Py<PyAny>", "Any") for f, k in rust.items()}
            if name in GENERIC:
                rust[GENERIC[name]] = "_Model"
            rust |= self.rust.functions.get((name, "new"), ({}, None, ""))[0]
            parts = self.parameters(inspect.signature(cls), rust, doc, name, True)
            made = f"{name}[_Model]" if name in GENERIC else name
            lines += definition("__new__", ["cls", *parts], made, "    ", "")
        for key in sorted(names, key=lambda key: self.place(name, key)):
            value = names[key]
            is_rust = (name, key) in self.rust.functions
            if key in HIDDEN or key.startswith("_") and not key.startswith("__"):
                continue
            if key == "__class_getitem__":
                lines.append("    @classmethod")
            if key in SPECIAL:
                lines.append(f"    def {key}{SPECIAL[key]}: ...")
            elif key.startswith("__") and not is_rust:
                continue
            elif inspect.isdatadescriptor(value):
                lines += self.attribute(cls, key, value)
            elif callable(value) or isinstance(value, (staticmethod, classmethod)):
                lines += self.function(key, getattr(cls, key), name, "    ")
            else:
                lines.append(f"    {key}: {type(value).__name__}")
        if names.get("__hash__", 0) is None:
            lines.append("    __hash__: ClassVar[None]  # type: ignore[assignment]")
        return [*lines, ""]

    def text(self):
        body = []
        names = {k: v for k, v in vars(self.module).items() if not k.startswith("_")}
        for name, value in names.items():
            if isinstance(value, type):
                body += self.class_stub(value)
            elif callable(value):
                body += self.function(name, value)
            elif not isinstance(value, types.ModuleType):
                body.append(f"{name}: {constant(value)}")
        doc = [f'"""{self.module.__doc__.strip()}"""', ""] if self.module.__doc__ else []
        head = [*doc, *imports(body, self.imports), *listed(self.module)]
        return GENERATED + "\n".join([*head, *body]).rstrip() + "\n"


def listed(module):
    """`__all__`, as it is at run time."""
    return ["__all__ = [", *(f'    "{name}",' for name in sorted(module.__all__)), "]", ""]


def constant(value):
    return f"NDArray[np.{value.dtype}]" if hasattr(value, "dtype") else type(value).__name__


def renamed(signature, rust):
    """Signature of a special method with the names in Rust, which Python does not keep."""
    names = iter([n for n in rust if n not in ("&self", "slf", "py", "_py")])
    parameters = signature.parameters.values()
    return signature.replace(
        parameters=[p if p.name == "self" else p.replace(name=next(names)) for p in parameters]
    )


def overloads(parts, result):
    """Pairs the alternatives of one parameter with those of the result: ``A or B -> C or D``."""
    results = split(result, [" | "])
    choices = [i for i, part in enumerate(parts) if len(split(part, [" | "])) == len(results)]
    if len(results) < 2 or "None" in results or len(choices) != 1 or "=" in parts[choices[0]]:
        return [(parts, result)]
    at = choices[0]
    name, _, hint = parts[at].partition(": ")
    hints = split(hint, [" | "])
    return [
        ([*parts[:at], f"{name}: {hint}", *parts[at + 1 :]], result)
        for hint, result in zip(hints, results)
    ]


def definition(name, parts, result, indent, doc):
    line = f"{indent}def {name}({', '.join(parts)}) -> {result}:"
    lines = [line]
    if len(line) > 96:
        lines = [f"{indent}def {name}(", *(f"{indent}    {part}," for part in parts)]
        lines.append(f"{indent}) -> {result}:")
    if not doc:
        return [*lines[:-1], lines[-1] + " ..."]
    return [*lines, *docstring(doc, indent + "    ")]


def docstring(doc, indent):
    if not doc:
        return []
    raw = "r" if "\\" in doc else ""
    end = '"""' if "\n" not in doc else '\n"""'
    return textwrap.indent(f'{raw}"""{doc}{end}', indent).split("\n")


def section(doc, title):
    """Names and types of a section of a docstring in NumPy's style."""
    match = re.search(rf"^{title}\n-+\n(.*?)(?=^\w+\n---|\Z)", doc, re.M | re.S)
    entries = {}
    for line in match[1].splitlines() if match else []:
        if not line.strip() or line.startswith(" "):
            continue
        names, colon, kind = line.partition(" : ")
        if not colon and title == "Returns":
            names, kind = "", line
        for name in names.split(", "):
            entries[name.strip()] = kind.strip() or None
    return entries


def imports(body, classes):
    """The imports that a stub needs."""
    text = "\n".join(re.sub(r'r?""".*?"""', "", "\n".join(body), flags=re.S).split("\n"))
    uses = lambda name: re.search(rf"\b{name}\b", text)  # noqa: E731
    lines = ["import os"] if uses(r"os\.PathLike") else []
    abstract = [n for n in ("Callable", "Iterator", "Mapping", "Sequence") if uses(n)]
    typing = ["Any", "ClassVar", "Generic", "Literal", "TypeVar", "final", "overload"]
    is_generic = uses("Generic")
    typing = [n for n in typing if uses(n) or n == "TypeVar" and is_generic]
    array = [n for n in ("ArrayLike", "NDArray") if uses(n)]
    lines += [f"from collections.abc import {', '.join(abstract)}"] if abstract else []
    lines += [f"from typing import {', '.join(typing)}"] if typing else []
    lines += ["", "import numpy as np"] if uses(r"np\.") else [""]
    lines += [f"from numpy.typing import {', '.join(array)}"] if array else []
    lines += ["from typing_extensions import Unpack"] if uses("Unpack") else []
    lines += ["", *sorted(classes)] if classes else []
    lines += ["", '_Model = TypeVar("_Model")'] if is_generic else []
    return [*lines, ""]


def read_options():
    """Type hints and defaults of all option structs."""
    found = {}
    for room in ROOMS.values():
        for name, (hints, defaults) in getattr(room, "_options", {}).items():
            known = found.setdefault(name, (hints, {}))
            if known[0] != hints:
                problems.append(f"two modules declare different options {name}")
            known[1].update(defaults)
    return found


OPTIONS = read_options()


def options_text():
    body = []
    for name, (hints, defaults) in sorted(OPTIONS.items()):
        body += ["", "", f"class {name}(TypedDict, total=False):"]
        for field, hint in hints.items():
            line = f"    {field}: {hint}"
            default = defaults.get(field)
            has_default = field in defaults and not isinstance(default, (dict, list))
            with_default = f"{line}  # {default!r}"
            body.append(with_default if has_default and len(with_default) < 100 else line)
    doc = '''"""Keyword options with their types and defaults, for annotations.

>>> from epipole.options import RansacOptions
>>> options: RansacOptions = {"max_error_px": 0.5, "seed": 3}

Each function takes them as keywords: ``estimate_fundamental(pixels1, pixels2, **options)``.
"""

'''
    text = "\n".join(body)
    abstract = [n for n in ("Mapping", "Sequence") if f"{n}[" in text]
    typing = [n for n in ("Any", "Literal") if re.search(rf"\b{n}\b", text)]
    head = "from __future__ import annotations\n\n"
    head += f"from collections.abc import {', '.join(abstract)}\n" if abstract else ""
    head += f"from typing import {', '.join([*typing, 'TypedDict'])}\n"
    return GENERATED + doc + head + text.rstrip() + "\n"


def package_text():
    """Stub of the native module itself."""
    body, own = [], Room("threads", _epipole)
    for name, value in vars(_epipole).items():
        if isinstance(value, type) and issubclass(value, Exception):
            body.append(f"class {name}({value.__base__.__name__}):")
            body += [*docstring(inspect.cleandoc(value.__doc__), "    "), ""]
        elif isinstance(value, type):
            body += own.class_stub(value)
        elif callable(value) and not name.startswith("_"):
            body += own.function(name, value)
    rooms = [f"from epipole import {name} as {name}" for name in sorted(ROOMS)]
    head = [*imports(body, rooms), *listed(_epipole), "__version__: str", ""]
    return GENERATED + "\n".join([*head, *body]).rstrip() + "\n"


def main():
    files = {f"{name}.pyi": Room(name, module).text() for name, module in ROOMS.items()}
    files |= {"_epipole.pyi": package_text(), "options.py": options_text()}
    if problems:
        sys.exit("\n".join(problems))
    stale = [p.name for p in PACKAGE.glob("*.pyi") if p.name not in files]
    for name, text in files.items():
        path = PACKAGE / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            stale.append(name)
            if "--check" not in sys.argv:
                path.write_text(text, encoding="utf-8")
    if "--check" in sys.argv and stale:
        sys.exit(f"stale: {', '.join(stale)}; run python stubs.py")


if __name__ == "__main__":
    main()
