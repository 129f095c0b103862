// A picture with everything that programs say of it, and the names and comments that they share.

import type { Scene } from "../../scene/types.js";
import type { Document, Item, Meshes } from "../../document/document.js";

/** What programs are made of. */
export interface Subject {
    doc: Document;
    meshes: Meshes;
    /** The scene of the document, and the calldata that draws it. */
    scene: Scene;
    call: Uint8Array;
    /** What drawing it gave. sha256: of the pixels; null where the browser has no hash for pages like this one. */
    gas: number;
    triangles: number;
    sha256: string | null;
    /** The address that restores the picture; "" for none. */
    link: string;
}

/** Return what a document is called: by its objects, where it has no title. */
export function titleOf({ title, objects }: Document): string {
    const names = objects.map(({ name, mesh }) => {
        const piece = "piece" in mesh ? mesh.piece.replace(/^.*\//, "") : "";
        return /^\d*$/.test(name.trim()) ? piece : oneLine(name);
    });
    return oneLine(title) || [...new Set(names)].filter(Boolean).slice(0, 3).join(", ") || "Untitled";
}

/** Return a name for files, such as "genesis-12", from a title. */
export function stemOf(title: string): string {
    const plain = title.normalize("NFKD").replace(/\p{M}/gu, "");
    const words = plain
        .replace(/\.(?:zip|glb|gltf|obj|ply|stl|off|png|toml|json)$/i, "")
        .replace(/[^0-9A-Za-z]+/g, "-");
    // names such as con, nul or com1 are devices where Windows runs
    const stem = words
        .slice(0, 40)
        .replace(/^-+|-+$/g, "")
        .toLowerCase();
    return /^(?:con|prn|aux|nul|(?:com|lpt)\d)?$/.test(stem) ? `${stem}picture` : stem;
}

/** Return an address as a comment has it: with the remark that it is good for this computer only, where it is. */
export function linkLines(link: string): string[] {
    if (!link) return [];
    return isLocal(link) ? [link, "The link works on this computer only."] : [link];
}

/** Return whether an address leads nowhere on other computers. */
export function isLocal(address: string): boolean {
    if (!URL.canParse(address)) return true;
    const { protocol, hostname } = new URL(address);
    return !/^https?:$/.test(protocol) || /^(?:(?:.*\.)?localhost|127(?:\.\d+){3}|\[::1\])$/.test(hostname);
}

/** What is known of where the mesh of an object is from. */
export function originOf({ meshes }: Pick<Subject, "meshes">, { mesh }: Item): { notice: string; licence: string } {
    const { notice, licence } = meshes.get(mesh);
    return { notice: oneLine(notice), licence: oneLine(licence) };
}

/** Return the notices of all meshes, each once. */
export function notices(subject: Subject): string[] {
    const all = subject.doc.objects.map((item) => originOf(subject, item).notice);
    return [...new Set([oneLine(subject.doc.notice), ...all])].filter(Boolean);
}

export function oneLine(text: string): string {
    return text.replace(/[\s\p{C}]+/gu, " ").trim();
}
