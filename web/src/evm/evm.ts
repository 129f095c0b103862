// The host of evm.wasm, which evm/ builds: contracts in memory, and calls of them.

import { InputError } from "../errors.js";

/** How a call ended, as evm/src/calls.rs says. */
export type Status = "success" | "revert" | "out of gas" | "failure";
const STATUSES: readonly Status[] = ["success", "revert", "out of gas", "failure"];

/** What a call returned, or the data of its revert, or the reason of its failure as text; and the gas of its execution. */
export interface Answer {
    status: Status;
    output: Uint8Array;
    gas: number;
}

/** Enough for pictures of 2048 x 2048 pixels; bounds the time of a call, and its memory to 130 MB. */
export const GAS_LIMIT = 30_000_000_000;
/** From here on gas would pay for more memory than numbers of 32 bits can address. */
const MAX_GAS = 2 ** 45;
/** The most bytes of code or of a call. */
const MAX_BYTES = 1 << 26;
const ADDRESS = 20;
/** Instructions of a region of compiled code, and how many contracts are compiled at most. */
const REGION = 25;
const MOST_COMPILED = 24;

/** Modules whose function calls itself at its end, and multiplies two numbers of 64 bits. */
const START = [0, 97, 115, 109, 1, 0, 0, 0];
const TAIL_CALL = [...START, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 10, 6, 1, 4, 0, 18, 0, 11];
const TYPE = [1, 8, 1, 96, 2, 126, 126, 2, 126, 126, 3, 2, 1, 0];
const WIDE = [...START, ...TYPE, 10, 10, 1, 8, 0, 32, 0, 32, 1, 252, 22, 11];
const has = (module: number[]): boolean => WebAssembly.validate(new Uint8Array(module));

interface Exports {
    memory: WebAssembly.Memory;
    allocate(size: number): number;
    release(start: number, size: number): void;
    put(address: number, code: number, size: number): void;
    call(address: number, data: number, size: number, gas: bigint): number;
    send(address: number, value: number, data: number, size: number, gas: bigint): number;
    describe(address: number, places: number, size: number): void;
    profile(address: number, data: number, size: number, gas: bigint): number;
    busiest(address: number, least: bigint): bigint;
    compile(code: number, size: number, region: number, isWide: number): number;
    module(): number;
    link(address: number, run: number): void;
    __indirect_function_table: WebAssembly.Table;
    table(): number;
    table_size(): number;
    answer(): number;
    answer_size(): number;
    gas_used(): bigint;
}

/**
 * An EVM with the rules of Cancun. Every call starts from the state that `put` and `send` left, so that the same call costs
 * the same gas.
 */
export class Evm {
    readonly #module: WebAssembly.Module;
    readonly #codes = new Map<string, [Uint8Array, Uint8Array]>();
    readonly #places = new Map<string, [Uint8Array, Uint8Array]>();
    #exports: Exports | null = null;
    #isCompiling = false;
    #compiled = 0;

    /** Take the compiled module of evm.wasm. */
    constructor(module: WebAssembly.Module) {
        this.#module = module;
    }

    /** Return an EVM from the bytes of evm.wasm, a response with them, or the compiled module. */
    static async load(source: BufferSource | Response | WebAssembly.Module): Promise<Evm> {
        return new Evm(await moduleOf(source));
    }

    /** Set the code of a contract. */
    put(address: Uint8Array, code: Uint8Array): void {
        checkAddress(address);
        checkSize(code, "the code");
        this.#codes.set(String(address), [address.slice(), code.slice()]);
        if (this.#exports) this.#put(this.#exports, address, code);
    }

    /** Describe the code of a contract for `profile`, by 6 bytes for each position, as evm/src/profile.rs says. */
    describe(address: Uint8Array, places: Uint8Array): void {
        checkAddress(address);
        checkSize(places, "the description");
        this.#places.set(String(address), [address.slice(), places.slice()]);
        if (this.#exports) this.#describe(this.#exports, address, places);
    }

    /** Call a contract with at most `gas` for the execution. */
    call(address: Uint8Array, data: Uint8Array, gas = GAS_LIMIT): Answer {
        return this.#run("call", address, data, gas, ({ answer }) => answer);
    }

    /** Call a contract with a value in wei, and keep what the call changes, until the EVM has to start anew after a failure. */
    send(address: Uint8Array, data: Uint8Array, gas = GAS_LIMIT, value = 0n): Answer {
        const wei = new Uint8Array(32);
        for (let place = 31, left = value; left; left >>= 8n) wei[place--] = Number(left & 255n);
        return this.#run("send", address, data, gas, ({ answer }) => answer, wei);
    }

    /**
     * Call a contract, and count the gas of each instruction of the contracts that are described. The table is that of
     * evm/src/profile.rs. It takes several times as long as `call`.
     */
    profile(address: Uint8Array, data: Uint8Array, gas = GAS_LIMIT): { answer: Answer; table: Uint32Array } {
        return this.#run("profile", address, data, gas, ({ answer, exports }) => {
            const table = new Uint32Array(exports.memory.buffer, exports.table(), exports.table_size()).slice();
            return { answer, table };
        });
    }

