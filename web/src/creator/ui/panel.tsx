// The panels, which are made of the table of controls.

import { useSignal } from "@preact/signals";
import type { ComponentChildren, TargetedEvent } from "preact";
import { MAX_LIGHTS } from "../../scene/constants.js";
import type { App } from "../app.js";
import { CONTROLS, GROUPS, lightControls, resetGroup, type Control } from "../controls.js";
import type { Document } from "../../document/document.js";
import { addLight, onDisc, removeLight } from "../../document/lamps.js";
import { chosen } from "../../document/measure.js";
import { capital } from "../../document/fields.js";
import { Button, Choices, IconButton } from "./icons.js";
import { dragsLight } from "./lamp_drag.js";
import { Looks } from "./looks.js";
import { Objects } from "./objects.js";
import { Row } from "./rows.js";

type Group = (typeof GROUPS)[number]["name"];

/** The panels that are open at first. */
const OPEN = ["material", "lights"];
/** What only some need: it is shown under "More". Controls that are new are not in it. */
const RARE = new Set([
    ...["pose.rotation.x", "pose.rotation.z", "camera.roll", "camera.target.x", "camera.target.y", "camera.target.z"],
    ...["scene.lights_follow", "scene.invert", "material.ambient", "material.diffuse", "object.max_triangles"],
    ...["material.emission", "object.crease", "object.cull", "object.wireframe", "object.two_sided"],
]);
/** The controls of a light that are always shown. */
const OF_LIGHT = ["color", "shadow"];
/** Sides with a button of their own. */
const SIDES = [64, 128, 256, 512].map((side) => ({
    name: side,
    title: String(side),
    spoken: `${side} by ${side} pixels`,
}));

export function Panel({ app }: { app: App }) {
    const changed = app.calm.value !== app.own.value;
    const reset = (): void => app.change(app.own.value, "Reset everything");
    return (
        <section class="panel" aria-label="Controls" id="page-scene">
            <Looks app={app} />
            <Objects app={app} />
            {GROUPS.map(({ name, title }) => (
                <GroupPanel key={name} app={app} name={name} title={title} />
            ))}
            <div class="looks" hidden={!changed}>
                <Button name="reset" label="Reset everything" id="reset-all" onClick={reset} />
            </div>
        </section>
    );
}

/** Something that can be opened, whose content is not there before. */
function Fold(props: { name: string; title: ComponentChildren; class: string; children: ComponentChildren }) {
    const isOpen = useSignal(OPEN.includes(props.name));
    const toggle = ({ currentTarget }: TargetedEvent<HTMLDetailsElement>): void =>
        void (isOpen.value = currentTarget.open);
    return (
        <details class={props.class} open={isOpen} data-name={`panel-${props.name}`} onToggle={toggle}>
            <summary>{props.title}</summary>
            {isOpen.value && <div class="body">{props.children}</div>}
        </details>
    );
}

function GroupPanel({ app, name, title }: { app: App; name: Group; title: string }) {
    const heading = [title, <small key="">{summary(app, app.calm.value, name)}</small>];
    return (
        <Fold name={name} title={heading} class="group">
            <Body app={app} name={name} />
        </Fold>
    );
}

function Body({ app, name }: { app: App; name: Group }) {
    const doc = app.calm.value;
    const { own, selected, meshes } = app;
    const all = CONTROLS.filter(({ group }) => group === name);
    const rows = (of: readonly Control[]) => of.map((each) => <Row key={each.path} app={app} of={each} />);
    const rare = all.filter(({ path, shown }) => RARE.has(path) && shown(doc, selected.value));
    const isChanged =
        all.some((each) => each.shown(doc, selected.value) && each.changed(doc, selected.value, own.value, meshes)) ||
        (name === "lights" && JSON.stringify(doc.lights) !== JSON.stringify(own.value.lights));
    const add = (): void => app.change(addLight(app.doc.value), "Add a light");
    const reset = (): void => app.change(resetGroup(app.doc.value, name, selected.value, own.value, meshes), "Reset");
    return (
        <>
            {name === "lights" && doc.lights.map((_, number) => <Light key={number} app={app} number={number} />)}
            {name === "picture" && <Sizes app={app} doc={doc} />}
            {rows(all.filter(({ path }) => !RARE.has(path)))}
            {rare.length > 0 && (
                <Fold name={`${name}-more`} title="More" class="more">
                    {rows(rare)}
                </Fold>
            )}
            <div class="row-of">
                {name === "lights" && doc.lights.length < MAX_LIGHTS && (
                    <Button name="plus" label="Add a light" id="add-light" onClick={add} />
                )}
                {name === "picture" && doc.background.top !== doc.background.bottom && (
                    <Button name="copy" label="One colour" id="one-color" onClick={() => oneColor(app)} />
                )}
                {isChanged && (
                    <Button name="reset" label={`Reset ${name}`} id={`reset-${name}`} onClick={reset}>
                        Reset
                    </Button>
                )}
            </div>
        </>
    );
}

