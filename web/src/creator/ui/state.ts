// What the page shows besides the document.

import { signal } from "@preact/signals";

/** What a drag on the picture does: it turns the view, or moves objects. */
export const tool = signal<"turn" | "move">("turn");
/** Whether lights are shown on the picture, to be dragged. */
export const lamps = signal(false);
/** Whether what is opened is added to the scene. */
export const adding = signal(false);
/** On small screens, what is below the picture. */
export const page = signal<"shelf" | "looks" | "scene">("looks");
/** Whether the visitor has done something: until then a line says what can be done. */
export const begun = signal(false);
