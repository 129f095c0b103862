"""A scene as a widget of a Jupyter notebook."""

from __future__ import annotations

import base64
import gzip
from functools import cache
from typing import TYPE_CHECKING, Any, Unpack

from .._load import Thing, load_picture
from .._render import render
from ..errors import InputError
from ..image import Image
from ..scene._codec import render_call
from ..scene._scene import Scene
from ..scene._settings import LookOptions
from ._page import asset

if TYPE_CHECKING:
    from anywidget import AnyWidget

#: The least width of a widget, in pixels of a style sheet.
LEAST_WIDTH = 384
#: Follows view.js, which defines the element once in a page.
SCRIPT = """
export default {
    render({ model, el }) {
        const view = document.createElement("shackled-view");
        const View = view.constructor;
        if (!View.assets.evm) View.assets = { evm: model.get("_evm"), contracts: model.get("_contracts") };
        view.style.maxWidth = `${model.get("_width")}px`;
        const { buffer, byteOffset, byteLength } = model.get("_call");
        view.call = new Uint8Array(buffer, byteOffset, byteLength);
        // notebooks have keys and a menu of their own
        for (const type of ["keydown", "contextmenu"]) view.addEventListener(type, (event) => event.stopPropagation());
        el.append(view);
        return () => view.remove();
    },
};
"""


def view(thing: Thing, size: int | tuple[int, int] | None = None, **look: Unpack[LookOptions]) -> AnyWidget:
    """Return a widget for Jupyter notebooks that shows a scene, and lets the reader turn it.

    The contracts' own bytecode draws it in the browser. Where no widget runs, the notebook shows the picture of
    `render`, which is also the attribute `image`.

    thing, size, look: as in `load`. InputError for an invalid scene, or if anywidget is not installed.
    """
    scene = load_picture(thing, size, **look)
    try:
        widget = _widget_class()
    except ImportError:
        raise InputError("`view` needs anywidget, which is not installed: pip install 'shackled[jupyter]'") from None
    made: AnyWidget = widget(scene)
    return made


@cache
def _widget_class() -> Any:
    """Return the class of widgets. ImportError without anywidget."""
    from anywidget import AnyWidget
    from traitlets import Bytes, Int

    class View(AnyWidget):
        """A scene that can be turned."""

        _esm = asset("view.js").decode() + SCRIPT
        _evm = Bytes(gzip.compress(asset("evm.wasm"), 9, mtime=0)).tag(sync=True)
        _contracts = Bytes(gzip.compress(asset("contracts.json"), 9, mtime=0)).tag(sync=True)
        _call = Bytes().tag(sync=True)
        _width = Int().tag(sync=True)

        def __init__(self, scene: Scene) -> None:
            self._scene = scene
            self._image: Image | None = None
            super().__init__(_call=render_call(scene), _width=max(scene.width, LEAST_WIDTH))

        @property
        def image(self) -> Image:
            """The picture before it is turned."""
            if self._image is None:
                self._image = render(self._scene)
            return self._image

        def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]]:
            bundle, metadata = super()._repr_mimebundle_(**options) or ({}, {})
            text = f"<View of {self.image!r}>"
            picture = base64.b64encode(self.image.encode(".png")).decode()
            return {**bundle, "text/plain": text, "image/png": picture}, metadata

    return View
