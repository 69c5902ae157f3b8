// SPDX-License-Identifier: BSD-3-Clause
// What the page shows, and everything that changes it.
import * as THREE from "three";
import {colourOf, labelOf} from "./data.js";
import {Changes} from "./changes.js";
import {hideDetail, showChange, showLoop, showNode, showStem} from "./detail.js";
import {$} from "./dom.js";
import {Images} from "./images.js";
import {Overlay} from "./overlay.js";
import {Pair} from "./pair.js";
import {Points} from "./points.js";
import {PosesTexture} from "./poses_texture.js";
import {buildColours, buildSide, drawStatus, rampStops} from "./side.js";
import {Stems} from "./stems.js";

const texture = (bytes, width) => {
  const t = new THREE.DataTexture(bytes, width, 1);
  t.magFilter = t.minFilter = width === 256 ? THREE.NearestFilter : THREE.LinearFilter;
  t.needsUpdate = true;
  return t;
};
const bytesOf = colour => new THREE.Color(colour).toArray().map(v => Math.round(255 * v));

export class App {
  constructor(data, stage, layers) {
    Object.assign(this, {data, stage, island: 0, time: data.last, colour: 1, heights: null, labels: new Set(), picked: null, placement: "odometry", withRest: false});
    this.layers = {odometry: false};
    if (data.loops.filter(l => l.state === "rejected").length > 300) this.layers.rejected = false;
    const redraw = () => stage.invalidate();
    this.poses = new PosesTexture(data);
    this.missionBytes = new Uint8Array(4 * 256);
    this.uniforms = {poses: {value: this.poses.texture}, missions: {value: texture(this.missionBytes, 256)}, labels: {value: this.labelTexture()},
      ramp: {value: texture(Uint8Array.from(rampStops.flatMap(c => [...bytesOf(c), 255])), rampStops.length)},
      moved: {value: false}, colourBy: {value: 1}, heights: {value: new THREE.Vector2(0, 1)}, size: {value: 2}, scale: {value: 1}, grain: {value: .03}};
    this.points = new Points(data, this.uniforms, redraw);
    this.overlay = new Overlay(data, stage.overlay);
    this.stems = new Stems(data, stage.solid);
    this.images = new Images(data, stage.solid, redraw);
    this.changes = layers.filter(l => l.kind === "changes").map(l => new Changes(data, stage.solid, l))[0] || null;
    this.layers["change ground"] = this.layers["change canopy"] = false;
    this.pair = new Pair(data, stage.solid, redraw);
    stage.solid.add(this.points.group);
    stage.before.push(() => this.beforeFrame());
    buildSide(this);
    this.layersChanged();
    this.seeAll();
  }

  labelTexture() {
    return texture(Uint8Array.from(Array.from({length: 256}, (_, code) => [...bytesOf(labelOf(code)[1]), 255]).flat()), 256);
  }

  beforeFrame() {
    const {points, uniforms, stage} = this;
    uniforms.scale.value = stage.scale;
    const alone = this.pair.loop && !this.withRest, hidden = this.layers.points === false || alone;
    this.stems.mesh.visible = this.layers.stems !== false && !alone;
    this.changes?.update(this.island, this.layers, alone);
    this.images.beforeFrame(stage.camera, alone);
    this.overlay.dim(alone);
    points.group.visible = !hidden;
    if (hidden) points.shown = 0;
    const complete = hidden || points.update(stage.camera, stage.scale, this.poses.farthest);
    if (!this.heights && points.heights()) {
      this.heights = points.heights();
      this.labels = points.labels();
      uniforms.heights.value.set(...this.heights);
      buildColours(this);
      stage.invalidate();
    }
    drawStatus(this, complete);
    this.moveLabels();
  }

  layersChanged() {
    this.data.missions.forEach((m, i) => this.missionBytes.set([...bytesOf(colourOf(i)), m.island === this.island && this.layers[`mission ${i}`] !== false ? 255 : 0], 4 * (i % 256)));
    this.uniforms.missions.value.needsUpdate = true;
    this.overlay.update(this.time, this.island, this.layers);
    this.images.update(this.time, this.island, this.layers.images !== false, n => this.layers[`mission ${this.data.missionOf[n]}`] !== false);
    this.stage.invalidate();
  }

  setIsland(island) {
    this.pick(null);
    Object.assign(this, {island, heights: null, labels: new Set()});
    this.points.show(island);
    this.stems.show(island);
    buildSide(this);
    this.layersChanged();
    this.seeAll();
  }

