// Minting publishes a changed copy permanently, and may sell it: whether licences allow this.

import type { App } from "../app.js";
import type { Document } from "../../document/document.js";
import { originOf } from "../programs/subject.js";

/** Licences that allow it, in lower case, with single spaces between the words: as the command line has them. */
const ALLOWED =
    /^(?:my own work|own work|public domain|cc ?0( 1\.0)?( universal)?|cc by( sa)?( [1-4]\.0)?( international)?|(the )?mit( 0)?( licen[cs]e)?|apache( licen[cs]e)?( 2(\.0)?)|0 ?bsd|bsd [0-3] clause( licen[cs]e)?|isc( licen[cs]e)?|zlib( licen[cs]e)?|(the )?unlicense|wtfpl)$/;

/** Return whether a licence is known to allow it. */
export function allows(licence: string): boolean {
    const words = licence.toLowerCase().replace(/[\s_-]+/g, " ");
    return ALLOWED.test(words.trim());
}

/** refused: why a picture must not be minted, or "". isOwn: whether the visitor has to state the licence of a file. */
export interface Rights {
    refused: string;
    isOwn: boolean;
    /** The licence that the files themselves state. */
    stated: string;
}

/** Return what is known of the meshes of a document. */
export async function rightsOf({ assets, meshes }: App, doc: Document): Promise<Rights> {
    await meshes.need(doc);
    const [known, stated] = [await assets.pieces(), new Set<string>()];
    for (const item of doc.objects) {
        const { licence } = originOf({ meshes }, item);
        const piece = "piece" in item.mesh ? item.mesh.piece : null;
        if (piece === null) stated.add(licence);
        else if (!allows(licence) || known.find(({ name }) => name === piece)?.commercial === false) {
            const refused = `“${piece}” must not be minted: its licence (${licence || "none is known"}) is not known to allow `;
            return { refused: `${refused}commercial use of changed copies.`, isOwn: false, stated: "" };
        }
    }
    return { refused: "", isOwn: stated.size > 0, stated: stated.size === 1 ? [...stated].join() : "" };
}
