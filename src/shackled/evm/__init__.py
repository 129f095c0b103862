"""The EVM that runs the contracts in this process: revm as WebAssembly, in wasmtime."""
