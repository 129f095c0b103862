// Mouse, touch and wheel on the picture.

import type { Spot } from "./place.js";

/** What gestures do. Distances are parts of the picture's height. */
export interface Gestures {
    turn(dx: number, dy: number): void;
    pan(dx: number, dy: number): void;
    /** A factor by which what is seen grows. */
    zoom(factor: number): void;
    /** What a drag from there does instead of turning: called with where it is now. null: it turns. */
    grab(from: Spot, event: PointerEvent): ((to: Spot, event: PointerEvent) => void) | null;
    /** A button or finger went down and up again without moving. */
    click(at: Spot, event: PointerEvent): void;
    /** Whether a finger or a button is down. */
    hold(is: boolean): void;
}

/** Pixels below which a press is a click. */
const CLICK = 4;
/** The zoom for a pixel of a wheel; pinching on a touch pad counts six times. */
const WHEEL = 0.0015;

/** Listen to the picture until the signal aborts. */
export function listen(stage: HTMLElement, gestures: Gestures, signal: AbortSignal): void {
    const fingers = new Map<number, { x: number; y: number }>();
    let drag: ((to: Spot, event: PointerEvent) => void) | null = null;
    let panning = false;
    let start: { x: number; y: number } | null = null;
    const spot = ({ clientX, clientY }: PointerEvent): Spot => {
        const box = stage.getBoundingClientRect();
        return [(clientX - box.x) / box.width, (clientY - box.y) / box.height];
    };
    const pair = (): { x: number; y: number; spread: number } | null => {
        const [a, b] = [...fingers.values()];
        if (!a || !b) return null;
        return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, spread: Math.max(Math.hypot(a.x - b.x, a.y - b.y), 1) };
    };
    const on = <K extends keyof HTMLElementEventMap>(type: K, handle: (event: HTMLElementEventMap[K]) => void): void =>
        stage.addEventListener(type, handle, { signal, passive: false });

    on("pointerdown", (event) => {
        if (fingers.size === 2) return;
        stage.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        start = fingers.size === 1 ? { x: event.clientX, y: event.clientY } : null;
        panning = event.button !== 0;
        drag = fingers.size === 1 && !panning ? gestures.grab(spot(event), event) : null;
        gestures.hold(true);
    });
    on("pointermove", (event) => {
        const finger = fingers.get(event.pointerId);
        if (!finger) return;
        if (start && Math.hypot(event.clientX - start.x, event.clientY - start.y) < CLICK) return;
        start = null;
        const before = pair();
        const height = Math.max(stage.clientHeight, 1);
        const [dx, dy] = [(event.clientX - finger.x) / height, (event.clientY - finger.y) / height];
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        const after = pair();
        if (before && after) {
            gestures.pan((after.x - before.x) / height, (after.y - before.y) / height);
            gestures.zoom(after.spread / before.spread);
        } else if (drag) drag(spot(event), event);
        else if (panning || event.shiftKey) gestures.pan(dx, dy);
        else gestures.turn(dx, dy);
    });
    const end = (event: PointerEvent): void => {
        if (!fingers.delete(event.pointerId) || fingers.size) return;
        if (start && event.type === "pointerup" && event.button === 0) gestures.click(spot(event), event);
        drag = start = null;
        gestures.hold(false);
    };
    on("pointerup", end);
    on("pointercancel", end);
    on("contextmenu", (event) => event.preventDefault());
    on("wheel", (event) => {
        event.preventDefault();
        const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 30);
        gestures.zoom(Math.exp(-WHEEL * pixels * (event.ctrlKey ? 6 : 1)));
    });
}
