"""The widget of notebooks: a notebook that is run, and its widget in chromium."""

from __future__ import annotations

import base64
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from shackled import load, render
from shackled.scene._codec import render_call

pytest.importorskip("anywidget")
WIDGET = "application/vnd.jupyter.widget-view+json"
STATE = "application/vnd.jupyter.widget-state+json"

#: Shows a widget as notebooks do: by the default export of its module, which is given the model and a place.
PAGE = """<!doctype html>
<meta charset="utf-8">
<div id="place"></div>
<script type="module">
const { script, width, state } = JSON.parse(document.querySelector("script[type='text/plain']").textContent);
const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
const { default: widget } = await import(url);
const bytes = Object.fromEntries(Object.entries(state).map(
    ([name, text]) => [name, new DataView(Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer)]));
widget.render({ model: { get: name => bytes[name] ?? width }, el: document.getElementById("place") });
</script>
<script type="text/plain">DATA</script>
"""


def test_a_notebook_shows_the_widget(tmp_path: Path, browser: Any) -> None:
    nbclient = pytest.importorskip("nbclient")
    nbformat = pytest.importorskip("nbformat")
    book = nbformat.v4.new_notebook()
    book.cells = [nbformat.v4.new_code_cell("import shackled\nshackled.view('icons/crown', (48, 40))")]
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3").execute()
    (output,) = book.cells[0].outputs
    image = render("icons/crown", (48, 40))
    assert base64.b64decode(output.data["image/png"]) == image.encode(".png")
    assert output.data["text/plain"] == f"<View of {image!r}>"
    model = book.metadata.widgets[STATE]["state"][output.data[WIDGET]["model_id"]]
    assert model["model_module"] == "anywidget"
    buffers = {each["path"][0]: each["data"] for each in model["buffers"]}
    assert base64.b64decode(buffers["_call"]) == render_call(load("icons/crown", size=(48, 40)))
    # and in chromium
    data = {"script": model["state"]["_esm"], "width": model["state"]["_width"], "state": buffers}
    path = tmp_path / "page.html"
    path.write_text(PAGE.replace("DATA", json.dumps(data).replace("<", "\\u003c")), "utf-8")
    faults: list[str] = []
    with browser.new_page() as tab:
        tab.on("pageerror", lambda error: faults.append(str(error)))
        tab.goto(path.as_uri())
        tab.wait_for_function("() => document.querySelector('shackled-view')?.picture")
        assert tab.evaluate("document.querySelector('shackled-view').picture.sha256") == image.sha256
    assert not faults


def test_without_anywidget() -> None:
    program = """if True:
        import sys
        sys.modules["anywidget"] = None
        import shackled
        try:
            shackled.view("icons/crown")
        except shackled.InputError as error:
            print(error)"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert ended.stdout == "`view` needs anywidget, which is not installed: pip install 'shackled[jupyter]'\n"
