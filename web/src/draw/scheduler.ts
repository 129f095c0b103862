// Decides which picture is drawn next: drafts while something moves, then the exact picture, and a finer one. Drafts have fewer
// pixels, and fewer triangles where that is not enough.

import { SLOW_FRAME, Speed, areaOf, scaled, type Size } from "./speed.js";

/** Milliseconds without movement after which the exact picture is drawn. */
const REST = 160;
/** Milliseconds above which a picture is given up for a newer one, and has a draft before it. */
const INTERRUPT = 60;
const LONG = 300;
/** Frames of a movement after which a larger size is tried, and by how many times one is too slow for its size. */
const LEARN = 8;
const TOO_SLOW = 3;
/** Pixels a side of the first draft, of which nothing is known. */
const FIRST = 96;

/** A picture to draw. share: of the triangles; 1 but in drafts. */
export interface Job {
    quality: "draft" | "exact" | "finer";
    size: Size;
    share: number;
}

/** The pictures of a value. samples: by how many times a pixel takes longer than one of a draft. */
export interface Plan {
    exact: { size: Size; samples: number };
    /** null: the exact one is the last. */
    finer: { size: Size; samples: number } | null;
    /** The share of the triangles that drafts can have; 1 for all. */
    share: number;
    /** Whether a draft with all pixels and triangles is the exact picture. */
    isPlain: boolean;
}

/** What the scheduler asks to draw and to show. Values are compared by identity. */
export interface Delegate<V, D extends { milliseconds: number }> {
    /** Return what is to be seen; null for nothing. */
    value(): V | null;
    plan(value: V): Plan;
    draw(value: V, job: Job, signal: AbortSignal): Promise<D>;
    show(value: V, job: Job, drawn: D): void;
    /** Take an error. The value is not drawn again until another one was. */
    fail(value: V, error: unknown): void;
    /** Whether a small draft is drawn first of what nothing is known of. */
    readonly beginsSmall: boolean;
}

export interface Clock {
    now(): number;
    /** Return what cancels it. */
    after(milliseconds: number, act: () => void): () => void;
}

const CLOCK: Clock = {
    now: () => performance.now(),
    after: (milliseconds, act) => {
        const timer = setTimeout(act, milliseconds);
        return () => clearTimeout(timer);
    },
};

interface Flight<V> {
    value: V;
    job: Job;
    /** How long it will take. */
    time: number;
    abort: AbortController;
}

export class Scheduler<V, D extends { milliseconds: number }> {
    #speed = new Speed();
    /** Of drafts with fewer triangles. */
    #fewer = new Speed();
    #seen: { value: V; quality: Job["quality"] } | null = null;
    /** What cannot be drawn, or was given up. */
    #givenUp: V | null = null;
    #flight: Flight<V> | null = null;
    #held = false;
    #movedAt = -Infinity;
    /** What all frames of a movement have, the size of the exact picture then, and the number of the last frame; null at rest. */
    #draft: (Job & { of: Size; frame: number }) | null = null;
    /** Whether what is drawn can have fewer triangles. */
    #isReducible = true;
    /** Whether the speed was measured again: the first picture is slow. */
    #isMeasured = false;
    #cancel = (): void => undefined;

    constructor(
        private readonly delegate: Delegate<V, D>,
        private readonly clock = CLOCK,
    ) {}

    /** Whether nothing is drawn, and nothing moves. */
    get isResting(): boolean {
        return !this.#flight && !this.isMoving;
    }

    get isMoving(): boolean {
        return this.#held || this.clock.now() - this.#movedAt < REST;
    }

    /** Return how long a picture of so many pixels will take, in milliseconds; 0 where nothing is known. */
    predict(pixels: number): number {
        return this.#speed.predict(pixels);
    }

    /** Note that the value moves: drafts will do for a moment. */
    moved(): void {
        this.#movedAt = this.clock.now();
        this.wake();
    }

    /** Note whether a finger or a button is down. glides: whether what was let go goes on moving. */
    hold(is: boolean, glides = false): void {
        this.#held = is;
        if (!is && !glides) this.#movedAt = -Infinity;
        this.wake();
    }

