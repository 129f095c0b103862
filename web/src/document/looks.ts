// Looks: presets of lights, surface and background. They leave objects, culling, ground, effects, camera and size as they are.

import { toHex } from "../bytes.js";
import type { Light } from "../scene/types.js";
import { fitted, orbitOf, withCamera } from "./camera.js";
import type { Document, Item, Meshes } from "./document.js";
import { LAMP, lightOf } from "./lamps.js";
import { around, changed, type Selection } from "./measure.js";
import { PRESETS, type Preset } from "./settings.js";

export const LOOKS = PRESETS;
const ALL: Selection = new Set();

/**
 * Return the document with a look. Where a light had a shadow, the first one of the look has it.
 *
 * ids: of the objects whose surface changes; all by default.
 */
export function applyLook(doc: Document, name: string, ids: Selection = ALL): Document {
    const look = LOOKS.find((each) => each.name === name);
    if (!look) return doc;
    const { azimuth } = orbitOf(doc.camera, doc.frame);
    const isShadowed = doc.lights.some(({ shadow }) => shadow);
    const lights = look.lamps.map((lamp, number): Light => {
        const turned = { ...lamp, azimuth: around(lamp.azimuth + azimuth) };
        return lightOf({ ...LAMP, ...turned, shadow: isShadowed && number === 0 }, doc.frame);
    });
    const { ambientLight, background, invert } = look;
    return { ...changed(doc, ids, (item) => surfaced(item, look)), lights, ambientLight, background, invert };
}

function surfaced(item: Item, { material, color, wireframe }: Preset): Item {
    // a new crease is as suits the shape: flat meshes that become smooth keep their edges
    return { ...item, material: { ...item.material, ...(material as Partial<Item["material"]>) }, color, wireframe };
}

/** Return the name of the look that a document has; null where it has another one. */
export function lookOf(doc: Document): string | null {
    const shown = ({ objects, ambientLight, background, invert }: Document): string =>
        JSON.stringify([objects, ambientLight, background, invert]);
    const found = LOOKS.find(({ name }) => shown(applyLook(doc, name)) === shown(doc));
    return found && found.lamps.length === doc.lights.length ? found.name : null;
}

/** Return the document with a random look, palette and camera. random: returns numbers from 0 to below 1. */
export function surprise(doc: Document, meshes: Meshes, random: () => number = Math.random): Document {
    const between = (low: number, high: number): number => low + (high - low) * random();
    const shown = LOOKS.filter(({ material }) => material["shading"] !== "unlit");
    const look = shown[Math.floor(random() * shown.length)] as Preset;
    const turned = withCamera(doc, {
        azimuth: Math.round(between(-180, 180)),
        elevation: Math.round(between(-5, 45)),
        roll: 0,
        fov: Math.round(between(20, 60)),
    });
    const made = applyLook(fitted(turned, meshes), look.name);
    // all colours turn by the same angle, so that they go together as before
    const angle = between(0, 360);
    const turn = (color: string): string => hueTurned(color, angle);
    const color = random() < 0.4 ? null : turn(look.color ?? "#d08050");
    const { top, bottom } = made.background;
    return {
        ...changed(made, ALL, (item) => ({ ...item, color })),
        background: { top: turn(top), bottom: turn(bottom) },
        lights: made.lights.map((light) => ({ ...light, color: turn(light.color as string) })),
        ambientLight: turn(made.ambientLight),
    };
}

/** Return a colour "#rrggbb" of another hue. */
function hueTurned(color: string, angle: number): string {
    const levels = [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
    const [high, low] = [Math.max(...levels), Math.min(...levels)];
    if (high === low) return color;
    const [red, green, blue] = levels as [number, number, number];
    const sixth =
        (high === red
            ? (green - blue) / (high - low)
            : high === green
              ? 2 + (blue - red) / (high - low)
              : 4 + (red - green) / (high - low)) +
        angle / 60;
    const level = (offset: number): number => {
        const place = (((sixth + offset) % 6) + 6) % 6;
        return Math.round(low + (high - low) * Math.min(1, Math.max(0, Math.abs(place - 3) - 1)));
    };
    return toHex([0, 4, 2].map(level), "#");
}
