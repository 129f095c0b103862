// The page of `shackled preview`: follows the events of the server. All text of tokens is untrusted: it becomes text nodes.
"use strict";

const $ = (id) => document.getElementById(id);
const numbers = new Intl.NumberFormat("en");
const SVG = "http://www.w3.org/2000/svg";
const HTML = "text/html";
const MODEL = "model/gltf-binary";

let state = { version: -1, status: "connecting" };
/** The tokens that are shown and their cards, by number: those of an earlier version until a newer one takes their place. */
const tokens = new Map();
const cards = new Map();
/** The number of the token whose details are open. */
let opened = null;

function element(tag, text, className) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  return made;
}

function rectangle(x, y, width, height, className) {
  const made = document.createElementNS(SVG, "rect");
  for (const [key, value] of Object.entries({ x, y, width, height })) made.setAttribute(key, value);
  if (className) made.setAttribute("class", className);
  return made;
}

const file = (token, which) => `file/${token.version}/${token.number}/${which}`;
const isOver = (token) => token.gas !== null && token.gas > state.max_gas;

/** The name of a token with its number, unless that is part of the name. */
function title(token) {
  const number = `#${token.number}`;
  if (!token.name) return [number];
  return token.name.split(/\s+/).includes(number) ? [token.name] : [token.name, " ", element("span", number, "number")];
}

/** A card of a token. */
function card(token) {
  const made = element("button", undefined, "token");
  made.type = "button";
  const picture = element("span", undefined, "picture");
  if (token.image) {
    const image = element("img");
    image.loading = "lazy";
    image.alt = token.name || `token ${token.number}`;
    image.src = file(token, "image");
    picture.append(image);
  }
  const words = element("span", undefined, "words");
  const name = element("strong");
  name.append(...title(token));
  words.append(name);
  if (token.gas !== null) {
    words.append(element("span", `${numbers.format(token.gas)} gas`, "gas"));
    const meter = document.createElementNS(SVG, "svg");
    meter.setAttribute("class", isOver(token) ? "meter over" : "meter");
    meter.setAttribute("viewBox", "0 0 100 3");
    meter.setAttribute("preserveAspectRatio", "none");
    meter.append(rectangle(0, 0, Math.min(100, (100 * token.gas) / state.max_gas), 3));
    words.append(meter);
  }
  for (const problem of token.problems) words.append(element("span", problem, "problem"));
  made.classList.toggle("wrong", token.problems.length > 0);
  made.hidden = isHidden(token);
  made.append(picture, words);
  made.addEventListener("click", () => show(token));
  return made;
}

const isHidden = (token) => $("wrong").checked && !token.problems.length;

/** Put a token in the place of the one with its number, or among the others. */
function place(token) {
  const made = card(token);
  const old = cards.get(token.number);
  const last = $("tokens").lastElementChild;
  if (old) {
    const hadFocus = document.activeElement === old;
    old.replaceWith(made);
    if (hadFocus) made.focus();
  } else {
    const isLater = (each) => BigInt(each.dataset.number) > BigInt(token.number);
    $("tokens").insertBefore(made, last && isLater(last) ? [...$("tokens").children].find(isLater) : null);
  }
  made.dataset.number = token.number;
  tokens.set(token.number, token);
  cards.set(token.number, made);
  if (opened === token.number) show(token);
}

function remove(number) {
  cards.get(number).remove();
  cards.delete(number);
  tokens.delete(number);
  if (opened === number) $("details").close();
}

/** The gas of all tokens, with the line of what is allowed. */
function chart() {
  const known = [...tokens.values()].filter((token) => token.gas !== null);
  $("chart").hidden = !known.length;
  if (!known.length) return;
  const gas = known.map((token) => token.gas);
  const most = Math.max(state.max_gas * 1.08, ...gas);
  const svg = $("bars");
  const width = Math.max(state.count, 16);
  svg.setAttribute("viewBox", `0 0 ${width} 100`);
  svg.replaceChildren();
  for (const token of known) {
    const height = (100 * token.gas) / most;
    const left = Number(BigInt(token.number) - BigInt(state.first));
    svg.append(rectangle(left + 0.1, 100 - height, 0.8, height, isOver(token) ? "over" : ""));
  }
  const line = document.createElementNS(SVG, "line");
  const y = 100 - (100 * state.max_gas) / most;
  for (const [key, value] of Object.entries({ x1: 0, x2: width, y1: y, y2: y })) line.setAttribute(key, value);
  svg.append(line);
  const mean = Math.round(gas.reduce((sum, each) => sum + each, 0) / gas.length);
  const over = known.filter(isOver).length;
  $("caption").textContent =
    `Gas of ${state.function}: ${numbers.format(mean)} on average, ${numbers.format(Math.max(...gas))} at most; ` +
    `the line is ${numbers.format(state.max_gas)}${over ? `, and ${over} are above it` : ""}`;
}

