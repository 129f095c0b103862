"""shackled token demo"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from ...errors import InputError
from ..option import option
from ..payer import MaxFee, parse_max_fee
from ..telling import say, tell
from .common import Rpc, connect, table


def demo(
    output: Annotated[Path, option("-o --output", "The folder for gallery.html and tokens.json.", "DIR")],
    rpc: Rpc = None,
    max_fee: MaxFee = None,
) -> None:
    """Play both collections through on a fresh anvil: deploy, mint as several users, reveal, read, transfer, withdraw.

    It uses the keys that anvil publishes, and refuses any other chain.
    """
    from ...tokens import comparison, run

    if output.exists() and not output.is_dir():
        raise InputError(f"{output} is a file, not a folder")
    result = run(connect(rpc, None), output, say, parse_max_fee(max_fee))
    head, *rows = comparison(result.costs)
    table(head, rows)
    tell(f"{result.gallery}: {len(result.tokens)} tokens, read back through tokenURI")
    tell(f"{result.listing}")
