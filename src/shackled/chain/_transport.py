"""JSON-RPC over HTTP, with a timeout for the whole answer."""

from __future__ import annotations

import itertools
import json
import re
import threading
import time
from collections.abc import Mapping, Sequence
from typing import Any, cast
from urllib.parse import urlsplit

import requests
import urllib3

from .._version import __version__
from ..base.untrusted import read_json
from ..errors import NodeError, NodeTimeoutError, NodeUnreachableError
from ._failures import http_failure, too_large

#: Timeout of connecting, in seconds.
CONNECT_PATIENCE = 10
#: Maximum size of an answer, in bytes; the largest picture has 13 MB, in hexadecimal twice as much.
MAX_ANSWER = 64 << 20

HEADERS = {
    "Content-Type": "application/json",
    "Accept": "application/json",
    "User-Agent": f"shackled/{__version__}",
}


class Transport:
    """Sends requests to a node and reads its answers. Safe for several threads."""

    def __init__(self, url: str, name: str, timeout: float, local: bool) -> None:
        """Take the node's URL and name. timeout: seconds for a whole answer. local: it is on this machine, no proxy."""
        self.url, self.name, self.timeout, self.local = url, name, timeout, local
        self._numbers = itertools.count()
        self._sessions = threading.local()

    def send(self, method: str, parameters: Sequence[Any]) -> dict[str, Any]:
        """Send a request and return the answer, with its `result` or `error`. Raises NodeError or a subclass."""
        number = next(self._numbers)
        request = json.dumps({"jsonrpc": "2.0", "method": method, "params": parameters, "id": number}).encode()
        try:
            status, headers, body = self._post(request, time.monotonic() + self.timeout)
        except (requests.RequestException, urllib3.exceptions.HTTPError, OSError) as error:
            kind, words = _failure(error)
            raise kind(f"the {self.name} {words.format(f'{self.timeout:g}')}") from None
        try:
            answer, what = read_json(body.decode()), "JSON that is not JSON-RPC"
        except ValueError:
            answer, what = None, "an answer that is not JSON" if body else "an empty answer"
        fields = answer if isinstance(answer, dict) else {}
        refusal, is_other = fields.get("error"), fields.get("id") not in (None, number)
        if status != 200:
            # some hosts send JSON-RPC errors, which say more, with another status
            says_more = isinstance(refusal, dict) and "message" in refusal and not is_other
            if status in (413, 429) or not says_more:
                raise http_failure(self.name, status, headers, body)
        if not ("result" in fields or refusal):
            raise NodeUnreachableError(f"the {self.name} sent {what}: is this the address of a node?")
        # an error may come before the node has read the id of the request
        if is_other or (fields.get("id") is None and not refusal):
            raise NodeUnreachableError(f"the {self.name} answered a different request; try again")
        return fields

    def _post(self, request: bytes, end: float) -> tuple[int, Mapping[str, str], bytes]:
        """Send a request; again, if the node had closed the connection that was kept."""
        is_reused, started = hasattr(self._sessions, "session"), time.monotonic()
        try:
            return self._attempt(request, end)
        except requests.ConnectionError as error:
            if not is_reused or isinstance(error, requests.Timeout) or time.monotonic() - started > 1:
                raise
            del self._sessions.session
            return self._attempt(request, end)

    def _attempt(self, request: bytes, end: float) -> tuple[int, Mapping[str, str], bytes]:
        """Send a request and return status, headers and body of the answer. end: when all of it must be there."""
        with self._session().post(
            self.url,
            data=request,
            headers=HEADERS,
            timeout=(min(CONNECT_PATIENCE, self.timeout), self.timeout),
            stream=True,
            allow_redirects=False,
        ) as response:
            parts, size = [], 0
            # whatever has arrived: otherwise a node that sends slowly could exceed the timeout
            while part := response.raw.read1(1 << 16, decode_content=True):
                parts.append(part)
                size += len(part)
                if size > MAX_ANSWER:
                    raise too_large(self.name, f"more than {MAX_ANSWER >> 20} MB")
                if time.monotonic() > end:
                    raise TimeoutError
            return response.status_code, response.headers, b"".join(parts)

    def _session(self) -> requests.Session:
        if not hasattr(self._sessions, "session"):
            self._sessions.session = requests.Session()
            self._sessions.session.trust_env = not self.local
        return cast(requests.Session, self._sessions.session)


def is_address(url: str) -> bool:
    """Return whether requests can be sent to a URL."""
    try:
        requests.Request("POST", url).prepare()
    except (requests.RequestException, ValueError):
        return False
    host = urlsplit(url).netloc.rpartition("@")[2]
    return re.search(r"[\s<>\\^`{|}\"]|\.\.|^[^\[]*%", host) is None


def _failure(error: Exception) -> tuple[type[NodeError], str]:
    """Return the class and the message of the error for a failed request."""
    reason = getattr(error.args[0], "reason", None) if error.args else None
    if isinstance(error, requests.exceptions.ConnectTimeout):
        return NodeUnreachableError, "does not accept connections; is it running, and is its address right?"
    if isinstance(error, requests.Timeout | urllib3.exceptions.TimeoutError | TimeoutError):
        return NodeTimeoutError, "did not answer within {} seconds: use a smaller `size`, or a larger `timeout`"
    if isinstance(error, requests.exceptions.SSLError):
        return NodeUnreachableError, "cannot be reached by TLS; is its address right, http or https?"
    if isinstance(error, requests.exceptions.ProxyError):
        return NodeUnreachableError, "cannot be reached through the configured proxy"
    if isinstance(reason, urllib3.exceptions.NewConnectionError):
        return NodeUnreachableError, "cannot be reached; is it running, and is its address right?"
    return (
        NodeUnreachableError,
        "closed the connection before the end of its answer; is it running, or was the picture too large for it?",
    )
