// SPDX-License-Identifier: BSD-3-Clause
// A canvas that shows map coordinates in metres and can be moved and zoomed by mouse, touch and keys.
class Canvas {
  // project: [x, y, z] -> [right, up] in metres; stretch: pixels a metre may differ in the two directions.
  constructor(canvas, project, stretch, draw, click) {
    Object.assign(this, {canvas, project, stretch, drawContent: draw, click});
    this.pointers = new Map();
    canvas.addEventListener("wheel", e => { e.preventDefault(); this.zoom(Math.exp(-e.deltaY / 400), e.offsetX, e.offsetY); }, {passive: false});
    canvas.addEventListener("pointerdown", e => { canvas.setPointerCapture(e.pointerId); this.pointers.set(e.pointerId, e); this.moved = 0; });
    canvas.addEventListener("pointermove", e => this.move(e));
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, e => this.release(e, name));
    canvas.addEventListener("dblclick", () => { this.fit(); this.draw(); });
    canvas.addEventListener("keydown", e => this.key(e));
    new ResizeObserver(() => { this.fit(); this.draw(); }).observe(canvas);
  }

  points() { return this.content || []; }

  fit() {
    const ratio = window.devicePixelRatio || 1, c = this.canvas;
    this.width = c.clientWidth; this.height = c.clientHeight;
    c.width = this.width * ratio; c.height = this.height * ratio;
    this.pen = c.getContext("2d");
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    let [l, r, b, t] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const p of this.points()) { const [x, y] = this.project(p); l = Math.min(l, x); r = Math.max(r, x); b = Math.min(b, y); t = Math.max(t, y); }
    if (l > r) [l, r, b, t] = [-1, 1, -1, 1];
    const w = Math.max(r - l, 1), h = Math.max(t - b, this.stretch ? .5 : 1), margin = 46;
    this.sx = (this.width - 2 * margin) / w; this.sy = (this.height - 2 * margin) / h;
    if (!this.stretch) this.sx = this.sy = Math.min(this.sx, this.sy);
    else this.sy = Math.max(this.sx, Math.min(this.sy, 20 * this.sx));
    this.ox = this.width / 2 - this.sx * (l + r) / 2; this.oy = this.height / 2 + this.sy * (b + t) / 2;
  }

  at(p) { const [x, y] = this.project(p); return [this.ox + this.sx * x, this.oy - this.sy * y]; }

  zoom(factor, x, y) {
    if (this.sx * factor > 1e5 || this.sx * factor < 1e-3) return;
    this.ox = x + (this.ox - x) * factor; this.oy = y + (this.oy - y) * factor;
    this.sx *= factor; this.sy *= factor;
    this.draw();
  }

  move(e) {
    const before = this.pointers.get(e.pointerId);
    if (!before) return;
    const others = [...this.pointers.values()].filter(p => p.pointerId !== e.pointerId);
    this.moved += Math.hypot(e.offsetX - before.offsetX, e.offsetY - before.offsetY);
    this.pointers.set(e.pointerId, e);
    if (others.length) {  // two fingers
      const o = others[0], far = p => Math.hypot(p.offsetX - o.offsetX, p.offsetY - o.offsetY);
      this.zoom(far(e) / Math.max(far(before), 1), (e.offsetX + o.offsetX) / 2, (e.offsetY + o.offsetY) / 2);
      return;
    }
    this.ox += e.offsetX - before.offsetX; this.oy += e.offsetY - before.offsetY;
    this.draw();
  }

  release(e, name) {
    const known = this.pointers.delete(e.pointerId);
    if (known && name === "pointerup" && this.moved < 4 && this.click) this.click(e.offsetX, e.offsetY);
  }

  key(e) {
    const step = {ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40]}[e.key];
    if (step) { this.ox += step[0]; this.oy += step[1]; }
    else if (e.key === "+" || e.key === "=") return this.zoom(1.25, this.width / 2, this.height / 2);
    else if (e.key === "-") return this.zoom(.8, this.width / 2, this.height / 2);
    else if (e.key === "0") this.fit();
    else return;
    e.preventDefault();
    this.draw();
  }

  draw() {
    if (!this.pen || !this.width) return;
    this.pen.clearRect(0, 0, this.width, this.height);
    this.grid();
    this.drawContent(this);
    // Last, so that no path hides it.
    this.labels();
  }

  // A line every 1, 2 or 5 times a power of ten metres, about 90 pixels apart.
  ticks(scale, offset, size, sign) {
    const raw = 90 / scale, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map(k => k * power).find(s => s >= raw), out = [];
    const [a, b] = [-offset / scale * sign, (size - offset) / scale * sign].sort((p, q) => p - q);
    for (let k = Math.ceil(a / step); k * step <= b; ++k) out.push([+(k * step).toPrecision(9), offset + sign * scale * k * step]);
    return out;
  }

  grid() {
    this.xTicks = this.ticks(this.sx, this.ox, this.width, 1);
    this.yTicks = this.ticks(this.sy, this.oy, this.height, -1);
    this.pen.strokeStyle = "#e8ede9"; this.pen.lineWidth = 1;
    this.pen.beginPath();
    for (const [, x] of this.xTicks) { this.pen.moveTo(x, 0); this.pen.lineTo(x, this.height); }
    for (const [, y] of this.yTicks) { this.pen.moveTo(0, y); this.pen.lineTo(this.width, y); }
    this.pen.stroke();
  }

  labels() {
    const pen = this.pen;
    pen.font = "11px system-ui, sans-serif"; pen.fillStyle = "#7b887f";
    pen.textAlign = "center";
    for (const [v, x] of this.xTicks) if (x > 40 && x < this.width - 20) pen.fillText(`${v} m`, x, this.height - 6);
    pen.textAlign = "left";
    for (const [v, y] of this.yTicks) if (y > 14 && y < this.height - 20) pen.fillText(`${v} m`, 5, y - 3);
  }
}
