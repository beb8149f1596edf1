"""The widget."""

from __future__ import annotations

import base64
import pathlib
from typing import Any

import anywidget
import traitlets

from . import _assets


def _text(value: Any) -> str:
    """A value as an attribute has it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return str(value)


def _texts(parameters: dict[str, Any]) -> dict[str, str]:
    # Names of arguments have no hyphens.
    return {str(key).replace("_", "-"): _text(value) for key, value in parameters.items()}


class Figure(anywidget.AnyWidget):
    """A figure of the book, such as ``Figure("ransac-race", outliers=0.4)``.

    Keyword arguments are parameters of the figure; a hyphen in a name is written as an underscore. ``state``,
    ``readouts`` and ``solved`` follow the figure; setting ``state`` makes the figure's state exactly that.

    Before the figure is on a page, ``state`` holds the arguments and ``readouts`` is empty: a figure computes in the
    browser.
    """

    _esm = pathlib.Path(__file__).parent / "glue.js"

    #: Name of the figure.
    name = traitlets.Unicode().tag(sync=True)
    #: What differs from the figure's defaults, by parameter, as text.
    state = traitlets.Dict(key_trait=traitlets.Unicode()).tag(sync=True)
    #: The numbers and words beside the picture, by name.
    readouts = traitlets.Dict(key_trait=traitlets.Unicode()).tag(sync=True)
    #: Names of the goals that have been reached.
    solved = traitlets.List(traitlets.Unicode()).tag(sync=True)
    #: What the figure shows, in words.
    description = traitlets.Unicode().tag(sync=True)
    #: Attributes of the element that are no parameters, and its height in CSS pixels.
    _look = traitlets.Dict().tag(sync=True)

    def __init__(
        self,
        name: str,
        *,
        theme: str | None = None,
        compact: bool = False,
        controls: str | None = None,
        readouts_shown: str | None = None,
        goals: str | None = None,
        height: int | None = None,
        inline: bool = False,
        **parameters: Any,
    ) -> None:
        if inline:
            self._esm = _assets.inline_source()
        look = {"theme": theme, "controls": controls, "readouts": readouts_shown, "goals": goals, "height": height}
        look = {key: value for key, value in look.items() if value is not None}
        if compact:
            look["compact"] = ""
        super().__init__(name=name, state=_texts(parameters), _look=look)
        self._shown: tuple[dict[str, str], bytes] | None = None
        self.on_msg(self._on_message)

    def _on_message(self, _widget: Any, content: Any, buffers: Any) -> None:
        kind = content.get("kind") if isinstance(content, dict) else None
        if kind == "assets?":
            files = _assets.contents()
            self.send({"kind": "assets", "names": list(files)}, buffers=list(files.values()))
        elif kind == "picture" and buffers and isinstance(content.get("state"), dict):
            self._shown = (_texts(content["state"]), bytes(buffers[0]))

    @property
    def picture(self) -> bytes | None:
        """What the figure shows in its present state, a PNG.

        Nothing before it has rested on a page for a moment in that state: a figure is drawn in the browser.
        """
        if self._shown is None or self._shown[0] != self.state:
            return None
        return self._shown[1]

    def _repr_mimebundle_(self, **kwargs: Any) -> Any:
        """As of any widget, with picture and words for viewers that show no widgets.

        Until the figure has been on a page, both are of its defaults, and the words say so where it has other parameters.
        """
        bundle = super()._repr_mimebundle_(**kwargs)
        if not bundle:
            return bundle
        data, metadata = bundle if isinstance(bundle, tuple) else (bundle, {})
        picture, words = self.picture, self.description
        if picture is None:
            picture, shown = _assets.still(self.name)
            # Ignore the last description, which may be of another state.
            words = f"At its defaults: {shown}" if shown and self.state else shown
        setting = "".join(f", {key}={value}" for key, value in self.state.items())
        data["text/plain"] = f"Interactive figure {self.name}{setting}." + (f" {words}" if words else "")
        if picture is not None:
            data["image/png"] = base64.b64encode(picture).decode()
            metadata = {**metadata, "image/png": {"alt": data["text/plain"]}}
        return data, metadata

    @traitlets.validate("state")
    def _validate_state(self, proposal: Any) -> dict[str, str]:
        return _texts(proposal["value"])

    def set(self, **parameters: Any) -> None:
        """Puts parameters on top of the present state."""
        self.state = {**self.state, **_texts(parameters)}

    def press(self, button: str) -> None:
        """Presses a button of the figure, such as ``"step"``."""
        self.send({"kind": "press", "id": button})

    def reset(self) -> None:
        """Back to the figure's defaults."""
        self.state = {}

    def link(self, parameter: str, widget: Any, trait: str = "value") -> Any:
        """Keeps a parameter equal to a trait of another widget, both ways. Returns a function that ends it.

        The other widget has to have a value that the figure takes; where the figure is at its default, the other keeps
        its own value.
        """
        key = parameter.replace("_", "-")
        kind = type(getattr(widget, trait))

        def from_figure(change: Any) -> None:
            text = change.new.get(key)
            if text is None:
                return
            value = text == "true" if kind is bool else kind(float(text)) if kind in (int, float) else text
            if getattr(widget, trait) != value:
                setattr(widget, trait, value)

        def to_figure(change: Any) -> None:
            text = _text(change.new)
            present = self.state.get(key)
            same = present == text or (kind in (int, float) and present is not None and float(present) == change.new)
            if not same:
                self.state = {**self.state, key: text}

        self.observe(from_figure, "state")
        widget.observe(to_figure, trait)

        def unlink() -> None:
            self.unobserve(from_figure, "state")
            widget.unobserve(to_figure, trait)

        return unlink
