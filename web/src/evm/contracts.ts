// The contracts that draw: their code and addresses, and what their errors mean. tools/build_web.py writes contracts.json.

import { InputError } from "../errors.js";
import { fromHex, toHex, wordAt } from "../bytes.js";
import { Evm, GAS_LIMIT, type Answer } from "./evm.js";
import { RENDERER, type ContractName } from "./names.js";
import { gasByStage, placesOf, type StageGas, type Stages } from "./stages.js";

/** The content of contracts.json. */
export interface Contracts {
    /** Code after deployment, with immutable values, and the address that `shackled deploy` gives it, by name. */
    contracts: Record<ContractName, { address: string; code: string }>;
    /** Name and parameters (name, type) of errors, by selector. */
    errors: Record<string, [string, [string, string][]]>;
}

/** A call that a contract refused, or that did not end. The message is one line. */
export class CallError extends Error {
    override name = "CallError";

    /** data: of the revert; empty where there is none. */
    constructor(
        message: string,
        readonly data: Uint8Array = new Uint8Array(),
    ) {
        super(message);
    }
}

/** An EVM with the contracts that draw. */
export class ContractEvm {
    readonly renderer: Uint8Array;
    readonly contracts: Contracts;
    readonly #evm: Evm;
    #described: Stages | null = null;

    /** Take the compiled module of evm.wasm, and contracts.json. */
    constructor(module: WebAssembly.Module, contracts: Contracts) {
        this.#evm = new Evm(module);
        this.contracts = contracts;
        for (const name of RENDERER) {
            const { address, code } = contracts.contracts[name];
            this.#evm.put(fromHex(address), fromHex(code));
        }
        this.renderer = fromHex(contracts.contracts.Renderer.address);
    }

    /** Place the code of a contract at an address. */
    put(address: Uint8Array, code: Uint8Array): void {
        this.#evm.put(address, code);
    }

    /** Call a contract, and return its output and gas. CallError, with what the contract says, where it fails. */
    call(address: Uint8Array, data: Uint8Array, gas = GAS_LIMIT): Answer {
        return this.#checked(this.#evm.call(address, data, gas), gas);
    }

    /** Call a contract as `call` does, with a value in wei, and keep what the call changes. */
    send(address: Uint8Array, data: Uint8Array, gas = GAS_LIMIT, value = 0n): Answer {
        return this.#checked(this.#evm.send(address, data, gas, value), gas);
    }

    /** Compile the contracts that used at least so much gas so far, as `Evm.compile`. */
    compile(least: number): Promise<void> {
        return this.#evm.compile(least);
    }

    /** Return the gas of a call of the Renderer by stage. CallError where it fails, InputError for stages of other contracts. */
    profile(data: Uint8Array, stages: Stages, gas = GAS_LIMIT): StageGas[] {
        if (this.#described !== stages) {
            for (const name of RENDERER) {
                const { address, code } = this.contracts.contracts[name];
                const map = (stages.contracts as Partial<Stages["contracts"]>)[name];
                if (map?.address !== address) throw new InputError(`the stages are not those of this ${name}`);
                this.#evm.describe(fromHex(address), placesOf(fromHex(code), map));
            }
            this.#described = stages;
        }
        const { answer, table } = this.#evm.profile(this.renderer, data, gas);
        this.#checked(answer, gas);
        return gasByStage(table, stages.stages);
    }

    #checked(answer: Answer, gas: number): Answer {
        if (answer.status === "success") return answer;
        if (answer.status === "revert") {
            const said = describeRevert(answer.output, this.contracts);
            throw new CallError(said === "OutOfGas()" ? outOfGas(gas) : `the contract refused: ${said}`, answer.output);
        }
        if (answer.status === "out of gas") throw new CallError(outOfGas(gas));
        throw new CallError(`the call failed: ${new TextDecoder().decode(answer.output.subarray(0, 200))}`);
    }
}

/** Return the data of a revert as text, such as "CanvasSize(width=0, height=17)". */
export function describeRevert(data: Uint8Array, { errors }: Pick<Contracts, "errors">): string {
    if (!data.length) return "the data of the call is not a scene that is encoded correctly";
    const selector = toHex(data.subarray(0, 4));
    const found = Object.hasOwn(errors, selector) ? errors[selector] : undefined;
    const body = data.subarray(4);
    if (!found || body.length < 32 * found[1].length) return `error ${toHex(data.subarray(0, 68))}`;
    const [name, parameters] = found;
    if (name === "Error") return textAt(body);
    if (name === "Panic") return `Panic(0x${BigInt(valueAt(body, 0, "uint256")).toString(16)})`;
    const shown = parameters.map(([key, type], index) => `${key || type}=${valueAt(body, index, type)}`);
    return `${name}(${shown.join(", ")})`;
}

function valueAt(body: Uint8Array, index: number, type: string): string {
    const word = body.subarray(32 * index, 32 * index + 32);
    if (type === "address") return toHex(word.subarray(12));
    const bits = /^(u?)int(\d+)$/.exec(type);
    if (!bits) return toHex(word);
    const value = BigInt(toHex(word));
    return String(bits[1] ? value : BigInt.asIntN(256, value));
}

function textAt(body: Uint8Array): string {
    const size = wordAt(body, 32, body.length - 64);
    if (size < 0) return `error ${toHex(body.subarray(0, 64))}`;
    const text = new TextDecoder().decode(body.subarray(64, 64 + Math.min(size, 200)));
    return text.replace(/\p{C}+/gu, " ");
}

function outOfGas(limit: number): string {
    return `the call ran out of gas: ${limit.toLocaleString("en")} did not suffice`;
}

/** Return contracts.json from what JSON.parse returned. InputError where it is something else. */
export function checkedContracts(value: unknown): Contracts {
    const found = value as Partial<Contracts> | null;
    const complete = [...RENDERER, "Studio" as const].every((name) => {
        const entry = found?.contracts?.[name];
        return typeof entry?.address === "string" && typeof entry.code === "string";
    });
    if (!complete || typeof found?.errors !== "object")
        throw new InputError("the contracts are not those of contracts.json");
    return found as Contracts;
}
