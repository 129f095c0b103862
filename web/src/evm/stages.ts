// The stages of a picture, and which instructions of the contracts belong to each. tools/build_web.py writes stages.json.

import { InputError } from "../errors.js";
import type { ContractName } from "./names.js";

/** The content of stages.json. */
export interface Stages {
    /** In the order in which a picture is made; the last is what belongs to no other. */
    stages: string[];
    contracts: Record<Exclude<ContractName, "Studio">, StageMap>;
}

/** The instructions of a contract, in the order of the code. */
export interface StageMap {
    /** That of contracts.json, which follows from the code. */
    address: string;
    /** Counts of instructions, each followed by their stage: from 1, or 0 for code that serves all stages. */
    runs: number[];
    /** What each JUMP and JUMPI does, by a letter: "i" enters a function, "o" leaves one, "-" neither. */
    jumps: string;
    /** For each JUMPDEST, the function of the source that contains it, and the one that begins there; 0 for none. */
    functions: number[];
    entries: number[];
}

/** The gas that a stage of a picture takes. */
export interface StageGas {
    stage: string;
    gas: number;
}

const JUMP = 0x56;
const JUMPI = 0x57;
const JUMPDEST = 0x5b;
const PUSH0 = 0x5f;
const PUSH32 = 0x7f;
const JUMPS = "-io";

/** Bytes of a place, words of a function and of a position: of evm/src/profile.rs. */
const PLACE = 6;
const FUNCTION = 3;
const POSITION = 6;

/** Return the description of a code that `Evm.describe` takes. */
export function placesOf(code: Uint8Array, { runs, jumps, functions, entries }: StageMap): Uint8Array {
    const places = new Uint8Array(PLACE * code.length);
    const view = new DataView(places.buffer);
    let [run, left, jump, target] = [0, runs[0] ?? 0, 0, 0];
    for (let at = 0; at < code.length; at++) {
        const [opcode, place] = [code[at], PLACE * at];
        // behind the instructions are data
        while (!left && run < runs.length) left = runs[(run += 2)] ?? 0;
        places[place] = runs[run + 1] ?? 0;
        left--;
        if (opcode === JUMP || opcode === JUMPI) places[place + 1] = Math.max(0, JUMPS.indexOf(jumps[jump++] ?? "-"));
        else if (opcode === JUMPDEST) {
            view.setUint16(place + 2, functions[target] ?? 0, true);
            view.setUint16(place + 4, entries[target] ?? 0, true);
            target++;
        } else if (opcode > PUSH0 && opcode <= PUSH32) at += opcode - PUSH0;
    }
    return places;
}

/** Return the gas of each stage, in their order, from the table of a profile. */
export function gasByStage(table: Uint32Array, stages: readonly string[]): StageGas[] {
    const found = stages.map((stage) => ({ stage, gas: 0 }));
    for (let at = 1 + FUNCTION * (table[0] ?? 0); at < table.length; at += POSITION) {
        const sum = found[(table[at + 1] || stages.length) - 1] as StageGas;
        sum.gas += table[at + 4] + 2 ** 32 * table[at + 5];
    }
    return found;
}

/** Return stages.json from what JSON.parse returned. InputError where it is something else. */
export function checkedStages(value: unknown): Stages {
    const found = value as Partial<Stages> | null;
    const count = Array.isArray(found?.stages) ? found.stages.length : 0;
    const maps = Object.values(found?.contracts ?? {}) as (Partial<StageMap> | null)[];
    const isComplete = (map: Partial<StageMap> | null): boolean =>
        [map?.runs, map?.functions, map?.entries].every((each) => Array.isArray(each)) &&
        !!map?.runs?.every((each, index) => each >= 0 && (index % 2 === 0 || each <= count)) &&
        typeof map.jumps === "string";
    if (!count || !maps.length || !maps.every(isComplete)) {
        throw new InputError("the stages are not those of stages.json");
    }
    return found as Stages;
}
