// The pictures of a movement, computed in this browser by the bytecode of the contracts. The server learns where the
// camera is when the movement ends, and renders the picture at rest. Where this is not possible it renders all of them.

const names = { orbit: "drag", pan: "pan", zoom: "zoom" };
// milliseconds without a movement after which one without a pointer ends, and after a picture at rest before its scene
// is prepared
const REST = 200, PAUSE = 250;
// how many times nearer or farther the camera may be than that of the call, whose near plane fits its own
const REACH = 4;

export class Local {
  // send(message): to the server. paint(drawn, camera): shows a picture of a movement. prepared(is): whether pictures
  // of a movement can be drawn
  constructor({ send, paint, prepared }) {
    Object.assign(this, { send, paint, prepared });
    this.possible = typeof WebAssembly === "object" && typeof Worker === "function";
    this.tools = null; // /web/live.js, once it is needed
    this.view = null; // draws
    this.base = null; // the view of the server that can be drawn: see live.py
    this.moving = null; // the camera during a movement
    this.stamp = 0;
    this.join("");
  }

  // the page is connected. name: of the visitor
  join(name) {
    this.visitor = name;
    this.expected = 0; // pictures of earlier movements are outdated
    this.key = this.failed = null;
    this.camera = this.moving = null; // of the picture at rest; null while it is not known
  }

  // a picture at rest arrives; returns whether it is to be shown
  settle({ key, camera, stamp }) {
    if (stamp < this.expected) return false;
    this.key = key;
    if (this.moving) return false; // another follows
    this.camera = camera;
    this.prepare();
    return true;
  }

  prepare() {
    clearTimeout(this.timer);
    this.prepared(this.fits());
    if (this.possible && this.failed !== this.key && !this.fits()) this.timer = setTimeout(() => this.open(), PAUSE);
  }

  fits() {
    const ratio = this.camera && this.base && this.camera.distance / this.base.camera.distance;
    return this.base?.key === this.key && ratio > 1 / REACH && ratio < REACH;
  }

  async open() {
    if (this.opening || this.moving) return;
    const { key } = this;
    this.opening = true;
    this.base = null;
    try {
      this.tools ??= await import("/web/live.js");
      this.view ??= new this.tools.LiveView({ evm: "/web/evm.wasm", contracts: "/web/contracts.json" });
      const answer = await fetch(`/call/${this.visitor}`);
      if (!answer.ok) throw new Error(await answer.text());
      const data = await answer.arrayBuffer();
      const length = new DataView(data).getUint32(0);
      const base = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
      await this.view.open(new Uint8Array(data.slice(4 + length)), base);
      this.base = base;
      this.prepared(this.fits());
    } catch {
      this.failed = key;
    }
    this.opening = false;
    if (this.key !== key) this.prepare();
  }

  // whether a movement is drawn here. name: "orbit", "pan" or "zoom". held: it goes on until `end`
  move(name, { x, y, notches }, held) {
    if (!this.moving) {
      const ready = this.camera && this.base?.key === this.key && !this.remote;
      this.remote = held && !ready; // until the pointer is released
      if (!ready) return this.leave();
      this.view.begin();
      this.moving = this.camera;
    }
    this.moving = this.tools[names[name]](this.moving, ...(name === "zoom" ? [notches] : [x, y]));
    clearTimeout(this.idle);
    if (!held) this.idle = setTimeout(() => this.end(), REST);
    this.draw();
    return true;
  }

  async draw() {
    if (this.drawing) return;
    this.drawing = true;
    try {
      for (let camera = null; this.moving && this.moving !== camera;) {
        camera = this.moving;
        const drawn = await this.view.draw(camera);
        if (this.moving) this.paint(drawn, camera);
      }
    } catch {
      this.failed = this.key;
      this.base = null;
      this.end();
    }
    this.drawing = false;
  }

  // end a movement that is drawn here; whether there was one
  end() {
    clearTimeout(this.idle);
    this.remote = false;
    if (!this.moving) return false;
    const { azimuth, elevation, distance, target } = this.camera = this.moving;
    this.moving = null;
    this.expected = ++this.stamp;
    this.send({ do: "camera", azimuth, elevation, distance, target, stamp: this.stamp });
    return true;
  }

  // the server changes something: until its next picture at rest the camera is not known. Returns false
  leave() {
    if (this.moving) this.end();
    this.camera = null;
    return false;
  }
}
