"""Draw a profile as an SVG flame graph: stages at the top, then functions, then lines."""

from __future__ import annotations

from dataclasses import dataclass, field
from html import escape
from itertools import takewhile

from ._profile import Profile
from ._stages import STAGES

WIDTH, ROW, MARGIN = 1200, 18, 8

#: Narrower boxes, in pixels, are left out.
NARROWEST = 0.4
#: Width of a character of the text, and the padding of its box, in pixels.
CHARACTER, PADDING = 6.3, 8

STYLE = (
    "text{font:11px ui-monospace,Menlo,Consolas,monospace;fill:#1b1b1b}"
    ".title{font-size:13px;fill:#222}"
    "rect{stroke:#fff;stroke-width:.6}"
    "@media(prefers-color-scheme:dark){.title{fill:#ddd}rect{stroke:#14161a}}"
)


@dataclass
class _Box:
    gas: int = 0
    inside: dict[str, _Box] = field(default_factory=dict)


def flame_graph(profile: Profile, name: str) -> str:
    """Return the SVG document. Calls that all of a stage have in common, such as that of the Engine, are left out."""
    root = _Box()
    common = {}
    for stage in STAGES:
        # the function itself stays
        ways = [cost.calls[:-1] for cost in profile.costs if cost.stage == stage]
        common[stage] = len([*takewhile(lambda names: len(set(names)) == 1, zip(*ways, strict=False))])
    for cost in profile.costs:
        box = root
        box.gas += cost.gas
        for key in (cost.stage, *cost.calls[common[cost.stage] :], cost.place.rpartition("/")[2]):
            box = box.inside.setdefault(key, _Box())
            box.gas += cost.gas
    parts: list[str] = []
    head, scale = MARGIN + ROW + 6, (WIDTH - 2 * MARGIN) / max(root.gas, 1)

    def draw(name: str, box: _Box, left: float, hue: int, depth: int = 0) -> int:
        """Append a box and those inside it; return the number of rows."""
        width = box.gas * scale
        if width < NARROWEST:
            return depth
        fits = int((width - PADDING) / CHARACTER)
        label = name if len(name) <= fits else name[: fits - 1] + "…" if fits >= 4 else ""
        y = head + depth * ROW
        text = f'<text x="{left + PADDING / 2:.1f}" y="{y + 12.5:.1f}">{escape(label)}</text>' if label else ""
        parts.append(
            f"<g><title>{escape(name)}: {box.gas:,} gas, {100 * box.gas / root.gas:.2f} %</title>"
            f'<rect x="{left:.2f}" y="{y:.1f}" width="{width:.2f}" height="{ROW - 1}" '
            f'fill="hsl({hue},{62 - 3 * (depth % 4)}%,{70 + 3 * (depth % 4)}%)"/>{text}</g>'
        )
        rows = depth + 1
        for key, inner in sorted(box.inside.items(), key=lambda item: -item[1].gas):
            rows = max(rows, draw(key, inner, left, hue, depth + 1))
            left += inner.gas * scale
        return rows

    depth, left = 0, float(MARGIN)
    for index, stage in enumerate(STAGES):
        if stage in root.inside:
            # distinct hues, pale enough for dark text in light and dark mode
            depth = max(depth, draw(stage, root.inside[stage], left, (18 + 137 * index) % 360))
            left += root.inside[stage].gas * scale
    height = head + depth * ROW + MARGIN
    title = escape(f"{name}: {root.gas:,} gas, by stage, function and line")
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}">'
        f'<style>{STYLE}</style><text class="title" x="{MARGIN}" y="{MARGIN + 13}">{title}</text>\n'
        + "\n".join(parts)
        + "\n</svg>\n"
    )
