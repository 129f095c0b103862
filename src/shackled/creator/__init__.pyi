from ._controls import CONTROLS, GROUPS, MAX_OPACITIES, control, lamp_controls
from ._edition import EditionCalls
from ._history import (
    MAX_STEPS,
    History,
    add_lamp,
    get_value,
    is_changed,
    remove_lamp,
    reset_state,
    reset_value,
    set_value,
)
from ._link import LINK_DICTIONARY, MAX_LINK, from_link, to_link
from ._orbit import drag, fit, front, lamp_camera, lamp_from_disc, lamp_on_disc, pan, zoom
from ._picture import File, Frame, Upload
from ._pool import Pool
from ._presets import PRESETS, apply_look, preset
from ._programs import Subject
from ._queue import PoolError, Queue
from ._sandbox import ForbiddenError, enter_sandbox, upload_folder
from ._scene import (
    Facts,
    bounds_of,
    camera_axes,
    camera_of,
    describe,
    direction,
    filled,
    lamp_of,
    light_of,
    orbit_of,
    to_scene,
)
from ._solidity import contract_name
from ._state import (
    Backdrop,
    Curve,
    Haze,
    Lamp,
    Orbit,
    Outline,
    Pose,
    Size,
    Sky,
    Source,
    State,
    Surface,
    from_document,
    to_document,
)
from ._store import Limits, Store, Stored
from ._takeaway import KINDS, make_file
from ._tasks import Tasks
from ._upload import clean_name
from ._web.actions import ACTIONS, act
from ._web.edition import mint_edition, parse_terms
from ._web.live import ABSENCE, Visitors, live
from ._web.page import KEYS
from ._web.reveal import Reveal, find_reveal, parse_collection, send_reveal
from ._web.server import first_source, make_app, serve, unpack_upload
from ._web.visitor import DRAFT, Visitor
from ._web.wallet import DeclinedError, Waiting, Wallet, WalletError

__all__ = [
    "ABSENCE",
    "ACTIONS",
    "CONTROLS",
    "DRAFT",
    "GROUPS",
    "KEYS",
    "KINDS",
    "LINK_DICTIONARY",
    "MAX_LINK",
    "MAX_OPACITIES",
    "MAX_STEPS",
    "PRESETS",
    "Backdrop",
    "Curve",
    "DeclinedError",
    "EditionCalls",
    "Facts",
    "File",
    "ForbiddenError",
    "Frame",
    "Haze",
    "History",
    "Lamp",
    "Limits",
    "Orbit",
    "Outline",
    "Pool",
    "PoolError",
    "Pose",
    "Queue",
    "Reveal",
    "Size",
    "Sky",
    "Source",
    "State",
    "Store",
    "Stored",
    "Subject",
    "Surface",
    "Tasks",
    "Upload",
    "Visitor",
    "Visitors",
    "Waiting",
    "Wallet",
    "WalletError",
    "act",
    "add_lamp",
    "apply_look",
    "bounds_of",
    "camera_axes",
    "camera_of",
    "clean_name",
    "contract_name",
    "control",
    "describe",
    "direction",
    "drag",
    "enter_sandbox",
    "filled",
    "find_reveal",
    "first_source",
    "fit",
    "from_document",
    "from_link",
    "front",
    "get_value",
    "is_changed",
    "lamp_camera",
    "lamp_controls",
    "lamp_from_disc",
    "lamp_of",
    "lamp_on_disc",
    "light_of",
    "live",
    "make_app",
    "make_file",
    "mint_edition",
    "orbit_of",
    "pan",
    "parse_collection",
    "parse_terms",
    "preset",
    "remove_lamp",
    "reset_state",
    "reset_value",
    "send_reveal",
    "serve",
    "set_value",
    "to_document",
    "to_link",
    "to_scene",
    "unpack_upload",
    "upload_folder",
    "zoom",
]
