"""shackled token allow-list and permit: who may mint before the public sale"""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Annotated

import click

from ...checks import number
from ...errors import InputError
from ..chain_options import SignerOptions, parse_checksum_address
from ..option import argument, option
from ..output import print_line
from .options import MAX_NUMBER, CollectionOptions, TokenPayerOptions


def allow_list(
    context: click.Context,
    file: Annotated[Path, argument("Lines of account,quantity, or an OpenZeppelin tree as JSON.", "FILE")],
    which: CollectionOptions,
    payer: TokenPayerOptions,
    output: Annotated[
        Path | None, option("-o --output", "Write the tree as OpenZeppelin's StandardMerkleTree, .json.", "FILE")
    ] = None,
    signer: Annotated[
        str | None, option("--signer", "Account that signs permissions; default: unchanged.", "ADDRESS")
    ] = None,
) -> None:
    """Print the root of an allow list; with --rpc, set it in a collection. For the owner."""
    from ...tokens import read_allow_list
    from ...whole_file import write_output

    allowed = read_allow_list(file)
    quantities = allowed.allowances.values()
    print_line(f"root 0x{allowed.root.hex()}, {len(quantities):,} accounts, {sum(quantities):,} tokens")
    if output is not None:
        write_output(output, (json.dumps(allowed.document(), indent=1) + "\n").encode())
    source = context.get_parameter_source("rpc")
    # the environment variable of the node alone does not ask for a transaction
    is_only_set = source is not None and source.name == "ENVIRONMENT" and not payer.is_given
    if which.rpc is None or is_only_set:
        return
    collection = which.open()
    trusted = collection.state().allow_list_signer if signer is None else parse_checksum_address(signer, "--signer")
    receipt = payer.send(collection, "set the allow list", "setAllowList", allowed.root, trusted)
    print_line(f"{collection.name} has this allow list now; {receipt.gas:,} gas")


def permit(
    who: Annotated[str, argument("The account that may mint.", "ACCOUNT")],
    which: CollectionOptions,
    signing: SignerOptions,
    quantity: Annotated[int, argument("Number of tokens in all.", "N", min=1, max=MAX_NUMBER)] = 1,
    output: Annotated[Path | None, option("-o --output", "File to write; default: print it.", "FILE")] = None,
    days: Annotated[float, option("--days", "Days until it expires.", "DAYS", min=0)] = 30,
) -> None:
    """Sign a permission to mint for one account; sends no transaction. For the signer of the collection."""
    from ...tokens import sign_allowance
    from ...whole_file import write_output

    account = parse_checksum_address(who, "the account")
    seconds = 86400 * number(days, "--days", 0, 36_500)
    collection = which.open()
    signer = signing.signer
    trusted = collection.state().allow_list_signer
    if not int(trusted, 16):
        raise InputError(
            "the collection accepts no permissions yet: its owner sets a signer with shackled token allow-list FILE "
            "--signer"
        )
    if str(signer.address) != trusted:
        raise InputError(f"permissions of this collection are signed by {trusted}, not by {signer.address}")
    permission = sign_allowance(collection, signer, account, quantity, int(time.time() + seconds))
    text = json.dumps(permission.document(), indent=1)
    if output is None:
        print(text)
        return
    write_output(output, (text + "\n").encode())
    print_line(f"{output}: {account} may mint {quantity}, with: shackled token mint --permission {output}")
