"""A worker process: `python -m shackled.parallel.worker` renders the parts that come in by standard input."""

from __future__ import annotations

import os
import pickle
import sys
from typing import Any

from .evm import limited
from .part import draw_part


def serve() -> None:
    """Answers each question, (scene, tile), with a Drawing, or with the kind of an error and its message."""
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    # what a library may print goes where people look
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    try:
        chain, gas = pickle.load(sys.stdin.buffer)
        place = limited(chain, gas)
        while True:
            question = pickle.load(sys.stdin.buffer)
            answer: Any
            try:
                answer = draw_part(place, *question)
            except Exception as error:
                answer = (type(error).__name__, " ".join(str(error).split()) or repr(error))
            pickle.dump(answer, answers, pickle.HIGHEST_PROTOCOL)
            answers.flush()
    except (EOFError, OSError):
        return


if __name__ == "__main__":
    serve()
