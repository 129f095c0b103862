"""The Creator: pictures of the contracts, made without code.

What stands on the page is in `web`; beneath it is what knows of no page:

- `state`: all that a visitor may choose, as one small value. `scene`: from it to a Scene, and what its source says by
  itself. `view`: cameras and lights between the two.
- `controls`: label, unit, range and step of each value. `change`: one of them, by its path. `checking`: their ranges.
- `presets`, `history`, `link`, `orbit`: looks, undo, links, what dragging does.
- `pool`: pictures for many visitors. `lane`: who waits. `worker`, `tasks`: what the processes do.
- `upload`, `archive`, `gltf`, `guard`, `store`: files of strangers. `limits`: how much of everything.
- `takeaway`, `film`, `cast_command`, `python_program`, `solidity_contract`: what is taken home. `fits`: where it fits.
"""
