"""shackled token allow-list and permit: who may mint early"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Annotated

import typer

from ...checks import number
from ...errors import InputError
from ..option import option
from ..payer import open_signer
from ..telling import tell
from .common import MOST, Account, Chain, Key, MaxFee, Rpc, Which, Yes, address, do, open_named


def allow_list(
    context: typer.Context,
    file: Annotated[
        Path, typer.Argument(help="Lines account,quantity, or OpenZeppelin's tree as JSON.", metavar="FILE")
    ],
    output: Annotated[
        Path | None, option("-o --output", "The tree as OpenZeppelin's StandardMerkleTree keeps it, .json.", "FILE")
    ] = None,
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    max_fee: MaxFee = None,
    signer: Annotated[
        str | None, option("--signer", "Whose signatures allow others; else the one there is.", "ADDRESS")
    ] = None,
    chain_id: Chain = None,
    yes: Yes = False,
) -> None:
    """Print the root of an allow-list; with --rpc, put it into a collection, as its owner."""
    from ...tokens import read_allow_list
    from ...whole_file import write_output

    listed = read_allow_list(file)
    tell(f"root 0x{listed.root.hex()}, {len(listed.allowances):,} accounts, {sum(listed.allowances.values()):,} tokens")
    if output is not None:
        write_output(output, (json.dumps(listed.document(), indent=1) + "\n").encode())
    source, nobody = context.get_parameter_source("rpc"), account is None and private_key_env is None
    # the variable with the node alone does not say that something is to be sent
    if rpc is None or (source is not None and source.name == "ENVIRONMENT" and nobody):
        return
    collection = open_named(which, rpc, chain_id)
    trusted = collection.terms().allow_list_signer if signer is None else address(signer, "--signer")
    title = "set the allow-list"
    receipt = do(collection, account, private_key_env, max_fee, yes, title, "setAllowList", listed.root, trusted)
    tell(f"{collection.name} has this allow-list now; {receipt.gas:,} gas")


def permit(
    who: Annotated[str, typer.Argument(help="The account that may mint.", metavar="ACCOUNT")],
    quantity: Annotated[int, typer.Argument(help="How many tokens in all.", metavar="N", min=1, max=MOST)] = 1,
    output: Annotated[Path | None, option("-o --output", "Where it is written; else printed.", "FILE")] = None,
    days: Annotated[float, option("--days", "How long it holds; else 30.", "DAYS", min=0)] = 30,
    which: Which = "genesis",
    rpc: Rpc = None,
    account: Account = None,
    private_key_env: Key = None,
    chain_id: Chain = None,
) -> None:
    """Sign a permission to mint early, for one account; costs nothing. For the signer of the collection."""
    from ...tokens import sign_allowance
    from ...whole_file import write_output

    allowed = address(who, "the account")
    lasting = number(days, "--days", 0, 36_500)
    collection = open_named(which, rpc, chain_id)
    signer = open_signer(account, private_key_env)
    trusted = collection.terms().allow_list_signer
    if not int(trusted, 16):
        raise InputError(
            "nobody signs permissions of this collection: the owner says who, shackled token allow-list FILE --signer"
        )
    if str(signer.address) != trusted:
        raise InputError(f"permissions of this collection are signed by {trusted}, not by {signer.address}")
    permission = sign_allowance(collection, signer, allowed, quantity, int(time.time() + 86400 * lasting))
    text = json.dumps(permission.document(), indent=1)
    if output is None:
        print(text)
        return
    write_output(output, (text + "\n").encode())
    tell(f"{output}: {allowed} may mint {quantity}; with it: shackled token mint --permission {output}")
