// Mouse, touch, wheel and keys as changes of the direction from which a scene is seen.

/** degrees: about the vertical axis, and upward. zoom: a factor. */
export interface Change {
    azimuth: number;
    elevation: number;
    zoom: number;
}

/** What gestures do. */
export interface Gestures {
    /** The viewer moves. held: whether a finger or a button is still down. */
    change(change: Partial<Change>, held: boolean): void;
    /** The last finger or button was let go, at this speed in degrees a millisecond. */
    release(speed: { azimuth: number; elevation: number }): void;
    reset(): void;
}

/** Degrees for a drag over the whole width. */
const DRAG = 180;
const KEY = 10;
const KEY_ZOOM = 1.2;
/** Per pixel of a wheel. */
const WHEEL = 0.0015;
/** Milliseconds without movement after which a drag has no speed. */
const STILL = 60;

/** Listen to an element until the signal aborts. */
export function listen(stage: HTMLElement, gestures: Gestures, signal: AbortSignal): void {
    const fingers = new Map<number, { x: number; y: number }>();
    let speed = { azimuth: 0, elevation: 0 };
    let last = 0;
    const spread = (): number => {
        const [a, b] = [...fingers.values()];
        return a && b ? Math.max(Math.hypot(a.x - b.x, a.y - b.y), 1) : 0;
    };
    const on = <K extends keyof HTMLElementEventMap>(type: K, handle: (event: HTMLElementEventMap[K]) => void): void =>
        stage.addEventListener(type, handle, { signal, passive: false });

    on("pointerdown", (event) => {
        if (event.button !== 0 || fingers.size === 2) return;
        stage.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        speed = { azimuth: 0, elevation: 0 };
        gestures.change({}, true);
    });
    on("pointermove", (event) => {
        const finger = fingers.get(event.pointerId);
        if (!finger) return;
        const before = spread();
        const [dx, dy] = [event.clientX - finger.x, event.clientY - finger.y];
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        if (fingers.size === 2) {
            gestures.change({ zoom: spread() / before }, true);
            return;
        }
        if (!dx && !dy) return;
        // the scene follows the finger: the viewer goes the other way
        const degrees = DRAG / Math.max(stage.clientWidth, 1);
        const change = { azimuth: -dx * degrees, elevation: dy * degrees };
        const time = Math.max(event.timeStamp - last, 1);
        const weight = Math.min(time / STILL, 1);
        speed = {
            azimuth: speed.azimuth * (1 - weight) + (change.azimuth / time) * weight,
            elevation: speed.elevation * (1 - weight) + (change.elevation / time) * weight,
        };
        last = event.timeStamp;
        gestures.change(change, true);
    });
    const end = (event: PointerEvent): void => {
        if (!fingers.delete(event.pointerId) || fingers.size) return;
        const resting = event.type === "pointercancel" || event.timeStamp - last > STILL;
        gestures.release(resting ? { azimuth: 0, elevation: 0 } : speed);
    };
    on("pointerup", end);
    on("pointercancel", end);
    on("wheel", (event) => {
        // a page that scrolls goes on scrolling, until the picture was clicked
        if (!event.ctrlKey && !stage.matches(":focus") && scrolls()) return;
        event.preventDefault();
        const pixels = event.deltaY * (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 : 30);
        gestures.change({ zoom: Math.exp(-WHEEL * pixels * (event.ctrlKey ? 6 : 1)) }, false);
    });
    on("keydown", (event) => {
        if (event.altKey || event.ctrlKey || event.metaKey) return;
        const changes: Record<string, Partial<Change>> = {
            ArrowLeft: { azimuth: KEY },
            ArrowRight: { azimuth: -KEY },
            ArrowUp: { elevation: -KEY },
            ArrowDown: { elevation: KEY },
            "+": { zoom: KEY_ZOOM },
            "=": { zoom: KEY_ZOOM },
            "-": { zoom: 1 / KEY_ZOOM },
        };
        if (event.key === "Home" || event.key === "0") gestures.reset();
        else if (Object.hasOwn(changes, event.key)) gestures.change(changes[event.key] ?? {}, false);
        else return;
        event.preventDefault();
    });
}

function scrolls(): boolean {
    const page = document.scrollingElement;
    return page !== null && page.scrollHeight > page.clientHeight;
}
