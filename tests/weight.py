"""What a module of the page weighs, by figure of the gallery and by room of the crates.

    python3 tests/weight.py MODULE.wasm [FINISHED.wasm]

MODULE is what cargo leaves, with the names of its functions; FINISHED is what pages download. Sizes are
of code before wasm-opt; the last column shares out the compressed size of FINISHED (or of MODULE) by
them, so it says about what leaving something out would save.
"""

import collections
import pathlib
import re
import sys
import zlib


def number(data, at):
    """An unsigned LEB128 number and where it ends."""
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 0x7F) << shift
        shift += 7
        if byte < 0x80:
            return value, at


def sections(data):
    at = 8
    while at < len(data):
        kind, size_at = data[at], at + 1
        size, start = number(data, size_at)
        yield kind, start, start + size
        at = start + size


def functions(data):
    """(name, bytes) of every function that the module defines, and bytes of its data."""
    imported, bodies, names, constants = 0, [], {}, 0
    for kind, at, end in sections(data):
        if kind == 2:
            count, at = number(data, at)
            for _ in range(count):
                for _ in range(2):
                    size, at = number(data, at)
                    at += size
                what, at = data[at], at + 1
                if what == 0:
                    imported += 1
                    _, at = number(data, at)
                elif what == 1:
                    at += 1
                    at = limits(data, at)
                elif what == 2:
                    at = limits(data, at)
                elif what == 3:
                    at += 2
        elif kind == 10:
            count, at = number(data, at)
            for _ in range(count):
                size, at = number(data, at)
                bodies.append(size)
                at += size
        elif kind == 11:
            constants += end - at
        elif kind == 0:
            size, at = number(data, at)
            if data[at : at + size] == b"name":
                at += size
                while at < end:
                    part, at = data[at], at + 1
                    length, at = number(data, at)
                    if part == 1:
                        count, place = number(data, at)
                        for _ in range(count):
                            index, place = number(data, place)
                            length_of_name, place = number(data, place)
                            names[index] = data[place : place + length_of_name].decode()
                            place += length_of_name
                    at += length
    found = [(names.get(imported + index, "?"), size) for index, size in enumerate(bodies)]
    return found, constants


def limits(data, at):
    flags, at = data[at], at + 1
    _, at = number(data, at)
    if flags & 1:
        _, at = number(data, at)
    return at


def path(mangled):
    """The path in a legacy mangled name, such as epipole_widgets::gallery::harris."""
    if not mangled.startswith("_ZN"):
        return mangled
    rest, parts = mangled[3:], []
    while match := re.match(r"(\d+)", rest):
        length = int(match.group(1))
        start = len(match.group(1))
        parts.append(rest[start : start + length])
        rest = rest[start + length :]
    text = "::".join(parts[:-1] if re.fullmatch(r"h[0-9a-f]{16}", parts[-1]) else parts)
    for code, sign in {"$LT$": "<", "$GT$": ">", "$u20$": " ", "$RF$": "&", "$C$": ",", "..": "::"}.items():
        text = text.replace(code, sign)
    return text


def group(mangled):
    """The figure or room that a function belongs to."""
    text = path(mangled)
    if match := re.search(r"epipole_widgets::gallery::(\w+)", text):
        return f"figure {match.group(1).replace('_', '-')}"
    if match := re.search(r"epipole_widgets::kit::(\w+)", text):
        return f"kit {match.group(1)}"
    if match := re.search(r"epipole_widgets::(\w+)", text):
        return f"figures' {match.group(1)}"
    if match := re.search(r"epipole_canvas::(\w+)", text):
        return f"drawing {match.group(1)}"
    if match := re.search(r"\bepipole::(\w+)", text):
        return f"core {match.group(1)}"
    if match := re.search(r"\b(core::fmt|core::num|alloc::fmt)\b", text):
        return "formatting"
    for crate in ("nalgebra", "serde_json", "serde", "postcard", "image", "ttf_parser", "tiny_skia", "libm",
                  "dlmalloc", "wasm_bindgen", "epipole_web", "core", "alloc", "std", "compiler_builtins"):
        if re.search(rf"\b{crate}::", text):
            return crate
    return "other"


def compressed(file):
    neighbor = pathlib.Path(f"{file}.br")
    return len(neighbor.read_bytes()) if neighbor.is_file() else len(zlib.compress(file.read_bytes(), 9))


def main():
    data = pathlib.Path(sys.argv[1]).read_bytes()
    finished = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else sys.argv[1])
    found, constants = functions(data)
    sizes = collections.Counter()
    for name, size in found:
        sizes[group(name)] += size
    sizes["constants, tables and the font"] += constants
    whole, packed = sum(sizes.values()), compressed(finished)
    print(f"{whole / 1024:.0f} KB of code and constants; {packed / 1024:.1f} KB compressed")
    print(f"{'KB':>7} {'compressed':>11}")
    for name, size in sizes.most_common():
        print(f"{size / 1024:7.1f} {size / whole * packed / 1024:11.1f}  {name}")


if __name__ == "__main__":
    main()
