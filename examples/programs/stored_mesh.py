"""Store an object in the Studio of a chain, and let the Studio draw it from its pointer.

SHACKLED_RPC has the address of a node, KEY the private key of the account that pays.
"""

import os

import shackled
from shackled.chain import Connection
from shackled.deploy import Transactor, environment_account
from shackled.tokens import SceneToStore, plan_storage, read_back, store

if not {"SHACKLED_RPC", "KEY"} <= os.environ.keys():
    raise SystemExit("set SHACKLED_RPC to the address of a node, and KEY to the private key of the account that pays")
connection = Connection(os.environ["SHACKLED_RPC"])
points = [(-1, 0, 1), (1, 0, 1), (0, 0, -1), (0, 2, 0)]
pyramid = shackled.Mesh(points, [(0, 1, 3), (1, 2, 3), (2, 0, 3)], "gold")
wanted = SceneToStore("pyramid", shackled.load(pyramid, size=32))
storage = plan_storage(connection, [wanted])
print(f"{storage.gas:,} gas to store it, {storage.parts.gas:,} gas for missing contracts")
store(storage, Transactor(connection, environment_account("KEY")))

image = read_back(connection, storage.studio, storage.pointers[0], wanted)
image.save("pyramid.png")
print(f"the Studio {storage.studio} draws {storage.pointers[0]} for {image.gas:,} gas")