  setColour(colour) {
    if ($("colours").children[colour].disabled) return;
    this.colour = this.uniforms.colourBy.value = colour;
    buildColours(this);
    this.stage.invalidate();
  }

  setTime(time) {
    this.time = time;
    this.poses.set(time);
    this.uniforms.moved.value = this.poses.moved;
    const k = Math.floor(time), {stages} = this.data, names = {odometry: "odometry only", map: "the map"};
    const name = i => names[stages[i].name] || stages[i].name;
    $("stage").value = time;
    $("stage-name").textContent = time === k ? name(k) : `${name(k)} → ${name(k + 1)}`;
    this.layersChanged();
  }

  /// Runs the slider from the first stage to the last; again: stops.
  play() {
    if (this.playing || this.data.last === 0) { this.playing = false; return; }
    this.playing = true;
    $("play").textContent = "❚❚";
    let before = null, time = this.time >= this.data.last ? 0 : this.time;
    const step = now => {
      time += before === null ? 0 : (now - before) / 2500;
      before = now;
      this.setTime(Math.min(time, this.data.last));
      if (this.playing && time < this.data.last) requestAnimationFrame(step);
      else { this.playing = false; $("play").textContent = "▶"; }
    };
    requestAnimationFrame(step);
  }

  seeAll(direction = null) {
    const box = new THREE.Box3();
    this.data.missionOf.forEach((m, node) => { if (this.data.missions[m].island === this.island) box.expandByPoint(new THREE.Vector3(...this.data.fused(node).slice(0, 3))); });
    if (box.isEmpty()) box.expandByPoint(new THREE.Vector3());
    const ball = box.getBoundingSphere(new THREE.Sphere());
    this.stage.flyTo(ball.center.toArray(), .82 * Math.max(ball.radius, 6), direction || [-.35, -.8, .62]);
  }

  pick(found) {
    this.picked = found;
    this.overlay.pick(found?.kind === "loop" ? found.item : null);
    if (found?.kind !== "loop") this.pair.close();
    if (!found) hideDetail();
    else if (found.kind === "loop") this.openLoop(found.item);
    else ({node: showNode, stem: showStem, change: showChange})[found.kind](this, found.item);
    this.stage.invalidate();
  }

  openLoop(loop) {
    const island = this.data.islandOf(loop.tail);
    if (island !== this.island) { this.setIsland(island); this.picked = {kind: "loop", item: loop}; this.overlay.pick(loop); }
    this.placement = "odometry";
    showLoop(this, loop);
    if (!this.pair.has(loop)) { this.pair.close(); return; }
    this.pair.open(loop, this.placement).catch(error => { this.points.failed = error.message; this.stage.invalidate(); });
    const [a, b] = [loop.tail, loop.head].map(n => this.data.fused(n));
    this.stage.flyTo([0, 1, 2].map(k => (a[k] + b[k]) / 2), Math.max(14, .7 * Math.hypot(a[0] - b[0], a[1] - b[1])));
  }

  place(placement) {
    this.placement = placement;
    if (this.pair.loop) this.pair.moveTo(placement);
    for (const b of document.querySelectorAll("[data-placement]")) b.setAttribute("aria-pressed", b.dataset.placement === placement);
  }

  beforeAfter() {
    if (!this.pair.loop) return;
    this.place(this.placement !== "odometry" ? "odometry" : this.pair.loop.T_tail_head ? "registration" : "map");
  }

  showRest(on) { this.withRest = on; showLoop(this, this.picked.item); this.stage.invalidate(); }

  nextLoop(step) {
    const loops = this.overlay.visibleLoops, at = this.picked?.kind === "loop" ? loops.indexOf(this.picked.item) : step > 0 ? -1 : 0;
    if (loops.length) this.pick({kind: "loop", item: loops[(at + step + loops.length) % loops.length]});
  }

  /// The names of missions stand where they begin.
  moveLabels() {
    const taken = [];  // where names stand already
    this.data.missions.forEach((m, i) => {
      const label = $("labels").children[i], on = m.island === this.island && this.layers[`mission ${i}`] !== false && this.layers.paths !== false && m.ids.length;
      const p = on && !this.pair.loop ? this.stage.project(this.overlay.at(m.first)) : null;
      label.hidden = !p;
      if (!p) return;
      let [x, y] = [p[0] + 9, p[1] - 10];
      while (taken.some(([u, v]) => Math.abs(u - x) < 110 && Math.abs(v - y) < 21)) y += 21;
      taken.push([x, y]);
      label.style.transform = `translate(${x}px, ${y}px)`;
    });
  }
}
