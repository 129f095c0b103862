// Times of calls in evm.wasm, interpreted and compiled, which take turns: for benchmarks/evms.py, in Node and in a page.

const REGION = 25;

function bytes(hex) {
    return Uint8Array.from(hex.match(/../g) ?? [], (byte) => parseInt(byte, 16));
}

/** Return an instance that holds contracts, and a function that puts bytes into its memory. */
async function start(module, codes, isCompiled) {
    const { exports } = await WebAssembly.instantiate(module);
    const put = (value) => {
        const place = exports.allocate(value.length);
        new Uint8Array(exports.memory.buffer, place, value.length).set(value);
        return place;
    };
    for (const [address, code] of Object.entries(codes)) {
        const [to, value] = [put(bytes(address)), bytes(code)];
        exports.put(to, put(value), value.length);
        if (!isCompiled) continue;
        const size = exports.compile(put(value), value.length, REGION, 0);
        const made = new Uint8Array(exports.memory.buffer, exports.module(), size).slice();
        const { instance } = await WebAssembly.instantiate(made, { evm: { ...exports } });
        const run = exports.__indirect_function_table.grow(1);
        exports.__indirect_function_table.set(run, instance.exports.run);
        exports.link(to, run);
    }
    return { exports, put };
}

/** Return by call: its gas, and the milliseconds of each round, interpreted and compiled. */
async function measure({ evm, codes, to, calls, rounds }) {
    const module = await WebAssembly.compile(Uint8Array.from(atob(evm), (letter) => letter.charCodeAt(0)));
    const machines = [await start(module, codes, false), await start(module, codes, true)];
    const found = {};
    for (const [name, call] of Object.entries(calls)) {
        const data = bytes(call);
        const places = machines.map(({ put }) => [put(bytes(to)), put(data)]);
        const times = [[], []];
        const gas = new Set();
        // the engine compiles what runs often in the first rounds
        for (let round = -4; round < rounds; round++) {
            machines.forEach(({ exports }, kind) => {
                const begin = performance.now();
                const status = exports.call(...places[kind], data.length, 30_000_000_000n);
                if (round >= 0) times[kind].push(performance.now() - begin);
                if (status) throw new Error(`${name} ended with ${status}`);
                gas.add(Number(exports.gas_used()));
            });
        }
        if (gas.size > 1) throw new Error(`${name} took ${[...gas].join(" and ")} gas`);
        found[name] = [...gas, ...times];
    }
    return found;
}
