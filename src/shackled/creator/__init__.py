"""The Creator: a page in the browser on which pictures are made without code.

From the inside out: `_state` has all settings of a picture, `_scene` turns them into a scene, `_tasks` renders it in
worker processes, `_queue` and `_pool` share these between visitors, and `_web` is the page.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
