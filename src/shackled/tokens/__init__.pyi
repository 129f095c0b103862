from ._actions import USUAL, perform, plan
from ._allow_list import hash_pair, leaf_of, make_allow_list, read_allow_list, verify
from ._allowance import read_allowance, sign_allowance
from ._collection import Collection, open_collection
from ._contract import Contract
from ._demo import run
from ._deploying import Offer, address_of, launch, parts_of, plan_launch
from ._development import development_accounts
from ._equipping import plan_equipment
from ._gallery import Shown, page, tokens_json
from ._icons import SCALE, add_call, check_sale, chosen_pieces, find_icon, icons_of
from ._immutables import immutable_places, immutable_values
from ._kept import expand_zeros, kept_codes, meshes_of
from ._kinds import KINDS, Kind
from ._licence import licence_of
from ._listing import read_all, trait_columns
from ._metadata import MAX_LENGTH, Metadata, Trait, read_data_uri, read_token_uri, shrink
from ._minting import mint_call
from ._picture_file import check_picture_file, save_picture, write_picture
from ._randomness import check_randomness
from ._refusals import PHASES
from ._reveal import HEADERS_AT_ONCE, KNOWN_BLOCKS_BEFORE, hidden_rounds, latest_block, price_steps, steps
from ._storage import Wanted, plan_storage, read_back, store
from ._table import Cost, comparison, markdown
from ._verify import check_code, check_collection_code, check_token

__all__ = [
    "HEADERS_AT_ONCE",
    "KINDS",
    "KNOWN_BLOCKS_BEFORE",
    "MAX_LENGTH",
    "PHASES",
    "SCALE",
    "USUAL",
    "Collection",
    "Contract",
    "Cost",
    "Kind",
    "Metadata",
    "Offer",
    "Shown",
    "Trait",
    "Wanted",
    "add_call",
    "address_of",
    "check_code",
    "check_collection_code",
    "check_picture_file",
    "check_randomness",
    "check_sale",
    "check_token",
    "chosen_pieces",
    "comparison",
    "development_accounts",
    "expand_zeros",
    "find_icon",
    "hash_pair",
    "hidden_rounds",
    "icons_of",
    "immutable_places",
    "immutable_values",
    "kept_codes",
    "latest_block",
    "launch",
    "leaf_of",
    "licence_of",
    "make_allow_list",
    "markdown",
    "meshes_of",
    "mint_call",
    "open_collection",
    "page",
    "parts_of",
    "perform",
    "plan",
    "plan_equipment",
    "plan_launch",
    "plan_storage",
    "price_steps",
    "read_all",
    "read_allow_list",
    "read_allowance",
    "read_back",
    "read_data_uri",
    "read_token_uri",
    "run",
    "save_picture",
    "shrink",
    "sign_allowance",
    "steps",
    "store",
    "tokens_json",
    "trait_columns",
    "verify",
    "write_picture",
]
