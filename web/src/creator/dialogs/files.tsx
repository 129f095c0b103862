// Files for other programs, and programs that make the picture.

import type { Document } from "../../document/document.js";
import { pythonProgram } from "../programs/python.js";
import { solidityProgram } from "../programs/solidity.js";
import { stemOf, titleOf } from "../programs/subject.js";
import { sceneFile } from "../../document/save.js";
import type { App } from "../app.js";
import { Code, Progress, Row, madeOf, useTask, type TabProps } from "./widgets.js";

interface Kind {
    name: string;
    title: string;
    help: string;
    extension: string;
    make: (app: App, doc: Document, signal: AbortSignal) => Promise<Blob>;
}

const KINDS: readonly Kind[] = [
    {
        name: "scene",
        title: "Scene file",
        help: "Everything, with its meshes: for this page, and for shackled render.",
        extension: "json",
        make: async ({ meshes }, doc) => new Blob([await sceneFile(doc, meshes)], { type: "application/json" }),
    },
    {
        name: "glb",
        title: "GLB model",
        help: "For Blender and other 3D programs, by the contract GlbEncoder; without light and textures.",
        extension: "glb",
        make: ({ work }, doc, signal) => work.glb(doc, { signal }),
    },
    {
        name: "svg",
        title: "SVG",
        help: "Its pixels stay sharp at any size; made by the contract PngEncoder.",
        extension: "svg",
        make: ({ work }, doc, signal) => work.svg(doc, { signal }),
    },
    {
        name: "bmp",
        title: "BMP",
        help: "The bytes that the contract returned.",
        extension: "bmp",
        make: ({ work }, doc, signal) => work.bmp(doc, { signal }),
    },
];

export function FilesTab({ app, doc, subject }: TabProps) {
    const stem = stemOf(titleOf(doc));
    return (
        <>
            <section class="files">
                {KINDS.map((kind) => (
                    <FileOf key={kind.name} kind={kind} app={app} doc={doc} stem={stem} />
                ))}
            </section>
            <Code
                app={app}
                name="python"
                title="Python"
                help="Renders the same picture, and checks that it is the same."
                file={`${stem}.py`}
                made={madeOf(subject, pythonProgram)}
            />
            <Code
                app={app}
                name="solidity"
                title="Solidity"
                help="A contract with the scene. Its first line states the licence of the meshes."
                file={`${stem}.sol`}
                made={madeOf(subject, solidityProgram)}
            />
        </>
    );
}

function FileOf({ kind, app, doc, stem }: { kind: Kind; app: App; doc: Document; stem: string }) {
    const { name, title, help, extension, make } = kind;
    const task = useTask();
    const save = async (signal: AbortSignal): Promise<void> =>
        app.save(await make(app, doc, signal), `${stem}.${extension}`);
    return (
        <Row title={title} help={help} name={`take-${name}`} does={() => task.start(save)} off={task.part !== null}>
            <Progress task={task} what={`Making the ${title}`} />
        </Row>
    );
}
