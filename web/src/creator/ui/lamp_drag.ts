// Lights that are dragged on a sphere about the objects, which the viewer sees as a disc.

import type { TargetedPointerEvent } from "preact";
import type { App } from "../app.js";
import { fromDisc } from "../../document/lamps.js";

type Pointer = TargetedPointerEvent<HTMLElement>;

/** Return what makes an element drag a light. disc: of the sphere on the screen: its middle and radius. */
export function dragsLight(app: App, number: number, disc: (element: HTMLElement) => DOMRect, radius = 0.5) {
    const move = (event: Pointer): void => {
        event.stopPropagation();
        if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
        const { x, y, width, height } = disc(event.currentTarget);
        const [dx, dy] = [event.clientX - x - width / 2, event.clientY - y - height / 2];
        const size = radius * height;
        app.change(fromDisc(app.doc.peek(), number, dx / size, dy / size), "Move a light", `light ${number}`);
    };
    return {
        onPointerDown: (event: Pointer) => {
            event.stopPropagation();
            event.currentTarget.setPointerCapture(event.pointerId);
            app.drawing.hold(true);
        },
        onPointerMove: move,
        onLostPointerCapture: () => app.drawing.hold(false),
    };
}
