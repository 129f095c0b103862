"""Drawings on buttons: 24 x 24, in lines of the colour of the text."""

from __future__ import annotations

_PATHS = {
    "undo": "M5 5.5V11h5.5M5.2 10.8C7 8 9.6 6.5 12.6 6.5c4 0 6.9 2.7 6.9 6.3 0 3.2-2.3 5.7-5.5 6.2",
    "redo": "M19 5.5V11h-5.5M18.8 10.8C17 8 14.4 6.5 11.4 6.5c-4 0-6.9 2.7-6.9 6.3 0 3.2 2.3 5.7 5.5 6.2",
    "fit": "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
    "reset": "M4 4v6h6M4.5 14a8 8 0 1 0 1.8-7.5L4 10",
    "help": "M9 9a3 3 0 1 1 4.2 2.8c-.8.3-1.2.9-1.2 1.7v.5M12 17.2v.1M12 21a9 9 0 1 1 0-18 9 9 0 0 1 0 18Z",
    "theme": "M12 21a9 9 0 1 1 0-18 9 9 0 0 1 0 18ZM12 3v18M12 7.5 17.5 5M12 12l8.5-3M12 16.5l8.5-3",
    "take": "M12 4v11m0 0 4.5-4.5M12 15l-4.5-4.5M5 19.5h14",
    "open": "M12 15V4m0 0L7.5 8.5M12 4l4.5 4.5M5 15v4.5h14V15",
    "close": "M6 6l12 12M18 6 6 18",
    "plus": "M12 5v14M5 12h14",
    "dice": "M5 4h14a1 1 0 0 1 1 1v14a1 1 0 0 1-1 1H5a1 1 0 0 1-1-1V5a1 1 0 0 1 1-1ZM8.5 8.5v.1M15.5 8.5v.1M12 12v.1"
    "M8.5 15.5v.1M15.5 15.5v.1",
    "node": "M4 5h16v6H4zM4 13h16v6H4zM8 8v.1M8 16v.1",
    "link": "M10 14a4 4 0 0 0 6 .5l3-3a4.2 4.2 0 0 0-6-6l-1.5 1.5M14 10a4 4 0 0 0-6-.5l-3 3a4.2 4.2 0 0 0 6 6l1.5-1.5",
}


def icon(name: str) -> str:
    """The SVG of a drawing; screen readers pass it over."""
    return (
        '<svg viewBox="0 0 24 24" fill="none" stroke="currentColor" stroke-width="1.8" stroke-linecap="round"'
        f' stroke-linejoin="round" aria-hidden="true" focusable="false"><path d="{_PATHS[name]}"/></svg>'
    )


#: A cube whose front edge is a link of a chain.
LOGO = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 32 32" aria-hidden="true" focusable="false">'
    '<path fill="#e8793a" d="M16 2 28.5 9 16 16 3.5 9Z"/>'
    '<path fill="#b4410e" d="M3.5 9 16 16v14L3.5 23Z"/><path fill="#7a2a06" d="M28.5 9 16 16v14l12.5-7Z"/>'
    '<rect x="12.6" y="13.2" width="6.8" height="11.4" rx="3.4" fill="none" stroke="#fff" stroke-width="2.2"/></svg>'
)
