// Files, programs, and what chains take, in three tabs.

import { hashPixels } from "../../picture.js";
import type { App } from "../app.js";
import { open, show } from "../state.js";
import { prepare, sceneOf } from "../../document/document.js";
import { ChainTab } from "./chain.js";
import { FilesTab } from "./files.js";
import { Choices, drawnOf, useMade } from "./widgets.js";
import { PictureTab } from "./picture.js";

const TABS = [
    ["picture", "Picture"],
    ["files", "Files and programs"],
    ["chain", "On chain"],
] as const;

export function Download({ app }: { app: App }) {
    const doc = app.doc.value;
    const drawn = useMade((signal) => drawnOf(app, doc, signal), [doc]);
    const link = app.address;
    const subject = useMade(
        async (signal) => {
            const { gas, triangles, pixels } = await drawnOf(app, doc, signal);
            await prepare(doc, app.meshes);
            const scene = sceneOf(doc, app.meshes);
            const [call, sha256] = await Promise.all([app.work.call(doc, { signal }), hashPixels(pixels)]);
            return { doc, meshes: app.meshes, scene, call, gas, triangles, sha256, link };
        },
        [doc, link],
    );
    const made = { value: subject.value, error: drawn.error || subject.error };
    const Tab = { picture: PictureTab, files: FilesTab, chain: ChainTab }[open.value.tab];
    return (
        <>
            <Choices name="take" label="What to take" value={open.value.tab} of={TABS} does={(tab) => show({ tab })} />
            <Tab app={app} doc={doc} drawn={drawn.value} subject={made} />
        </>
    );
}
