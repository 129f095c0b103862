"""shackled token"""

from __future__ import annotations

import typer

from .allow_list import allow_list, permit
from .deploy import demo, deploy
from .edition import edition
from .icons import add, seal
from .owner import accept_ownership, phase, royalty, transfer_ownership, withdraw
from .sale import mint, reveal, transfer
from .show import list_, picture, show, verify

token = typer.Typer(
    no_args_is_help=True, help="Deploy and use collections of tokens whose pictures are rendered on chain."
)
token.command()(deploy)
token.command()(add)
token.command()(seal)
token.command("allow-list")(allow_list)
token.command()(permit)
token.command()(phase)
token.command()(mint)
token.command()(reveal)
token.command()(show)
token.command("list")(list_)
token.command()(verify)
token.command()(picture)
token.command()(transfer)
token.command()(withdraw)
token.command()(royalty)
token.command("transfer-ownership")(transfer_ownership)
token.command("accept-ownership")(accept_ownership)
token.command()(demo)
token.add_typer(edition, name="edition")

__all__ = ["token"]
