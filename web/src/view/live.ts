// Pictures of a movement for the page `shackled creator`: drawn in a worker, all of one size.

import { loadAssets, type Assets, type AssetSources } from "../evm/assets.js";
import type { Base, Orbit } from "../orbit.js";
import { Client } from "./client.js";
import type { Drawn } from "./protocol.js";
import { scaled, Speed, type Size } from "./speed.js";

export { drag, orbitCall, pan, zoom, type Base, type Orbit } from "../orbit.js";

/** Milliseconds in which a scene must be opened, and a picture of a movement drawn. */
const OPENING = 30_000;
const DRAWING = 3_000;
/** The sizes that are drawn first, as fractions of the call's own, to know the speed; and the most that they may take. */
const TRIALS = [0.125, 0.125, 0.5];
const TRIAL = 400;
/** The longer side of pictures of a movement, at least, however slow. */
const LEAST = 48;

export class LiveView {
    readonly #client: Client;
    #loaded: Promise<Assets> | null = null;
    #speed = new Speed();
    #base: Base | null = null;
    #own: Size = [1, 1];
    #size: Size = [1, 1];

    constructor(assets: AssetSources) {
        this.#client = new Client(() => (this.#loaded ??= loadAssets(assets)));
    }

    /** Show another scene, once it can be drawn. Rejects where it cannot, or takes too long. */
    async open(file: Uint8Array<ArrayBuffer>, base: Base): Promise<void> {
        const { call, facts } = await this.#client.ask("open", { file }, OPENING);
        this.#client.call = call;
        this.#base = base;
        this.#own = [facts.width, facts.height];
        this.#speed = new Speed();
        for (const part of TRIALS) {
            this.#size = scaled(this.#own, part);
            if (this.#speed.predict(this.#size[0] * this.#size[1]) < TRIAL) await this.draw(base.camera);
        }
    }

    /** Choose the size for the pictures of a movement. */
    begin(): void {
        const size = this.#speed.movingSize(this.#own, this.#own);
        const least = LEAST / Math.max(...this.#own);
        this.#size = Math.max(...size) < LEAST ? scaled(this.#own, least) : size;
    }

    /** Return the picture that a camera sees. Rejects where it cannot be drawn. */
    async draw(to: Orbit): Promise<Drawn> {
        if (!this.#base) throw new Error("there is no scene");
        const [width, height] = this.#size;
        const orbit = { base: this.#base, to };
        const drawn = await this.#client.ask(
            "draw",
            { turn: {}, orbit, width, height, samples: 1, hashed: false },
            DRAWING,
        );
        this.#speed.add(width * height, drawn.milliseconds);
        return drawn;
    }
}
