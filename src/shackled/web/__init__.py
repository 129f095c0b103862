"""Scenes that can be turned in a browser: pages, and widgets for notebooks, around the bundle of web/."""
