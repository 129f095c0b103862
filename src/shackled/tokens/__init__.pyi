from ._allow_list import read_allow_list
from ._collection import EDITIONS, KINDS, Collection, CollectionKind, open_collection
from ._contract import PHASES, Contract, minted_tokens, plan, withdrawn
from ._demo import run_demo
from ._editions import (
    OPEN,
    EditionTerms,
    add_gas,
    added_number,
    edition_at,
    editions_of,
    open_editions,
    withdraw_call,
)
from ._icons import ICON_PRICE, SCALE, add_call, check_sale, chosen_pieces, find_icon, icons_of, licence_of, token_scene
from ._launch import CollectionTerms, Launch, address_of, launch, plan_launch, plan_setup
from ._metadata import MAX_LENGTH, read_data_uri
from ._minting import mint_call, read_allowance, sign_allowance
from ._reveal import Round, check_randomness, hidden_rounds, price_calls, reveal_calls
from ._storage import SceneToStore, StoragePlan, plan_storage, read_back, store
from ._verify import check_code, check_collection_code, check_token
from ._view import read_view, read_views

__all__ = [
    "EDITIONS",
    "ICON_PRICE",
    "KINDS",
    "MAX_LENGTH",
    "OPEN",
    "PHASES",
    "SCALE",
    "Collection",
    "CollectionKind",
    "CollectionTerms",
    "Contract",
    "EditionTerms",
    "Launch",
    "Round",
    "SceneToStore",
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
    "edition_at",
    "editions_of",
    "find_icon",
    "hidden_rounds",
    "icons_of",
    "launch",
    "licence_of",
    "mint_call",
    "minted_tokens",
    "open_collection",
    "open_editions",
    "plan",
    "plan_launch",
    "plan_setup",
    "plan_storage",
    "price_calls",
    "read_allow_list",
    "read_allowance",
    "read_back",
    "read_data_uri",
    "read_view",
    "read_views",
    "reveal_calls",
    "run_demo",
    "sign_allowance",
    "store",
    "token_scene",
    "withdraw_call",
    "withdrawn",
]
