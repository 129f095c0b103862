// A signal that follows another one, but not more often than eyes do.

import { effect, signal, type ReadonlySignal } from "@preact/signals";

/** Milliseconds between two values: 8 a second. */
const PAUSE = 125;

/** Return a signal with the values of another one, at most 8 a second, the last of them always. */
export function calm<T>(source: ReadonlySignal<T>): ReadonlySignal<T> {
    const slow = signal(source.peek());
    let at = -Infinity;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const take = (): void => {
        timer = undefined;
        at = performance.now();
        slow.value = source.peek();
    };
    effect(() => {
        if (source.value === slow.peek()) return;
        const wait = at + PAUSE - performance.now();
        if (wait <= 0) take();
        else timer ??= setTimeout(take, wait);
    });
    return slow;
}
