"""Store an object in the Studio of a chain, and let the Studio draw it from its pointer.

SHACKLED_RPC has the address of a node, KEY the private key of an account that pays; both default to those of `anvil`.
"""

import os

import shackled
from shackled.chain import Connection
from shackled.deploy import Transactor, environment_account
from shackled.tokens import Wanted, plan_storage, read_back, store

os.environ.setdefault("KEY", "0xac0974bec39a17e36ba4a6b4d238ff944bacb478cbed5efcae784d7bf4f2ff80")
connection = Connection(os.environ.get("SHACKLED_RPC", "http://127.0.0.1:8545"))

pyramid = shackled.Mesh([(-1, 0, 1), (1, 0, 1), (0, 0, -1), (0, 2, 0)], [(0, 1, 3), (1, 2, 3), (2, 0, 3)], "gold")
wanted = Wanted("pyramid", shackled.load(pyramid, size=32))
storage = plan_storage(connection, [wanted])
print(f"storing takes {storage.gas:,} gas, with the missing contracts {storage.gas + storage.parts.gas:,}")
store(storage, Transactor(connection, environment_account("KEY")))

image = read_back(connection, storage.studio, storage.pointers[0], wanted)
image.save("pyramid.png")
print(f"the Studio {storage.studio} draws {storage.pointers[0]} for {image.gas:,} gas")
