from ._allow_list import hash_pair, leaf_of, make_allow_list, read_allow_list
from ._allowance import read_allowance, sign_allowance
from ._collection import EDITIONS, KINDS, Collection, CollectionKind, open_collection
from ._contract import USUAL_GAS, Contract, perform, plan
from ._demo import development_accounts, run_demo
from ._editions import (
    MAX_SCALE,
    OPEN,
    Edition,
    EditionTerms,
    add_gas,
    added_edition,
    edition_at,
    edition_mint_call,
    editions_address,
    editions_of,
    open_editions,
    withdraw_gas,
)
from ._gallery import ActionCost, comparison, page, tokens_json
from ._icons import ICON_PRICE, SCALE, add_call, check_sale, chosen_pieces, find_icon, icons_of, token_scene
from ._immutables import immutable_places, immutable_values
from ._launch import CollectionTerms, address_of, launch, parts_of, plan_launch, plan_setup
from ._licence import allows, licence_of
from ._metadata import MAX_LENGTH, Metadata, Trait, read_data_uri, read_token_uri, shrink
from ._minting import mint_call
from ._randomness import check_randomness
from ._reveal import HEADERS_AT_ONCE, KNOWN_BLOCKS_BEFORE, hidden_rounds, latest_block, price_calls, reveal_calls
from ._reverts import PHASES
from ._storage import SceneToStore, plan_storage, read_back, store
from ._verify import check_code, check_collection_code, check_token
from ._view import TokenView, read_view, read_views

__all__ = [
    "EDITIONS",
    "HEADERS_AT_ONCE",
    "ICON_PRICE",
    "KINDS",
    "KNOWN_BLOCKS_BEFORE",
    "MAX_LENGTH",
    "MAX_SCALE",
    "OPEN",
    "PHASES",
    "SCALE",
    "USUAL_GAS",
    "ActionCost",
    "Collection",
    "CollectionKind",
    "CollectionTerms",
    "Contract",
    "Edition",
    "EditionTerms",
    "Metadata",
    "SceneToStore",
    "TokenView",
    "Trait",
    "add_call",
    "add_gas",
    "added_edition",
    "address_of",
    "allows",
    "check_code",
    "check_collection_code",
    "check_randomness",
    "check_sale",
    "check_token",
    "chosen_pieces",
    "comparison",
    "development_accounts",
    "edition_at",
    "edition_mint_call",
    "editions_address",
    "editions_of",
    "find_icon",
    "hash_pair",
    "hidden_rounds",
    "icons_of",
    "immutable_places",
    "immutable_values",
    "latest_block",
    "launch",
    "leaf_of",
    "licence_of",
    "make_allow_list",
    "mint_call",
    "open_collection",
    "open_editions",
    "page",
    "parts_of",
    "perform",
    "plan",
    "plan_launch",
    "plan_setup",
    "plan_storage",
    "price_calls",
    "read_allow_list",
    "read_allowance",
    "read_back",
    "read_data_uri",
    "read_token_uri",
    "read_view",
    "read_views",
    "reveal_calls",
    "run_demo",
    "shrink",
    "sign_allowance",
    "store",
    "token_scene",
    "tokens_json",
    "withdraw_gas",
]
