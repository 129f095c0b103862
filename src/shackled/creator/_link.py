"""A state as a short text for the address of the page, and back.

The text is a digit, the version, and then base64url of the JSON object of the state, compressed by raw deflate with a
dictionary of frequent parts. It is untrusted input: every value is checked, and the unpacked size is bounded.
"""

from __future__ import annotations

import base64
import binascii
import ipaddress
import json
import re
import zlib
from urllib.parse import urlsplit

from ..errors import InputError
from ._state import State, from_document, to_document

#: Note for links to a loopback address.
LOCAL = "The link works on this computer only."

VERSION = "1"
#: Largest number of bytes of a link, and of the JSON in it.
MAX_LINK = 4096
MAX_DOCUMENT = 8192

#: Frequent parts of the JSON, the most frequent last. A change needs a new version.
LINK_DICTIONARY = (
    b'"max_triangles":"invert":true"wireframe":true"cull":false"ambient_light":"#ffffff""lights_follow":true'
    b'"background":{"top":"#000000","bottom":"#ffffff"}"size":{"width":256,"height":256}'
    b'"shading":"smooth""flat""unlit""ambient":0."diffuse":0."specular":0."shininess":"color":"#'
    b'"pose":{"position":[0.0,0.0,0.0],"rotation":[0.0,0.0,0.0],"scale":"surface":{'
    b'"lights":[{"kind":"point","azimuth":-"elevation":"distance":"color":"#ffffff"},{"azimuth":'
    b'"camera":{"target":[0.0,0.0,0.0],"distance":3."azimuth":"elevation":"roll":"projection":"orthographic","fov":'
    b'{"source":{"kind":"upload","name":"genesis/icons/'
    b'{"source":{"kind":"piece","name":"teapot"},'
)


def is_local(address: str) -> bool:
    """Return whether an address of the page is a loopback address."""
    host = urlsplit(address).hostname or ""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


def to_link(state: State) -> str:
    """Return the text of a state: letters, digits, - and _ only."""
    document = json.dumps(to_document(state), separators=(",", ":")).encode("ascii")
    squeezer = zlib.compressobj(9, zlib.DEFLATED, -15, zdict=LINK_DICTIONARY)
    packed = squeezer.compress(document) + squeezer.flush()
    return VERSION + base64.urlsafe_b64encode(packed).rstrip(b"=").decode("ascii")


def from_link(text: str) -> State:
    """Return the state of a text. InputError if the text is not a link."""
    if len(text) > MAX_LINK:
        raise InputError(f"the link is too long: {len(text):,} characters, at most {MAX_LINK:,} are read")
    if not re.fullmatch(r"[0-9A-Za-z_-]+", text, re.ASCII):
        raise InputError("the link has characters that are not allowed; copy exactly the whole link")
    if text[0] != VERSION:
        raise InputError(f"the link is damaged or of another version: it begins with {text[0]!r}, not with {VERSION}")
    try:
        packed = base64.b64decode(text[1:] + "=" * (-(len(text) - 1) % 4), altchars=b"-_", validate=True)
        opener = zlib.decompressobj(-15, zdict=LINK_DICTIONARY)
        document = opener.decompress(packed, MAX_DOCUMENT)
        if opener.unconsumed_tail:
            raise InputError(f"the link holds more than {MAX_DOCUMENT:,} bytes")
        if not opener.eof or opener.unused_data:
            raise InputError("the link is damaged; copy exactly the whole link")
        value = json.loads(document.decode("ascii"))
    except (binascii.Error, zlib.error, ValueError, RecursionError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError("the link is damaged; copy exactly the whole link") from None
    try:
        return from_document(value)
    except InputError as error:
        raise InputError(f"the link does not describe a picture: {error}") from None
