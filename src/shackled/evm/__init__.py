"""The EVM that runs the contracts in this process: revm as WebAssembly, in wasmtime."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