    /** Draw the exact picture again, such as in another place. */
    again(): void {
        if (this.#seen) this.#seen.quality = "draft";
        this.wake();
    }

    /** Forget how long pictures take: what follows is something else. */
    forget(): void {
        [this.#speed, this.#fewer] = [new Speed(), new Speed()];
        [this.#draft, this.#isMeasured, this.#isReducible] = [null, false, true];
    }

    /** End what is being drawn; it is not drawn again until another value was. */
    giveUp(): void {
        this.#givenUp = this.#flight?.value ?? this.#givenUp;
        this.stop();
    }

    /** End what is being drawn. */
    stop(): void {
        this.#cancel();
        this.#flight?.abort.abort();
    }

    /** Draw what is next, unless something is being drawn. To be called after each change. */
    wake(): void {
        const value = this.delegate.value();
        if (this.#flight) {
            const { job, time, abort, value: before } = this.#flight;
            if (job.quality !== "draft" && before !== value && time > INTERRUPT) abort.abort();
            return;
        }
        if (value === null || value === this.#givenUp) return;
        const plan = this.delegate.plan(value);
        const { exact, finer } = plan;
        const quality = this.#seen?.value === value ? this.#seen.quality : null;
        if (quality === (finer ? "finer" : "exact")) {
            this.#givenUp = null;
            if (this.#isMeasured || this.delegate.beginsSmall) return;
            this.#isMeasured = true;
            void this.#draw(value, "draft", exact.size, 1);
            return;
        }
        const isMoving = this.isMoving;
        if (!isMoving) this.#draft = null;
        const time = this.predict(areaOf(exact.size) * exact.samples);
        if (!quality && (isMoving || time > LONG || (!time && this.delegate.beginsSmall))) this.#drawDraft(value, plan);
        else if (!isMoving && quality === "exact" && finer) void this.#draw(value, "finer", finer.size, finer.samples);
        else if (!isMoving) void this.#draw(value, "exact", exact.size, exact.samples);
        else if (!this.#held) {
            this.#cancel();
            this.#cancel = this.clock.after(REST, () => this.wake());
        }
    }

    #drawDraft(value: V, plan: Plan): void {
        const { size: of } = plan.exact;
        const before = String(this.#draft?.of) === String(of) ? this.#draft : null;
        const frame = before ? before.frame + 1 : 0;
        let draft: Job = before ?? this.#draftOf(plan);
        if (before && frame % LEARN === 0) {
            // what is compiled meanwhile draws larger pictures in the same time
            const next = this.#draftOf(plan);
            if (areaOf(next.size) > areaOf(draft.size)) draft = next;
        }
        const { size, share } = (this.#draft = { ...draft, of, frame });
        const isExact = plan.isPlain && share === 1 && String(size) === String(of);
        void this.#draw(value, isExact ? "exact" : "draft", size, 1, share);
    }

    /** Return the best draft that is fast enough. */
    #draftOf({ exact, finer, share }: Plan): Job {
        const quality = "draft";
        if (!this.predict(1) && this.delegate.beginsSmall)
            return { quality, size: scaled(exact.size, FIRST / Math.max(...exact.size)), share: 1 };
        const size = this.#speed.movingSize(exact.size, finer?.size ?? exact.size);
        if (share === 1 || !this.#isReducible || this.predict(areaOf(size)) <= SLOW_FRAME)
            return { quality, size, share: 1 };
        const isKnown = this.#fewer.predict(1) > 0;
        return { quality, size: isKnown ? this.#fewer.movingSize(exact.size, exact.size) : size, share };
    }

    async #draw(value: V, quality: Job["quality"], size: Size, samples: number, share = 1): Promise<void> {
        const [abort, pixels, job] = [new AbortController(), areaOf(size) * samples, { quality, size, share }];
        this.#flight = { value, job, time: this.predict(pixels), abort };
        try {
            const drawn = await this.delegate.draw(value, job, abort.signal);
            if (abort.signal.aborted) return;
            const { milliseconds } = drawn;
            (share < 1 ? this.#fewer : this.#speed).add(pixels, milliseconds);
            if (quality === "draft" && milliseconds > TOO_SLOW * SLOW_FRAME) this.#draft = null;
            // a draft of what is seen already was drawn to measure the speed
            if (quality === "draft" && this.#seen?.value === value) return;
            this.#seen = { value, quality };
            this.delegate.show(value, job, drawn);
        } catch (error) {
            if (abort.signal.aborted) return;
            if (share < 1) {
                this.#isReducible = false;
                this.#draft = null;
                return;
            }
            this.#givenUp = value;
            this.delegate.fail(value, error);
        } finally {
            this.#flight = null;
            this.wake();
        }
    }
}