function oneColor(app: App): void {
    const { top } = app.doc.value.background;
    app.change({ ...app.doc.value, background: { top, bottom: top } }, "One colour");
}

function Sizes({ app, doc }: { app: App; doc: Document }) {
    const size = (side: number): void => app.change({ ...app.doc.value, width: side, height: side }, "Size");
    const chosen = doc.width === doc.height ? doc.width : null;
    return <Choices id="size" label="Common sizes" of={SIDES} chosen={chosen} choose={size} />;
}

function Light({ app, number }: { app: App; number: number }) {
    const light = app.calm.value.lights[number];
    if (!light) return null;
    const title = `Light ${number + 1}`;
    const controls = lightControls(number);
    const isMain = ({ path }: Control): boolean => OF_LIGHT.some((name) => path === `lights.${number}.${name}`);
    const rows = (of: readonly Control[]) =>
        of.map((each) => <Row key={each.path} app={app} of={each} prefix={`${title}: `} />);
    return (
        <fieldset class="lamp" data-name={`light-${number}`}>
            <legend class="unseen">{title}</legend>
            <div class="head">
                <Sphere app={app} number={number} />
                <b aria-hidden="true">
                    {title} <span class="quiet">{light.kind}</span>
                </b>
                <IconButton
                    small
                    name="remove"
                    label={`Remove light ${number + 1}`}
                    id={`remove-light-${number}`}
                    onClick={() => app.change(removeLight(app.doc.value, number), "Remove a light")}
                />
            </div>
            {rows(controls.filter(isMain))}
            <Fold name={`light-${number}-more`} title="Kind and place" class="more">
                {rows(controls.filter((each) => !isMain(each)))}
            </Fold>
        </fieldset>
    );
}

/** A sphere on which a light is dragged; outside of the circle it is behind the object. */
function Sphere({ app, number }: { app: App; number: number }) {
    const doc = app.calm.value;
    const light = doc.lights[number];
    if (!light) return null;
    const { x, y, near } = onDisc(doc, light);
    const place = { "--left": `${50 + 50 * x}%`, "--top": `${50 + 50 * y}%` };
    const style = { ...place, "--x": `${50 + 38 * x}%`, "--y": `${50 + 38 * y}%`, "--lamp": String(light.color) };
    const title = "Drag the light; outside of the circle it is behind the object";
    const drags = dragsLight(app, number, (element) => element.getBoundingClientRect());
    return (
        <div class="sphere" style={style} aria-hidden="true" title={title} data-name={`sphere-${number}`} {...drags}>
            <i class={near ? "" : "behind"} />
        </div>
    );
}

/** Return what a closed panel says of itself. */
function summary(app: App, doc: Document, name: Group): string {
    const on = (...names: (string | false | null)[]): string => names.filter(Boolean).join(", ") || "Off";
    switch (name) {
        case "material": {
            const shadings = new Set(chosen(doc, app.selected.value).map(({ material }) => material.shading));
            return shadings.size === 1 ? capital([...shadings][0]) : "Mixed";
        }
        case "lights":
            return `${doc.lights.length}${doc.lights.some(({ shadow }) => shadow) ? ", shadow" : ""}`;
        case "ground":
            return on(doc.ground && "On");
        case "atmosphere":
            return on(doc.hemisphere && "Sky", doc.rim && "Rim", doc.fog && "Fog");
        case "tone":
            return on(doc.tone && "On");
        case "camera":
            return capital(doc.camera.projection);
        case "picture":
            return `${doc.width} × ${doc.height}${doc.antialias ? ", smooth" : ""}`;
        default:
            return "";
    }
}
