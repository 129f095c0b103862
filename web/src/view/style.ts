// The look of the element: quiet, in the colours and the font of the page around it.

export const STYLE = `
:host { display: block; font: 0.8125rem/1.5 system-ui, sans-serif; color: inherit; --gap: 0.5rem; }
:host([hidden]) { display: none; }
* { box-sizing: border-box; }
[hidden] { display: none !important; }
.stage {
    position: relative; display: grid; min-height: 3.5rem; overflow: hidden; border-radius: 3px; cursor: grab; touch-action: none;
    background: color-mix(in srgb, currentColor 7%, transparent); user-select: none; -webkit-user-select: none;
}
.stage[data-moving] { cursor: grabbing; }
.stage > * { grid-area: 1 / 1; width: 100%; min-width: 0; }
canvas { display: block; height: auto; }
canvas.exact { image-rendering: pixelated; }
::slotted(*) { display: block; width: 100% !important; height: auto !important; margin: 0 !important; }
.veil {
    align-self: end; justify-self: start; width: auto; margin: var(--gap); padding: 0.1rem 0.5rem; border-radius: 3px;
    background: color-mix(in srgb, Canvas 85%, transparent); color: CanvasText; pointer-events: none;
}
.drop { outline: 2px dashed currentColor; outline-offset: -6px; }
.bar { display: flex; flex-wrap: wrap; align-items: baseline; gap: 0 1rem; padding-top: 0.4rem; }
.figures { display: flex; flex: 1 1 14rem; flex-wrap: wrap; gap: 0 0.9em; margin: 0; font-variant-numeric: tabular-nums; opacity: 0.8; }
.figures span { white-space: nowrap; }
.buttons { display: flex; gap: 0.9rem; }
button { font: inherit; color: inherit; background: none; border: 0; padding: 0.1rem 0; cursor: pointer; opacity: 0.8; }
.buttons button { text-decoration: underline 1px color-mix(in srgb, currentColor 35%, transparent); text-underline-offset: 0.25em; }
button:hover { opacity: 1; text-decoration-color: currentColor; }
button[aria-pressed="true"], button[aria-expanded="true"] { opacity: 1; text-decoration: underline 2px; }
:focus-visible { outline: 2px solid var(--shackled-focus, Highlight); outline-offset: 2px; border-radius: 3px; }
.stage:focus-visible { outline-offset: 3px; }
.error { margin: 0.4rem 0 0; padding: 0.3rem 0.6rem; border-left: 3px solid #c0392b; background: color-mix(in srgb, #c0392b 12%, transparent); overflow-wrap: anywhere; }
.panel { margin-top: 0.5rem; padding-top: 0.5rem; border-top: 1px solid color-mix(in srgb, currentColor 20%, transparent); }
.panel p { margin: 0 0 0.4rem; }
code { font: 0.92em ui-monospace, monospace; overflow-wrap: anywhere; }
form { display: flex; flex-wrap: wrap; gap: 0.4rem 0.5rem; align-items: center; }
input {
    flex: 1 1 12rem; min-width: 0; font: inherit; color: inherit; background: transparent; padding: 0.2rem 0.5rem;
    border: 1px solid color-mix(in srgb, currentColor 35%, transparent); border-radius: 3px;
}
input::placeholder { color: inherit; opacity: 0.5; }
form button { padding: 0.2rem 0.8rem; border: 1px solid color-mix(in srgb, currentColor 35%, transparent); border-radius: 3px; }
button:disabled { opacity: 0.4; cursor: default; }
.outcome { margin: 0.4rem 0 0 !important; overflow-wrap: anywhere; }
.outcome[data-outcome="equal"]::before { content: "\\2713  "; color: #2e8b57; font-weight: 600; }
.outcome[data-outcome="different"]::before { content: "\\2717  "; color: #c0392b; font-weight: 600; }
.hidden { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap; }
`;
