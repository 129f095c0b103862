// The live view: shows pictures in a canvas, and turns pointers into movements.

export class View {
  // element: holds the canvas. move(name, amounts, keys, held): called on each movement, "orbit" and "pan" with x and y in
  // parts of the picture's height, "zoom" with notches of the wheel. rest(): called when all pointers are released.
  // covered(): whether pictures of a movement are painted, and others are not to be shown.
  constructor(element, { move, rest, covered }) {
    this.element = element;
    this.canvas = element.querySelector("canvas");
    this.move = (name, amounts, keys) => move(name, amounts, keys, this.held);
    this.rest = rest;
    this.covered = covered;
    this.latest = 0;
    this.pointers = new Map();
    this.spread = 0;
    const events = { pointerdown: "hold", pointermove: "drag", pointerup: "release", pointercancel: "release" };
    for (const [name, method] of Object.entries(events)) element.addEventListener(name, (event) => this[method](event));
    element.addEventListener("contextmenu", (event) => { if (event.button === 2) event.preventDefault(); });
    element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    // a focus ring is for the keyboard
    document.addEventListener("keydown", () => element.classList.remove("pointed"));
  }

  // file: an image. number: pictures with a lower number than the one shown are ignored. draft: whether it is reduced
  async show(file, number, draft) {
    const bitmap = await createImageBitmap(file);
    if (number < this.latest || this.covered()) return;
    this.latest = number;
    this.resize(bitmap).drawImage(bitmap, 0, 0);
    this.canvas.dataset.number = number;
    this.canvas.dataset.draft = draft;
  }

  // pixels of a picture that was drawn here
  paint(pixels) {
    this.resize(pixels).putImageData(pixels, 0, 0);
    this.canvas.dataset.draft = true;
    this.canvas.dataset.painted = Number(this.canvas.dataset.painted ?? 0) + 1;
  }

  resize({ width, height }) {
    const { canvas } = this;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    return canvas.getContext("2d");
  }

  get held() {
    return this.pointers.size > 0;
  }

  hold(event) {
    if (event.button === 1) return;
    this.element.classList.add("pointed");
    this.element.focus({ preventScroll: true });
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.pointers.size === 2) this.spread = this.distance();
  }

  drag(event) {
    const from = this.pointers.get(event.pointerId);
    if (!from) return;
    const pans = this.pointers.size > 1 || event.shiftKey || event.buttons & 2;
    const by = this.parts(event, from, !pans);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (this.pointers.size === 2) {
      this.move("pan", { x: by.x / 2, y: by.y / 2 }, ["x", "y"]);
      const now = this.distance();
      if (this.spread > 0 && Math.abs(Math.log(now / this.spread)) > 0.02) {
        this.move("zoom", { notches: 8 * Math.log(now / this.spread) }, ["notches"]);
        this.spread = now;
      }
    } else if (this.pointers.size === 1) {
      this.move(pans ? "pan" : "orbit", by, ["x", "y"]);
    }
  }

  release(event) {
    if (this.pointers.delete(event.pointerId) && !this.pointers.size) this.rest();
  }

  wheel(event) {
    event.preventDefault();
    const notches = -event.deltaY / (event.deltaMode === 1 ? 3 : 100);
    this.move("zoom", { notches: Math.max(-3, Math.min(3, notches)) }, ["notches"]);
  }

  distance() {
    const [a, b] = [...this.pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  }

  // the way of a pointer in parts of the picture's height; of its longer side for turning, or wide pictures would spin
  parts(event, from, turning) {
    const { width, height } = this.canvas.getBoundingClientRect();
    const all = (turning ? Math.max(width, height) : height) || 1;
    return { x: (event.clientX - from.x) / all, y: (event.clientY - from.y) / all };
  }
}
