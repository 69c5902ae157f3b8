// SPDX-License-Identifier: BSD-3-Clause
// The points on the screen: tiles are loaded as they are wanted and forgotten when others need the room.
import * as THREE from "three";
import {pointFragment, pointVertex} from "./shaders.js";
import {choose, treeOf} from "./tile_tree.js";

const atOnce = 6;  // requests

export class Points {
  constructor(data, uniforms, changed) {
    Object.assign(this, {data, changed, group: new THREE.Group(), budget: 2e6, clock: 0, loading: 0, bytes: 0, resident: 0, shown: 0, failed: null});
    this.material = new THREE.RawShaderMaterial({vertexShader: pointVertex, fragmentShader: pointFragment, glslVersion: THREE.GLSL3, uniforms});
    this.show(0);
  }

  show(island) {
    for (const object of [...this.group.children]) this.forget(object.tile);
    this.island = this.data.islands[island];
    this.root = treeOf(this.island.points);
    this.wanted = [];
    this.loaded = new Set();
  }

  /// Chooses and asks for tiles. True when all that should be seen is there.
  update(camera, scale, slack) {
    const {chosen} = choose(this.root, camera, scale, {budget: this.budget, gapPixels: 1.6, slack});
    ++this.clock;
    this.shown = 0;
    const wanted = [];
    for (const tile of chosen) {
      tile.used = this.clock;
      if (tile.state === "absent" && tile.points) wanted.push(tile);
    }
    for (const tile of this.loaded) {
      tile.object.visible = tile.used === this.clock;
      if (tile.object.visible) this.shown += tile.points;
    }
    this.wanted = wanted;
    this.loadNext();
    this.makeRoom();
    return !this.loading && !this.wanted.length;
  }

  /// The most important tiles first; goes on by itself, as a frame may take long.
  loadNext() {
    while (this.loading < atOnce && this.wanted.length) {
      const tile = this.wanted.shift();
      if (tile.state === "absent") this.load(tile);
    }
  }

  async load(tile) {
    const root = this.root;
    tile.state = "loading";
    ++this.loading;
    try {
      const answer = await fetch(`${this.island.points.folder}${tile.name}.bin`);
      if (!answer.ok) throw new Error(`the server answered ${answer.status}`);
      const bytes = await answer.arrayBuffer();
      if (bytes.byteLength !== 12 * tile.points) throw new Error(`it has ${bytes.byteLength} bytes, expected ${12 * tile.points}`);
      if (root === this.root) this.accept(tile, bytes);
    } catch (error) {
      tile.state = "failed";
      this.failed = `Tile ${tile.name} could not be loaded: ${error.message}`;
    }
    --this.loading;
    this.loadNext();
    this.changed();
  }

  accept(tile, bytes) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Uint16Array(bytes, 0, 4 * tile.points), 4));
    geometry.setAttribute("node", new THREE.BufferAttribute(new Uint32Array(bytes, 8 * tile.points, tile.points), 1));
    const object = new THREE.Points(geometry, this.material), {unit} = this.island.points;
    const step = Math.max(unit, tile.width / 65536);
    object.position.fromArray(tile.low).addScalar((step - unit) / 2);
    object.scale.setScalar(step);
    object.frustumCulled = false;  // choose() has done it
    object.tile = tile;
    object.onBeforeRender = () => { this.material.uniforms.grain.value = tile.grain; this.material.uniformsNeedUpdate = true; };
    tile.object = object;
    tile.state = "loaded";
    this.group.add(object);
    this.loaded.add(tile);
    this.bytes += bytes.byteLength;
    this.resident += tile.points;
  }

  forget(tile) {
    this.group.remove(tile.object);
    tile.object.geometry.dispose();
    tile.object = null;
    tile.state = "absent";
    this.loaded.delete(tile);
    this.resident -= tile.points;
  }

  /// Those unused for longest go until at most twice the budget is left.
  makeRoom() {
    if (this.resident <= 2 * this.budget) return;
    for (const tile of [...this.loaded].sort((a, b) => a.used - b.used)) {
      if (this.resident <= 2 * this.budget || tile.used === this.clock) return;
      this.forget(tile);
    }
  }

  /// Heights of nearly all points of the coarsest tile [m], for the colours.
  heights() {
    const tile = this.root;
    if (!tile || tile.state !== "loaded") return null;
    const at = tile.object.geometry.getAttribute("position"), z = [];
    for (let i = 0; i < at.count; ++i) z.push(tile.low[2] + at.getZ(i) * tile.object.scale.z);
    z.sort((a, b) => a - b);
    const low = z[Math.floor(.01 * z.length)], high = z[Math.floor(.99 * z.length)];
    return [low, Math.max(high, low + .1)];
  }

  /// Labels that points of the coarsest tile carry.
  labels() {
    const tile = this.root, found = new Set();
    if (!tile || tile.state !== "loaded") return found;
    const at = tile.object.geometry.getAttribute("position");
    for (let i = 0; i < at.count; ++i) found.add(at.getW(i) >> 8);
    return found;
  }
}