    /**
     * Compile the contracts that used at least so much gas so far: later calls of them are faster, and return the same bytes
     * for the same gas. Does nothing where WebAssembly has no tail calls; what cannot be compiled stays as it is.
     */
    async compile(least: number): Promise<void> {
        if (this.#isCompiling || !has(TAIL_CALL)) return;
        this.#isCompiling = true;
        try {
            while (this.#compiled < MOST_COMPILED && (await this.#compileBusiest(least)));
        } catch {
            // too little memory, or a policy of the page: the interpreter goes on
            this.#compiled = MOST_COMPILED;
        } finally {
            this.#isCompiling = false;
        }
    }

    async #compileBusiest(least: number): Promise<boolean> {
        const exports = this.#exports;
        if (!exports) return false;
        const [address, isBusy] = passed(exports, [new Uint8Array(ADDRESS)], (place) => {
            const gas = exports.busiest(place, BigInt(least));
            return [new Uint8Array(exports.memory.buffer, place, ADDRESS).slice(), gas > 0n] as const;
        });
        if (!isBusy) return false;
        const code = this.#codes.get(String(address))?.[1];
        const translate = (place: number): number =>
            exports.compile(place, code?.length ?? 0, REGION, Number(has(WIDE)));
        const size = code ? passed(exports, [code], translate) : 0;
        if (!size) return true;
        this.#compiled++;
        const bytes = new Uint8Array(exports.memory.buffer, exports.module(), size).slice();
        const { instance } = await WebAssembly.instantiate(bytes, { evm: { ...exports } });
        const table = exports.__indirect_function_table;
        const place = table.grow(1);
        table.set(place, instance.exports.run);
        passed(exports, [address], (at) => exports.link(at, place));
        return true;
    }

    #run<T>(
        name: "call" | "send" | "profile",
        address: Uint8Array,
        data: Uint8Array,
        gas: number,
        read: (done: { answer: Answer; exports: Exports }) => T,
        value?: Uint8Array,
    ): T {
        checkAddress(address);
        checkSize(data, "the call");
        if (typeof gas !== "number" || !(gas >= 0 && gas < MAX_GAS))
            throw new InputError(`gas must be a number of at least 0 and less than 2^45, not ${String(gas)}`);
        const exports = (this.#exports ??= this.#start());
        try {
            const limit = BigInt(Math.floor(gas));
            const status = passed(exports, value ? [address, data, value] : [address, data], (to, start, wei) =>
                name === "send"
                    ? exports.send(to, wei, start, data.length, limit)
                    : exports[name](to, start, data.length, limit),
            );
            const place = exports.answer();
            const output = new Uint8Array(exports.memory.buffer, place, exports.answer_size()).slice();
            const answer = { status: STATUSES[status] ?? "failure", output, gas: Number(exports.gas_used()) };
            return read({ answer, exports });
        } catch (error) {
            // an instance that trapped is not used again
            this.#exports = null;
            if (!(error instanceof WebAssembly.RuntimeError || error instanceof RangeError)) throw error;
            throw new InputError("the EVM stopped: the call needs more memory than there is, or than 1 GiB");
        }
    }

    #start(): Exports {
        const exports = new WebAssembly.Instance(this.#module).exports as unknown as Exports;
        for (const [address, code] of this.#codes.values()) this.#put(exports, address, code);
        for (const [address, places] of this.#places.values()) this.#describe(exports, address, places);
        return exports;
    }

    #put(exports: Exports, address: Uint8Array, code: Uint8Array): void {
        passed(exports, [address, code], (at, start) => exports.put(at, start, code.length));
    }

    #describe(exports: Exports, address: Uint8Array, places: Uint8Array): void {
        passed(exports, [address, places], (at, start) => exports.describe(at, start, places.length));
    }
}

/** Return the compiled module of evm.wasm. */
export async function moduleOf(source: BufferSource | Response | WebAssembly.Module): Promise<WebAssembly.Module> {
    if (source instanceof WebAssembly.Module) return source;
    // servers that do not know the type of .wasm files are no obstacle
    return WebAssembly.compile(source instanceof Response ? await source.arrayBuffer() : source);
}

/** Return what a function returns for the places of values in memory. */
function passed<T>(
    exports: Exports,
    values: readonly Uint8Array[],
    use: (...places: [number, number, number]) => T,
): T {
    const places = values.map((value) => exports.allocate(value.length));
    // only now: `allocate` may replace the buffer
    const memory = new Uint8Array(exports.memory.buffer);
    values.forEach((value, index) => memory.set(value, places[index]));
    const result = use(...(places as [number, number, number]));
    values.forEach((value, index) => exports.release(places[index], value.length));
    return result;
}

function checkAddress(address: Uint8Array): void {
    if (!(address instanceof Uint8Array) || address.length !== ADDRESS) {
        throw new InputError(`an address must be a Uint8Array of ${ADDRESS} bytes`);
    }
}

function checkSize(bytes: Uint8Array, name: string): void {
    if (!(bytes instanceof Uint8Array)) throw new InputError(`${name} must be a Uint8Array`);
    if (bytes.length > MAX_BYTES)
        throw new InputError(`${name} must have up to ${MAX_BYTES} bytes, not ${bytes.length}`);
}
