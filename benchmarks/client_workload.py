"""Write the nine pictures of benchmarks.evms as a workload for EVM clients.

The code of contracts, the data of calls, the hashes of their outputs.

    python -m benchmarks.client_workload

writes the files of benchmarks/client.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from shackled.artifacts import RENDERER
from shackled.chain._embedded import RevmChain
from shackled.errors import ChainError
from shackled.ethereum._encoding import keccak256, to_hex
from shackled.evm._instance import Answer, Instance, Status
from shackled.scene._codec import render_call

from . import run_main
from .evms import PICTURES, scene

FOLDER = Path(__file__).with_name("client")
GAS = 1 << 28
#: The forks of a chain configuration that begin at block 0, and at time 0.
FORKS = (
    "homesteadBlock",
    "eip150Block",
    "eip155Block",
    "eip158Block",
    "byzantiumBlock",
    "constantinopleBlock",
    "petersburgBlock",
    "istanbulBlock",
    "berlinBlock",
    "londonBlock",
    "shanghaiTime",
    "cancunTime",
)

README = """# A workload for EVM clients

{pictures} read calls that draw pictures: arithmetic, memory, and a call between contracts, under the Cancun
rules. Each always returns the same bytes for the same gas. A client that returns different bytes, or uses a
different amount of gas, is faulty.

| file | contents |
| --- | --- |
| [state.json](state.json) | the runtime code of {contracts} contracts by address, as the `alloc` of a genesis file |
| `*.hex` | the data of each call |
| [expected.json](expected.json) | by call: execution gas, and size, Keccak-256 and SHA-256 of the output |

| call | bytes of data | execution gas, without the intrinsic gas of a transaction |
| --- | ---: | ---: |
{rows}

All calls are to {to}. To run one with geth's `evm` tool:

```
evm --prestate state.json --inputfile {first}.hex --gas {limit} \\
    --receiver {to} --bench run
```

The chain configuration in `state.json` has all forks up to Cancun from the start. The command has not been
tried, because geth was not available; a test runs the files in revm.

Written by `python -m benchmarks.client_workload`.
"""


def file_name(picture: str) -> str:
    """Return the name of a picture's files, without a suffix."""
    return picture.lower().replace(",", "").replace(" ", "-")


def call(codes: dict[bytes, bytes], to: bytes, data: bytes) -> Answer:
    """Run a call in revm."""
    evm = Instance()
    evm.hold(codes)
    return evm.call(to, data, GAS)


def needed(codes: dict[bytes, bytes], to: bytes, data: bytes) -> dict[bytes, bytes]:
    """Return the codes without which a call would end otherwise. ChainError if it fails with all."""
    whole = call(codes, to, data)
    if whole.status != Status.SUCCESS:
        raise ChainError(f"the call ended with {whole.status.name}")
    kept = {}
    for address, code in codes.items():
        others = {each: value for each, value in codes.items() if each != address}
        if call(others, to, data) != whole:
            kept[address] = code
    return kept


def files() -> dict[str, str]:
    """Return the texts of the files by name."""
    chain = RevmChain()
    to = chain.address("Renderer")
    own = {chain.address(name) for name in RENDERER}
    all_ = {address: code for address, code in chain.codes().items() if address in own}
    calls = {file_name(name): render_call(scene(name)) for name in PICTURES}
    codes: dict[bytes, bytes] = {}
    expected, rows = {}, []
    for name, data in calls.items():
        codes |= needed(all_, to, data)
        answer = call(all_, to, data)
        expected[name] = {
            "to": to_hex(to),
            "gas": answer.gas,
            "output bytes": len(answer.output),
            "output keccak256": keccak256(answer.output).hex(),
            "output sha256": hashlib.sha256(answer.output).hexdigest(),
        }
        rows.append(f"| [{name}]({name}.hex) | {len(data):,} | {answer.gas:,} |")
    config = dict.fromkeys(FORKS, 0) | {"chainId": 1, "terminalTotalDifficulty": 0}
    alloc = {to_hex(address): {"balance": "0x0", "code": to_hex(code)} for address, code in sorted(codes.items())}
    state = {"config": config, "gasLimit": hex(GAS), "difficulty": "0x0", "alloc": alloc}
    return {
        "state.json": json.dumps(state, indent=1) + "\n",
        "expected.json": json.dumps(expected, indent=1) + "\n",
        "README.md": README.format(
            pictures=len(calls),
            contracts=len(codes),
            rows="\n".join(rows),
            to=to_hex(to),
            first=next(iter(calls)),
            limit=GAS,
        ),
        **{f"{name}.hex": data.hex() + "\n" for name, data in calls.items()},
    }


def stale() -> list[str]:
    """Return the names of the files that are not up to date."""
    return [
        name
        for name, text in files().items()
        if not (FOLDER / name).is_file() or (FOLDER / name).read_text("utf-8") != text
    ]


def main() -> int:
    """Write the files."""
    FOLDER.mkdir(exist_ok=True)
    for name, text in files().items():
        (FOLDER / name).write_text(text, "utf-8", newline="\n")
        print(f"written: {name}")
    return 0


if __name__ == "__main__":
    run_main(main)
