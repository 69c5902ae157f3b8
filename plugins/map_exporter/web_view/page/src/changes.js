// SPDX-License-Identifier: BSD-3-Clause
// What `cambium changes` found between two surveys, on top of the first one's map: trees, and the heights of
// ground and canopy as coloured squares.
import * as THREE from "three";
import {height} from "./stems.js";

export const kinds = {gone: ["gone", "#ff5a4a"], new: ["new", "#3fc8ff"], kept: ["kept", "#e8c25a"], overlooked: ["overlooked before", "#a78bd0"],
  unsure: ["unsure", "#8b9a91"]};
export const surfaces = {ground: ["ground, difference", 3], canopy: ["canopy, difference", 4]};  // column of a cell
// Drawn thicker than the stem of the map, which would hide it; what came or went is to be seen from afar [m].
const halo = kind => kind === "gone" || kind === "new" ? .35 : .06;
const farthest = .01;  // the node that names the map may be so far from where the page has it [m]

/// The layer of this map; of another map it says so and has nothing to show.
export class Changes {
  constructor(data, scene, layer) {
    Object.assign(this, {data, scene, layer, island: -1, trees: {}, squares: {}, shown: []});
    const mission = data.missions.find(m => m.name === layer.anchor.mission);
    const at = mission && data.fused(mission.first).slice(0, 3), off = at ? Math.hypot(...at.map((v, k) => v - layer.anchor.position[k])) : Infinity;
    if (off > farthest) { this.foreign = `'${layer.before}' is not this map: its changes are not shown.`; return; }
    this.island = mission.island;
    for (const kind of Object.keys(kinds)) this.addTrees(kind);
    for (const [name, [, column]] of Object.entries(surfaces)) this.addSquares(name, column);
  }

  count(name) { return (this.trees[name]?.items || this.squares[name]?.items || []).length; }

  add(object, items) {
    object.frustumCulled = false;
    this.scene.add(object);
    return {object, items};
  }

  addTrees(kind) {
    const items = this.layer.stems.filter(s => s.change === kind), matrix = new THREE.Matrix4();
    const shape = new THREE.CylinderGeometry(.5, .5, 1, 16, 1).translate(0, .5, 0).rotateX(Math.PI / 2);
    const mesh = new THREE.InstancedMesh(shape, new THREE.MeshLambertMaterial({color: kinds[kind][1]}), Math.max(1, items.length));
    items.forEach((stem, i) => {
      const width = (stem.dbh_before || stem.dbh_after || .1) + halo(kind);
      mesh.setMatrixAt(i, matrix.makeScale(width, width, 1.05 * height).setPosition(stem.x, stem.y, stem.z));
    });
    mesh.count = items.length;
    this.trees[kind] = this.add(mesh, items);
  }

  /// Blue where the second survey is lower, red where it is higher; the strongest colour is the 98th percentile.
  addSquares(name, column) {
    const items = this.layer.cells.filter(c => c[2] !== null && c[column] !== null), matrix = new THREE.Matrix4(), colour = new THREE.Color();
    const sizes = items.map(c => Math.abs(c[column])).sort((a, b) => a - b), most = sizes[Math.floor(.98 * (sizes.length - 1))] || 1;
    const mesh = new THREE.InstancedMesh(new THREE.PlaneGeometry(1, 1), new THREE.MeshBasicMaterial({side: THREE.DoubleSide}), Math.max(1, items.length));
    items.forEach((c, i) => {
      const s = Math.max(-1, Math.min(1, c[column] / most)), pale = [.93, .93, .9], full = s < 0 ? [.13, .4, .85] : [.85, .2, .13];
      mesh.setMatrixAt(i, matrix.makeScale(.94 * this.layer.cell_width, .94 * this.layer.cell_width, 1).setPosition(c[0], c[1], c[2] + .05));
      mesh.setColorAt(i, colour.setRGB(...pale.map((v, k) => v + Math.abs(s) * (full[k] - v))));
    });
    mesh.count = items.length;
    this.squares[name] = {...this.add(mesh, items), most};
  }

  /// Squares only when they are asked for: they lie on the ground's points.
  update(island, layers, hidden) {
    const here = island === this.island && !hidden;
    this.shown = [];
    for (const [kind, {object, items}] of Object.entries(this.trees)) {
      object.visible = here && layers[`change ${kind}`] !== false;
      if (object.visible) this.shown.push(...items);
    }
    for (const [name, {object}] of Object.entries(this.squares)) object.visible = here && layers[`change ${name}`] === true;
  }

  ends(stem) { return [[stem.x, stem.y, stem.z], [stem.x, stem.y, stem.z + height]]; }
}
