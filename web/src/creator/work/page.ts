// The page of one file that shows a scene in any browser: the template of `shackled export`, filled in.

import { InputError } from "../../errors.js";
import { deflate, toBase64 } from "../../bytes.js";
import type { PageAssets } from "../assets.js";
import type { Document } from "../../document/document.js";
import type { Drawn } from "./protocol.js";

/** The most bytes of a call, and gas of a picture, that <shackled-view> takes, and the most bytes of a PNG file in the page. */
const MAX_CALL = 1 << 24;
const MAX_GAS = 30_000_000_000;
const MAX_PNG = 1 << 19;

interface Content {
    doc: Document;
    drawn: Drawn;
    png: Uint8Array<ArrayBuffer>;
    call: Uint8Array<ArrayBuffer>;
    sha256: string;
}

export async function pageOf(
    assets: Pick<PageAssets, "bytes" | "text">,
    { doc, drawn, png, call, sha256 }: Content,
): Promise<string> {
    if (call.length > MAX_CALL || drawn.gas > MAX_GAS)
        throw new InputError("The scene is too large for a page: take fewer triangles or pixels");
    const title = escaped(doc.title || "Scene");
    const image = `<img src="data:image/png;base64,${toBase64(png)}" alt="${title}" width="${drawn.width}" height="${drawn.height}">`;
    const [template, ...data] = await Promise.all([
        assets.text("page.html"),
        packed(call),
        assets.bytes("evm.wasm").then(packed),
        assets.bytes("contracts.json").then(packed),
    ]);
    const values: Record<string, string> = {
        title,
        still: png.length > MAX_PNG ? "<noscript><p>The picture is drawn by a script.</p></noscript>" : image,
        triangles: `${drawn.triangles.toLocaleString("en")} triangle${drawn.triangles === 1 ? "" : "s"}`,
        width: String(drawn.width),
        height: String(drawn.height),
        gas: `, ${drawn.gas.toLocaleString("en")} gas`,
        sha256,
        notice: doc.notice && `<p>${escaped(doc.notice)}</p>`,
        scene: data[0],
        evm: data[1],
        contracts: data[2],
    };
    return template.replace(/\{\{(\w+)\}\}/g, (mark, name: string) => values[name] ?? mark);
}

async function packed(bytes: Uint8Array<ArrayBuffer>): Promise<string> {
    return toBase64(await deflate(bytes, "gzip"));
}

function escaped(text: string): string {
    return text.replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);
}