function status() {
  const all = [...tokens.values()];
  const wrong = all.filter((token) => token.problems.length).length;
  const read = all.filter((token) => token.version === state.version).length;
  const said = {
    connecting: "connecting",
    compiling: "compiling",
    failed: "failed; waiting for the next save",
    drawing: `${read} of ${state.count} tokens`,
    done: `${tokens.size} tokens in ${state.seconds} s; waiting for the next save`,
  };
  $("status").textContent = said[state.status];
  $("title").textContent = state.contract || "Preview";
  document.title = `${state.contract || "Preview"} – ${said[state.status]}`;
  $("count").textContent = wrong ? `(${wrong})` : "";
  $("tokens").classList.toggle("old", state.status === "failed");
  $("error").hidden = state.status !== "failed";
  $("error").textContent = state.error || "";
  $("notes").replaceChildren(...(state.notes ?? []).map((note) => element("li", note)));
}

/** The picture of a token, or what takes its place when it moves. */
function media(token) {
  const shown = [];
  if (token.animation === HTML) {
    const frame = element("iframe");
    frame.setAttribute("sandbox", "allow-scripts");
    frame.title = "animation";
    frame.src = file(token, "animation");
    shown.push(frame);
  } else if (token.animation && token.animation.startsWith("image/")) {
    const image = element("img");
    image.alt = `animation of ${token.name}`;
    image.src = file(token, "animation");
    shown.push(image);
  }
  if (token.image && !shown.length) {
    const image = element("img");
    image.alt = token.name;
    image.src = file(token, "image");
    shown.push(image);
  }
  if (token.animation && (token.animation === MODEL || !shown.length)) {
    const link = element("a", token.animation === MODEL ? "download the model (GLB)" : "download the animation");
    link.href = file(token, "animation");
    link.download = `${token.number}${token.animation === MODEL ? ".glb" : ""}`;
    shown.push(link);
  }
  return shown;
}

/** The details of a token, as a marketplace shows them; also in place of an earlier version of it that is open. */
async function show(token) {
  opened = token.number;
  const response = await fetch(`token/${token.version}/${token.number}`);
  if (!response.ok && !$("details").open) opened = null;
  if (!response.ok || tokens.get(opened) !== token) return;
  const found = (await response.json()).document;
  const text = (key) => (typeof found[key] === "string" ? found[key] : "");
  $("name").replaceChildren(...title(token));
  $("description").textContent = text("description");
  $("media").replaceChildren(...media(token));
  $("media").style.setProperty("--mat", /^[0-9a-f]{6}$/i.test(text("background_color")) ? `#${text("background_color")}` : "");
  $("traits").replaceChildren();
  for (const trait of Array.isArray(found.attributes) ? found.attributes : []) {
    if (trait === null || typeof trait !== "object") continue;
    const box = element("div");
    const value = trait.display_type === "date" ? new Date(trait.value * 1000).toDateString() : String(trait.value);
    const most = trait.max_value === undefined ? "" : ` of ${trait.max_value}`;
    box.append(element("dt", String(trait.trait_type ?? "")), element("dd", value + most));
    $("traits").append(box);
  }
  $("links").textContent = [text("external_url"), /^data:/.test(text("animation_url")) ? "" : text("animation_url")]
    .filter(Boolean)
    .join("  ·  ");
  const frames = token.frames > 1 ? `, ${token.frames} frames` : "";
  const costs = token.gas === null ? "" : `${numbers.format(token.gas)} gas, ${numbers.format(token.bytes)} bytes${frames}`;
  $("gas").textContent = [costs, ...token.notes].filter(Boolean).join("; ");
  $("problems").replaceChildren(...token.problems.map((problem) => element("li", problem)));
  const shortened = (key, value) => (typeof value === "string" && value.length > 300 ? `${value.slice(0, 300)}… (${value.length} characters)` : value);
  $("json").textContent = JSON.stringify(found, shortened, 2);
  if (!$("details").open) $("details").showModal();
}

function receive(message) {
  const { token, tokens: all, ...rest } = message;
  if (token === undefined) {
    state = rest;
    if (all !== undefined) {
      for (const number of [...tokens.keys()]) remove(number);
      all.forEach(place);
    }
    if (state.status === "done") {
      for (const { number, version } of [...tokens.values()]) if (version !== state.version) remove(number);
    }
    chart();
  } else if (rest.version === state.version) {
    place(token);
    if (tokens.size < 32 || tokens.size % 16 === 0) chart();
  }
  status();
}

$("wrong").addEventListener("change", () => {
  for (const token of tokens.values()) cards.get(token.number).hidden = isHidden(token);
});
$("details").addEventListener("close", () => {
  opened = null;
});
$("details").addEventListener("click", (event) => event.target === $("details") && $("details").close());
const events = new EventSource("events");
events.onmessage = (event) => receive(JSON.parse(event.data));
events.onerror = () => {
  $("status").textContent = "the preview has ended; start it again";
};
