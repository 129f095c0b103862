// The list of objects: more, fewer, in another order, with other names.

import { add, boundsOf, type Vector } from "../scene/arithmetic.js";
import type { Document, Item, Meshes } from "./document.js";
import { boundsOfPoints, carried, changed, pointsOf, tidied, type Selection } from "./measure.js";

/** The gap between objects that are put side by side, as a part of the radius. */
const GAP = 0.15;

/** Return the document without some objects. */
export function removed(doc: Document, ids: Selection): Document {
    return { ...doc, objects: doc.objects.filter(({ id }) => !ids.has(id)) };
}

export function renamed(doc: Document, id: string, name: string): Document {
    return changed(doc, new Set([id]), (item) => ({ ...item, name }));
}

/** Return the document with an object so many places later, which is drawn after those before it. */
export function reordered(doc: Document, id: string, by: number): Document {
    const objects = [...doc.objects];
    const from = objects.findIndex((item) => item.id === id);
    if (from < 0) return doc;
    const [item] = objects.splice(from, 1) as [Item];
    objects.splice(Math.max(0, from + by), 0, item);
    return { ...doc, objects };
}

/** Return the document with copies of objects to their right. */
export function duplicated(doc: Document, ids: Selection, meshes: Meshes): Document {
    const items = doc.objects.filter(({ id }) => ids.has(id));
    if (!items.length) return doc;
    const { radius } = boundsOfPoints(pointsOf(items, meshes));
    const by: Vector = [(2 + GAP) * radius, 0, 0];
    return withItems(doc, items, by, radius);
}

/**
 * Return the document with the objects of another one to the right of its own: as large as these, and on their level.
 *
 * Titles, notices and licences are joined.
 */
export function withPiece(doc: Document, piece: Document, meshes: Meshes): Document {
    if (!doc.objects.length || !piece.objects.length) {
        return doc.objects.length ? doc : { ...piece, width: doc.width, height: doc.height };
    }
    const { middle, radius } = boundsOfPoints(pointsOf(piece.objects, meshes));
    const factor = doc.frame.radius / radius;
    const scaled = piece.objects.map((item) => carried(item, middle as Vector, { factor }));
    const [own, other] = [doc.objects, scaled].map((items) => boundsOf(pointsOf(items, meshes)));
    const [[[, bottom], [right]], [low, high]] = [own, other];
    const by: Vector = [
        right + GAP * doc.frame.radius - low[0],
        bottom - low[1],
        doc.frame.middle[2] - (low[2] + high[2]) / 2,
    ];
    const join = (one: string, two: string, by: string): string =>
        one.includes(two) ? one : [one, two].filter(Boolean).join(by);
    return {
        ...withItems(doc, scaled, by, doc.frame.radius),
        title: join(doc.title, piece.title, ", "),
        notice: join(doc.notice, piece.notice, "\n"),
        licence: doc.licence && piece.licence ? join(doc.licence, piece.licence, ", ") : "",
    };
}

/** Return the document with further objects, which are moved, with ids of their own. */
function withItems(doc: Document, items: readonly Item[], by: Vector, size: number): Document {
    const last = doc.objects.reduce((most, { id }) => Math.max(most, Number(id) || 0), 0);
    const added = items.map((item, index) => ({
        ...item,
        id: String(last + 1 + index),
        position: tidied(add(item.position as Vector, by), size),
    }));
    return { ...doc, objects: [...doc.objects, ...added] };
}
