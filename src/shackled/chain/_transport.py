"""JSON-RPC over HTTP: one attempt, a bounded time, a whole answer or an error."""

from __future__ import annotations

import itertools
import json
import re
import threading
import time
from collections.abc import Sequence
from typing import Any, cast
from urllib.parse import urlsplit

import requests
import urllib3

from .. import __version__
from ..errors import NodeError, NodeTimeoutError, NodeUnreachableError
from ..untrusted import read_json
from ._failures import http_failure, too_large

#: Seconds within which a node must take a connection.
CONNECT_PATIENCE = 10
#: A connection that was kept open may be closed meanwhile: if one breaks within these seconds, a new one is tried.
STALE = 1.0
#: Bytes of an answer that are taken; the largest picture has 13 MB, two characters each.
MAX_ANSWER = 64 << 20

HEADERS = {
    "Content-Type": "application/json",
    "Accept": "application/json",
    "User-Agent": f"shackled/{__version__}",
}
BROKEN = "broke off its answer; is it running, or was the picture too much for it?"


class Transport:
    """Sends requests to a node and reads its answers. Several threads may use it at once."""

    def __init__(self, url: str, name: str, timeout: float, local: bool) -> None:
        """timeout: seconds for a whole answer. local: the node is on this machine, behind no proxy."""
        self.url, self.name, self.timeout, self.local = url, name, timeout, local
        self._numbers = itertools.count()
        self._sessions = threading.local()

    def send(self, method: str, parameters: Sequence[Any]) -> dict[str, Any]:
        """Send a request and return the answer, with its `result` or `error`. Raises NodeError and its kinds."""
        number = next(self._numbers)
        request = json.dumps({"jsonrpc": "2.0", "method": method, "params": parameters, "id": number}).encode()
        body = self._post(request)
        try:
            answer = read_json(body.decode())
        except ValueError:
            raise self._no_node("what is not JSON" if body else "nothing") from None
        if not isinstance(answer, dict) or not ("result" in answer or answer.get("error")):
            raise self._no_node("JSON that is not JSON-RPC")
        # an error may come before the number of the request was read
        if answer.get("id") != number and not (answer.get("id") is None and answer.get("error")):
            raise NodeUnreachableError(f"the {self.name} answered another request than the one made; try again")
        return answer

    def _post(self, request: bytes) -> bytes:
        """Return the body of the answer."""
        started = time.monotonic()
        while True:
            kept = hasattr(self._sessions, "session")
            try:
                return self._attempt(request, started + self.timeout)
            except (requests.RequestException, urllib3.exceptions.HTTPError, OSError) as error:
                kind, words = _failure(error)
                if words == BROKEN and kept and time.monotonic() - started < STALE:
                    del self._sessions.session
                    continue
                raise kind(f"the {self.name} {words.format(f'{self.timeout:g}')}") from None

    def _attempt(self, request: bytes, end: float) -> bytes:
        left = max(0.001, end - time.monotonic())
        with self._session().post(
            self.url,
            data=request,
            headers=HEADERS,
            timeout=(min(CONNECT_PATIENCE, left), left),
            stream=True,
            allow_redirects=False,
        ) as response:
            parts, size = [], 0
            # what is there, as it comes: a drop now and then would else go on for ever
            while part := response.raw.read1(1 << 16, decode_content=True):
                parts.append(part)
                size += len(part)
                if size > MAX_ANSWER:
                    raise too_large(self.name, f"more than {MAX_ANSWER >> 20} MB")
                if time.monotonic() > end:
                    raise TimeoutError
            body = b"".join(parts)
        # hosted nodes say with a status of their own what JSON-RPC says in the body
        if response.status_code != 200 and not _is_rpc_error(response.status_code, body, request):
            raise http_failure(self.name, response.status_code, response.headers, body)
        return body

    def _session(self) -> requests.Session:
        """Return the session of this thread."""
        if not hasattr(self._sessions, "session"):
            self._sessions.session = requests.Session()
            self._sessions.session.trust_env = not self.local
        return cast(requests.Session, self._sessions.session)

    def _no_node(self, what: str) -> NodeError:
        return NodeUnreachableError(f"the {self.name} answered with {what}: is this the address of a node?")


def is_address(url: str) -> bool:
    """Return whether a request can be sent there."""
    try:
        requests.Request("POST", url).prepare()
    except (requests.RequestException, ValueError):
        return False
    host = urlsplit(url).netloc.rpartition("@")[2]
    return re.search(r"[\s<>\\^`{|}\"]|\.\.|^[^\[]*%", host) is None


def _failure(error: Exception) -> tuple[type[NodeError], str]:
    """Return the kind of what came in place of an answer, and what to say of the node."""
    reason = getattr(error.args[0], "reason", None) if error.args else None
    if isinstance(error, requests.exceptions.ConnectTimeout):
        return NodeUnreachableError, "takes no connection; is it running, and is its address right?"
    if isinstance(error, requests.Timeout | urllib3.exceptions.TimeoutError | TimeoutError):
        return NodeTimeoutError, "did not answer within {} seconds: take a smaller `size`, or a larger `timeout`"
    if isinstance(error, requests.exceptions.SSLError):
        return NodeUnreachableError, "cannot be reached by a safe connection; is its address right, http or https?"
    if isinstance(error, requests.exceptions.ProxyError):
        return NodeUnreachableError, "cannot be reached through the proxy that is set for this machine"
    if isinstance(reason, urllib3.exceptions.NewConnectionError):
        return NodeUnreachableError, "cannot be reached; is it running, and is its address right?"
    return NodeUnreachableError, BROKEN


def _is_rpc_error(status: int, body: bytes, request: bytes) -> bool:
    """Return whether an answer is a node's refusal of this very request, which says more than the status."""
    if status in (413, 429):
        return False
    try:
        answer = read_json(body.decode())
    except ValueError:
        return False
    if not isinstance(answer, dict) or answer.get("id") not in (None, json.loads(request)["id"]):
        return False
    return isinstance(answer.get("error"), dict) and "message" in answer["error"]
