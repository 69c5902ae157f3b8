// SPDX-License-Identifier: BSD-3-Clause
// The two clouds of a loop, one held, the other placed by odometry, by the registration, or by the map.
import * as THREE from "three";
import {between, multiply} from "./pose.js";
import {pairFragment, pairVertex} from "./shaders.js";

const colours = {tail: "#56b4e9", head: "#e69f00"};

export class Pair {
  constructor(data, scene, changed) {
    Object.assign(this, {data, changed, loop: null, group: new THREE.Group(), size: 3.5});
    scene.add(this.group);
  }

  has(loop) {
    const known = this.data.islands[this.data.islandOf(loop.tail)].pairNodes;
    return known.has(loop.tail) && known.has(loop.head) && this.data.islandOf(loop.head) === this.data.islandOf(loop.tail);
  }

  async open(loop, placement) {
    this.close();
    this.loop = loop;
    this.T_tail_head = this.data.placements(loop)[placement];
    const clouds = await Promise.all([loop.tail, loop.head].map(async node => {
      const answer = await fetch(`pairs/${node}.bin`);
      if (!answer.ok) throw new Error(`the cloud of ${this.data.nameOf(node)} could not be loaded: the server answered ${answer.status}`);
      return new Int16Array(await answer.arrayBuffer());
    }));
    if (this.loop !== loop) return;  // another one was picked meanwhile
    this.objects = ["tail", "head"].map((end, k) => this.points(clouds[k], colours[end]));
    this.place();
  }

  points(xyz, colour) {
    const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(xyz, 3));
    const object = new THREE.Points(geometry, new THREE.RawShaderMaterial({vertexShader: pairVertex, fragmentShader: pairFragment,
      glslVersion: THREE.GLSL3, uniforms: {colour: {value: new THREE.Color(colour)}, size: {value: this.size}}}));
    object.frustumCulled = false;
    this.group.add(object);
    return object;
  }

  place() {
    if (!this.objects) return;
    const tail = this.data.fused(this.loop.tail);
    [tail, multiply(tail, this.T_tail_head)].forEach((T, k) => {
      this.objects[k].position.set(...T.slice(0, 3));
      this.objects[k].quaternion.set(...T.slice(3));
    });
    this.changed();
  }

  /// Moves the head's cloud there within half a second.
  moveTo(placement) {
    const from = this.T_tail_head, to = this.data.placements(this.loop)[placement], loop = this.loop;
    let begin = null;
    const step = time => {
      if (this.loop !== loop) return;
      begin ??= time;
      const s = Math.min(1, (time - begin) / 500);
      this.T_tail_head = between(from, to, s * s * (3 - 2 * s));
      this.place();
      if (s < 1 && this.goal === placement) requestAnimationFrame(step);
    };
    this.goal = placement;
    requestAnimationFrame(step);
  }

  close() {
    for (const object of this.objects || []) { this.group.remove(object); object.geometry.dispose(); object.material.dispose(); }
    Object.assign(this, {objects: null, loop: null, goal: null});
    this.changed();
  }
}
