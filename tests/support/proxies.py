"""A proxy in front of a node that misbehaves when it is asked for pictures."""

from __future__ import annotations

import itertools
import json
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from typing import Any

from nodes import Reply, failure, forward, result, serving

#: What a proxy does with the n-th picture that is asked of it, counted from 0; "" passes it on.
#:
#: "kill" breaks off, "429" asks to come again at once, "half" sends half of the answer, "wrong" another picture,
#: "empty" no bytes, "junk" bytes that are no picture, "stuck" answers after three seconds, "lie" says that the contract
#: refuses.
Manners = Callable[[int], str]


def always(manner: str) -> Manners:
    """The same each time."""
    return lambda number: manner


def each_third(manner: str) -> Manners:
    """Passes two in three on."""
    return lambda number: manner if number % 3 == 1 else ""


def at(count: int, manner: str) -> Manners:
    """Misbehaves once."""
    return lambda number: manner if number == count else ""


def proxy(target: str, manners: Manners, asked: list[str] | None = None) -> AbstractContextManager[str]:
    """The address of the proxy. asked: where it notes what it did with each picture."""
    numbers = itertools.count()

    def answer(request: dict[str, Any]) -> Reply:
        # what is asked to get to know a node is short
        if len(json.dumps(request)) < 5000:
            return forward(target, request)
        manner = manners(next(numbers))
        if asked is not None:
            asked.append(manner)
        if manner == "kill":
            return Reply(b"?", cut=0)
        if manner == "429":
            return Reply(status=429, headers={"Retry-After": "0"})
        if manner in ("empty", "junk"):
            return result("0x" + ("ab" * 500 if manner == "junk" else ""))
        if manner == "lie":
            return failure("execution reverted", 3, "0x" + "12" * 36)
        time.sleep(3 if manner == "stuck" else 0)
        reply = forward(target, request)
        if manner == "half":
            return replace(reply, cut=len(reply.body) // 2)
        return replace(reply, body=_repainted(reply.body)) if manner == "wrong" else reply

    return serving(answer)


def _repainted(body: bytes) -> bytes:
    """The same answer with another colour in the middle of the picture."""
    answer = json.loads(body)
    result = answer.get("result", "")
    if len(result) > 1000:
        middle = len(result) // 2
        answer["result"] = result[:middle] + ("0" if result[middle] != "0" else "f") + result[middle + 1 :]
    return json.dumps(answer).encode()


@dataclass
class Liar:
    """What a lying node makes of answers: by method, another result of the right one and the parameters. It lies while
    `lying` holds.
    """

    lies: dict[str, Callable[[Any, list[Any]], Any]]
    lying: bool = True

    def before(self, target: str) -> AbstractContextManager[str]:
        """The address of the liar, in front of an honest node."""

        def answer(request: dict[str, Any]) -> Reply:
            reply = forward(target, request)
            lie = self.lies.get(request["method"])
            if lie is None or not self.lying:
                return reply
            told = json.loads(reply.body)
            return result(lie(told["result"], request["params"])) if told.get("result") is not None else reply

        return serving(answer)
