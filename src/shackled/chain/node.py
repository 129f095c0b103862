"""A node that is asked over JSON-RPC, with nothing deployed: each call brings the code of the contracts along."""

from __future__ import annotations

from typing import Any
from urllib.parse import urlsplit

from ..artifacts import artifact
from ..errors import InputError, OutOfGasError, RenderError
from ..scene.codec import Rectangle, encode
from ..scene.scene import Scene
from .chain import Drawing, returned_bytes, returned_counts
from .embedded import EmbeddedChain, intrinsic_gas
from .refusal import out_of_gas, refusal

#: Seconds that a node may take for a picture.
PATIENCE = 120

#: What nodes say, in small letters and without spaces, where a call has used up its gas.
OUT_OF_GAS = ("outofgas", "gastoolow", "intrinsicgas", "callgascost")


class NodeChain:
    """Makes calls by `eth_call` with state overrides, which put the contracts where nothing is.

    A node does not say what such a call has cost, so that pictures have no gas here.
    """

    def __init__(self, url: str, local: EmbeddedChain) -> None:
        """`local` sets up the contracts whose code is sent. InputError if the address is none."""
        from web3 import HTTPProvider

        parts = urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise InputError(f"--rpc must be the address of a node, as http://127.0.0.1:8545, not {url!r}")
        # an address may hold a key in its path or before its host
        self.name = f"node {parts.hostname}" + (f":{parts.port}" if parts.port else "")
        self._local = local
        # a call that took too long would take so again
        self._provider = HTTPProvider(url, {"timeout": PATIENCE}, exception_retry_configuration=None)

    def call(self, contract: str, data: bytes, gas_limit: int | None = None) -> bytes:
        """Calls a contract, by the name of its artifact; None leaves the limit to the node.

        RenderError if the contract refuses, the gas does not suffice, or the node does not do it.
        """
        address = self._local.address(contract)
        request = {"to": "0x" + address.hex(), "data": "0x" + data.hex()}
        if gas_limit is not None:
            request["gas"] = hex(gas_limit + intrinsic_gas(data))
        codes = {"0x" + place.hex(): {"code": "0x" + code.hex()} for place, code in self._local.codes().items()}
        answer = self._request("eth_call", [request, "latest", codes])
        if "error" in answer:
            raise self._failure(answer["error"], gas_limit)
        result = answer.get("result")
        if not isinstance(result, str) or not result.startswith("0x") or len(result) % 2:
            raise RenderError(f"the {self.name} answered with what is no result of a call: {result!r:.60}")
        return bytes.fromhex(result[2:])

    def draw(self, scene: Scene, tile: Rectangle | None = None) -> Drawing:
        """The picture of a scene, or of a part of its canvas."""
        data = encode(artifact("Renderer").selectors["render" if tile is None else "renderTile"], scene, tile)
        return Drawing(returned_bytes(self.call("Renderer", data), 0), None, intrinsic_gas(data))

    def count(self, scene: Scene) -> tuple[int, int]:
        """The triangles that survive culling and clipping, and the pixels that any of them covers."""
        return returned_counts(self.call("Renderer", encode(artifact("Renderer").selectors["renderCounted"], scene)))

    def _request(self, method: str, parameters: list[Any]) -> dict[str, Any]:
        import requests

        try:
            answer: Any = self._provider.make_request(method, parameters)
        except requests.Timeout:
            raise RenderError(f"the {self.name} did not answer within {PATIENCE} seconds") from None
        except requests.ConnectionError:
            raise RenderError(f"the {self.name} cannot be reached; is it running, and is its address right?") from None
        except requests.HTTPError as error:
            status = "unknown" if error.response is None else str(error.response.status_code)
            hint = "; it asks to be called less often" if status == "429" else ""
            raise RenderError(f"the {self.name} answered with HTTP status {status}{hint}") from None
        except (ValueError, requests.RequestException) as error:
            raise RenderError(f"the {self.name} answered with what is not JSON-RPC: {str(error)[:80]}") from None
        if not isinstance(answer, dict):
            raise RenderError(f"the {self.name} answered with what is not JSON-RPC: {answer!r:.60}")
        return answer

    def _failure(self, error: Any, gas_limit: int | None) -> RenderError:
        message = str(error.get("message", error) if isinstance(error, dict) else error)
        data = error.get("data") if isinstance(error, dict) else None
        if isinstance(data, str) and data.startswith("0x") and len(data) >= 10:
            failure = refusal(bytes.fromhex(data[2:]), gas_limit or 0)
        elif any(words in message.lower().replace(" ", "") for words in OUT_OF_GAS):
            failure = out_of_gas(gas_limit or 0)
        else:
            failure = RenderError(f"the {self.name} says: {' '.join(message.split())[:200]}")
        if isinstance(failure, OutOfGasError) and gas_limit is None:
            hint = "take a smaller --size, or raise its limit"
            return OutOfGasError(f"the {self.name} allows a call too little gas for this: {hint}")
        return failure
