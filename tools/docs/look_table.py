"""Write the table of all settings of a look into docs/look.md, between its marks.

python -m tools.docs.look_table
"""

from __future__ import annotations

from shackled.scene import SETTINGS
from tools.pages import DOCS

PAGE = DOCS / "look.md"
START, END = "<!-- settings -->\n", "<!-- end of the settings -->\n"


def table() -> str:
    """Return the table in Markdown."""
    lines = ["| keyword | option | what it sets | values | default |", "|---|---|---|---|---|"]
    for setting in SETTINGS:
        option = setting.option.replace("/", "`, `")
        lines.append(f"| `{setting.name}` | `{option}` | {setting.text} | {setting.values} | {setting.default} |")
    return "\n".join(lines) + "\n"


def with_table(page: str) -> str:
    """Return the page with the table in it."""
    before, _, rest = page.partition(START)
    return before + START + "\n" + table() + "\n" + END + rest.partition(END)[2]


if __name__ == "__main__":
    PAGE.write_text(with_table(PAGE.read_text("utf-8")), "utf-8")
