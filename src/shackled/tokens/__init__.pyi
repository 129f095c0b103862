from ._allow_list import read_allow_list
from ._collection import EDITIONS, KINDS, Collection, CollectionKind, open_collection
from ._contract import Contract, ContractCall, minted_tokens, plan, withdrawn
from ._demo import run_demo
from ._editions import (
    OPEN,
    EditionTerms,
    add_gas,
    added_number,
    edition_at,
    edition_mint_call,
    editions_of,
    open_editions,
    withdraw_gas,
)
from ._icons import ICON_PRICE, SCALE, add_call, check_sale, chosen_pieces, find_icon, icons_of, licence_of, token_scene
from ._launch import CollectionTerms, Launch, SetupStep, address_of, launch, parts_of, plan_launch, plan_setup
from ._metadata import MAX_LENGTH, read_data_uri
from ._minting import mint_call, sign_allowance
from ._reveal import (
    Round,
    check_randomness,
    hidden_rounds,
    latest_block,
    price_calls,
    price_wallet_calls,
    reveal_calls,
)
from ._storage import SceneToStore, StoragePlan, plan_storage, read_back, store
from ._verify import check_code, check_collection_code, check_token
from ._view import comparison, read_view, read_views

__all__ = [
    "EDITIONS",
    "ICON_PRICE",
    "KINDS",
    "MAX_LENGTH",
    "OPEN",
    "SCALE",
    "Collection",
    "CollectionKind",
    "CollectionTerms",
    "Contract",
    "ContractCall",
    "EditionTerms",
    "Launch",
    "Round",
    "SceneToStore",
    "SetupStep",
    "StoragePlan",
    "add_call",
    "add_gas",
    "added_number",
    "address_of",
    "check_code",
    "check_collection_code",
    "check_randomness",
    "check_sale",
    "check_token",
    "chosen_pieces",
    "comparison",
    "edition_at",
    "edition_mint_call",
    "editions_of",
    "find_icon",
    "hidden_rounds",
    "icons_of",
    "latest_block",
    "launch",
    "licence_of",
    "mint_call",
    "minted_tokens",
    "open_collection",
    "open_editions",
    "parts_of",
    "plan",
    "plan_launch",
    "plan_setup",
    "plan_storage",
    "price_calls",
    "price_wallet_calls",
    "read_allow_list",
    "read_back",
    "read_data_uri",
    "read_view",
    "read_views",
    "reveal_calls",
    "run_demo",
    "sign_allowance",
    "store",
    "token_scene",
    "withdraw_gas",
    "withdrawn",
]
