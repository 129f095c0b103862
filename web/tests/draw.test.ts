import assert from "node:assert/strict";
import { test } from "node:test";

import { Scheduler, type Clock, type Job, type Plan } from "../src/draw/scheduler.js";
import { Speed, areaOf } from "../src/draw/speed.js";

interface Drawn {
    milliseconds: number;
}

/** A picture that is drawn in no time but that of a clock, and what was drawn of it. */
class Fake {
    time = 0;
    value: { name: string } | null = { name: "a" };
    plan: Plan = { exact: { size: [200, 100], samples: 1 }, finer: null, share: 1, isPlain: false };
    beginsSmall = false;
    /** Milliseconds of a picture. */
    takes = ({ quality, size, share }: Job): number => (areaOf(size) * (quality === "finer" ? 4 : 1) * share) / 1000;
    fails = (_job: Job): boolean => false;
    /** What was begun, and what became of it. */
    readonly log: string[] = [];
    #later: { at: number; act: () => void }[] = [];

    readonly clock: Clock = {
        now: () => this.time,
        after: (milliseconds, act) => {
            const one = { at: this.time + milliseconds, act };
            this.#later.push(one);
            return () => (this.#later = this.#later.filter((each) => each !== one));
        },
    };

    scheduler(): Scheduler<{ name: string }, Drawn> {
        const { clock, beginsSmall } = this;
        const words = (value: { name: string }, { quality, size, share }: Job): string =>
            `${value.name} ${quality} ${size[0]}${share < 1 ? " fewer" : ""}`;
        return new Scheduler<{ name: string }, Drawn>(
            {
                beginsSmall,
                value: () => this.value,
                plan: () => this.plan,
                draw: (value, job, signal) =>
                    new Promise((resolve, reject) => {
                        const milliseconds = this.takes(job);
                        const stop = clock.after(milliseconds, () =>
                            this.fails(job) ? reject(new Error("no")) : resolve({ milliseconds }),
                        );
                        signal.addEventListener("abort", () => {
                            stop();
                            this.log.push(`${words(value, job)} given up`);
                            reject(new Error("given up"));
                        });
                    }),
                show: (value, job) => void this.log.push(words(value, job)),
                fail: ({ name }) => void this.log.push(`${name} failed`),
            },
            clock,
        );
    }

    /** Let so much time pass, and return what was drawn in it. */
    async pass(milliseconds: number): Promise<string[]> {
        const end = this.time + milliseconds;
        const settle = (): Promise<void> => new Promise((resolve) => setImmediate(resolve));
        for (await settle(); ; await settle()) {
            const next = this.#later.sort((a, b) => a.at - b.at)[0];
            if (!next || next.at > end) break;
            this.#later.shift();
            this.time = next.at;
            next.act();
        }
        this.time = end;
        return this.log.splice(0);
    }
}

test("the exact picture, then the finer one; frames while it moves", async () => {
    const fake = new Fake();
    fake.plan = { ...fake.plan, finer: { size: [800, 400], samples: 4 } };
    const scheduler = fake.scheduler();
    scheduler.wake();
    assert.deepEqual(await fake.pass(5000), ["a exact 200", "a finer 800"]);
    // the finer picture takes 1,280 ms, the exact one 20, and there is time for 40
    for (const name of ["b", "c"]) {
        fake.value = { name };
        scheduler.moved();
        assert.deepEqual(await fake.pass(30), [`${name} draft 200`]);
    }
    assert.ok(scheduler.isMoving);
    assert.deepEqual(await fake.pass(120), []);
    assert.deepEqual(await fake.pass(2000), ["c exact 200", "c finer 800"]);
    assert.ok(scheduler.isResting);
    scheduler.again();
    assert.deepEqual(await fake.pass(2000), ["c exact 200", "c finer 800"]);
});

test("a picture at rest makes way for what moves, if it takes long", async () => {
    const fake = new Fake();
    fake.plan = { ...fake.plan, finer: { size: [800, 400], samples: 4 } };
    const scheduler = fake.scheduler();
    scheduler.wake();
    assert.deepEqual(await fake.pass(100), ["a exact 200"]);
    fake.value = { name: "b" };
    scheduler.moved();
    assert.deepEqual(await fake.pass(100), ["a finer 800 given up", "b draft 200"]);
    // the exact one is finished: it takes 20 ms
    await fake.pass(2000);
    scheduler.again();
    fake.value = { name: "c" };
    scheduler.moved();
    assert.deepEqual(await fake.pass(100), ["b exact 200", "c draft 200"]);
});

test("what is held is not drawn exactly, and what was let go is at once, unless it glides", async () => {
    const fake = new Fake();
    const scheduler = fake.scheduler();
    scheduler.wake();
    await fake.pass(1000);
    for (const glides of [false, true]) {
        fake.value = { name: "b" };
        scheduler.moved();
        scheduler.hold(true);
        assert.deepEqual(await fake.pass(1000), ["b draft 200"]);
        scheduler.moved();
        scheduler.hold(false, glides);
        assert.deepEqual(await fake.pass(100), glides ? [] : ["b exact 200"]);
        assert.deepEqual(await fake.pass(1000), glides ? ["b exact 200"] : []);
    }
});

test("of what nothing is known a small draft is first; of slow pictures, one of fewer pixels", async () => {
    const fake = new Fake();
    [fake.beginsSmall, fake.takes] = [true, ({ size }) => areaOf(size) / 20];
    const scheduler = fake.scheduler();
    scheduler.wake();
    assert.deepEqual(await fake.pass(5000), ["a draft 96", "a exact 200"]);
    fake.value = { name: "b" };
    scheduler.wake();
    assert.deepEqual(await fake.pass(5000), ["b draft 32", "b exact 200"]);
    scheduler.forget();
    fake.value = { name: "c" };
    fake.plan = { ...fake.plan, exact: { size: [40, 20], samples: 1 }, isPlain: true };
    scheduler.wake();
    assert.deepEqual(await fake.pass(5000), ["c exact 40"], "a draft with all pixels is the exact picture");
});

test("drafts have fewer triangles where fewer pixels are not enough", async () => {
    const fake = new Fake();
    fake.plan = { ...fake.plan, share: 0.25 };
    fake.takes = ({ size, share }) => 400 * share + areaOf(size) / 200;
    const scheduler = fake.scheduler();
    const move = async (name: string): Promise<string[]> => {
        fake.value = { name };
        scheduler.moved();
        return fake.pass(150);
    };
    scheduler.wake();
    await fake.pass(2000);
    assert.deepEqual(await move("b"), ["b draft 32 fewer"]);
    await fake.pass(2000);
    // fast enough at full size, once their speed is known
    fake.takes = ({ size, share }) => (share < 1 ? 0 : 400) + areaOf(size) / 2000;
    for (const name of ["c", "d"]) {
        await move(name);
        await fake.pass(2000);
    }
    assert.deepEqual(await move("e"), ["e draft 200 fewer"]);
    await fake.pass(2000);
    // some meshes cannot have fewer
    fake.fails = ({ share }) => share < 1;
    assert.deepEqual(await move("f"), []);
    assert.deepEqual(await fake.pass(2000), ["f draft 32", "f exact 200"]);
});

test("the size of a movement grows when pictures become faster, and shrinks when one is far too slow", async () => {
    const fake = new Fake();
    fake.takes = ({ size }) => areaOf(size) / 100;
    const scheduler = fake.scheduler();
    scheduler.wake();
    await fake.pass(2000);
    const move = async (count: number): Promise<number[]> => {
        const widths: number[] = [];
        for (let step = 0; step < count; step++) {
            fake.value = { name: "x" };
            scheduler.moved();
            widths.push(...(await fake.pass(150)).map((each) => Number(each.split(" ")[2])));
        }
        return widths;
    };
    assert.deepEqual(await move(8), new Array(8).fill(32));
    fake.takes = () => 5;
    assert.equal((await move(20)).at(-1), 200);
    fake.takes = ({ size }) => areaOf(size) / 100;
    assert.ok(Math.min(...(await move(24))) < 200);
});

test("what fails or is given up is not drawn again, until another was", async () => {
    const fake = new Fake();
    const scheduler = fake.scheduler();
    const first = fake.value;
    scheduler.wake();
    await fake.pass(1000);
    const bad = (fake.value = { name: "bad" });
    fake.fails = () => fake.value === bad;
    scheduler.wake();
    assert.deepEqual(await fake.pass(1000), ["bad failed"]);
    scheduler.wake();
    assert.deepEqual(await fake.pass(1000), []);
    fake.value = first;
    scheduler.wake();
    fake.value = bad;
    scheduler.wake();
    assert.deepEqual(await fake.pass(1000), ["bad failed"], "tried again");
    const slow = (fake.value = { name: "slow" });
    fake.takes = () => 5000;
    scheduler.wake();
    await fake.pass(10);
    scheduler.giveUp();
    assert.deepEqual(await fake.pass(9000), ["slow exact 200 given up"]);
    assert.equal(fake.value, slow);
    fake.value = null;
    scheduler.wake();
    assert.deepEqual(await fake.pass(9000), []);
});

test("the size of moving pictures", () => {
    const speed = new Speed();
    const [own, shown] = [
        [100, 80],
        [400, 320],
    ] as const;
    assert.deepEqual(speed.movingSize(own, shown), shown);
    speed.add(8000, 20);
    assert.deepEqual(speed.movingSize(own, shown), own);
    speed.add(8000, 500);
    assert.deepEqual(speed.movingSize(own, shown), [100, 80], "one slow picture says little");
    const slow = new Speed();
    slow.add(8000, 1000);
    assert.deepEqual(slow.movingSize(own, shown), [20, 16]);
    slow.add(500, 30);
    slow.add(2000, 40);
    assert.ok(Math.abs(slow.predict(1250) - 35) < 1e-9);
});
