// SPDX-License-Identifier: BSD-3-Clause
// Paths, nodes, loops and fixes, which follow the slider.
import * as THREE from "three";
import {Line2} from "three/examples/jsm/lines/Line2.js";
import {LineGeometry} from "three/examples/jsm/lines/LineGeometry.js";
import {LineMaterial} from "three/examples/jsm/lines/LineMaterial.js";
import {LineSegments2} from "three/examples/jsm/lines/LineSegments2.js";
import {LineSegmentsGeometry} from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import {colourOf} from "./data.js";

const lineMaterial = (color, linewidth, opacity = 1, more = {}) =>
  new LineMaterial({color, linewidth, transparent: true, opacity, depthTest: false, ...more});
const discTexture = () => {
  const c = document.createElement("canvas"), pen = c.getContext("2d");
  c.width = c.height = 32;
  pen.fillStyle = "#fff"; pen.beginPath(); pen.arc(16, 16, 14, 0, 7); pen.fill();
  return new THREE.CanvasTexture(c);
};

export class Overlay {
  constructor(data, scene) {
    Object.assign(this, {data, scene, disc: discTexture(), paths: [], time: data.last, island: 0, picked: null});
    this.loops = {rejected: new LineSegments2(new LineSegmentsGeometry(), lineMaterial("#f07a22", 1.4, .6)),
      accepted: new LineSegments2(new LineSegmentsGeometry(), lineMaterial("#1fc995", 1.8, .85))};
    for (const [order, line] of Object.values(this.loops).entries()) { line.renderOrder = 1 + order; this.add(line); }
    data.missions.forEach((m, i) => this.addMission(m, i));
    this.highlight = new LineSegments2(new LineSegmentsGeometry(), lineMaterial("#ffffff", 5));
    this.highlight.renderOrder = 5;
    this.highlight.visible = false;
    this.add(this.highlight);
  }

  add(object) { object.frustumCulled = false; this.scene.add(object); return object; }

  dots(positions, color, size, opacity) {
    const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(Float32Array.from(positions), 3));
    return this.add(new THREE.Points(geometry, new THREE.PointsMaterial({color, size, opacity, map: this.disc, alphaTest: .4, transparent: true,
      sizeAttenuation: false, depthTest: false})));
  }

  addMission(m, i) {
    const p = {color: colourOf(i), fixes: this.dots(m.fixes, colourOf(i), 5, .55)};
    const odometry = Array.from({length: m.ids.length}, (_, n) => this.data.byOdometry(m.first + n).slice(0, 3)).flat();
    p.odometry = this.line(odometry, lineMaterial(p.color, 1.4, .75, {dashed: true, dashSize: .6, gapSize: .5}));
    p.path = this.line(odometry, lineMaterial(p.color, 3));
    p.nodes = this.dots(odometry, p.color, 7, 1);
    const pictures = m.ids.map((_, n) => m.first + n).filter(n => this.data.images.has(n));
    p.pictured = pictures;
    p.pictures = this.dots(pictures.flatMap(() => [0, 0, 0]), "#ffffff", 12, .9);
    p.fixes.renderOrder = 0; p.odometry.renderOrder = 1; p.path.renderOrder = 3; p.pictures.renderOrder = 3; p.nodes.renderOrder = 4;
    this.paths.push(p);
  }

  line(positions, material) {
    const line = this.add(new Line2(new LineGeometry(), material));
    if (positions.length > 3) { line.geometry.setPositions(positions); line.computeLineDistances(); }
    else line.geometry.instanceCount = 0;
    return line;
  }

  at(node) { return this.data.at(node, this.time).slice(0, 3); }

  /// Loops that can be seen, by the layers.
  shownLoops(layers) {
    const on = node => this.data.islandOf(node) === this.island && layers[`mission ${this.data.missionOf[node]}`] !== false;
    return this.data.loops.filter(l => layers[l.state] !== false && this.loops[l.state] && on(l.tail) && on(l.head));
  }

  update(time, island, layers) {
    Object.assign(this, {time, island});
    this.visibleLoops = this.shownLoops(layers);
    this.data.missions.forEach((m, i) => this.updateMission(m, this.paths[i], m.island === island && layers[`mission ${i}`] !== false, layers));
    for (const state of ["accepted", "rejected"])
      this.setSegments(this.loops[state], this.visibleLoops.filter(l => l.state === state));
    this.pick(this.picked);
  }

  updateMission(m, p, on, layers) {
    p.fixes.visible = on && layers.fixes !== false;
    p.odometry.visible = on && layers.odometry === true && m.ids.length > 1;
    p.path.visible = on && layers.paths !== false && m.ids.length > 1;
    p.nodes.visible = on && layers.paths !== false;
    p.pictures.visible = on && layers.images !== false && p.pictured.length > 0;
    const positions = m.ids.flatMap((_, n) => this.at(m.first + n));
    if (p.path.visible) p.path.geometry.setPositions(positions);
    this.setDots(p.nodes, positions);
    this.setDots(p.pictures, p.pictured.flatMap(n => this.at(n)));
  }

  setDots(dots, positions) {
    dots.geometry.getAttribute("position").array.set(positions);
    dots.geometry.getAttribute("position").needsUpdate = true;
  }

  setSegments(line, loops) {
    line.visible = line.wanted = loops.length > 0;
    if (loops.length) line.geometry.setPositions(loops.flatMap(l => [...this.at(l.tail), ...this.at(l.head)]));
  }

  /// Fewer lines while two clouds are looked at.
  dim(on) {
    for (const line of Object.values(this.loops)) line.visible = !on && line.geometry.instanceCount > 0 && line.wanted;
    for (const p of this.paths) p.path.material.opacity = on ? .3 : 1;
  }

  /// Highlights a loop; null for none.
  pick(loop) {
    this.picked = loop;
    this.setSegments(this.highlight, loop ? [loop] : []);
  }
}
