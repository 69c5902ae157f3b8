// SPDX-License-Identifier: BSD-3-Clause
// Where the slider has moved every node, for the points that follow their node.
import * as THREE from "three";
import {distance, inverse, multiply} from "./pose.js";

const width = 1024;  // texels; the shader knows it

export class PosesTexture {
  constructor(data) {
    this.data = data;
    const rows = Math.max(1, Math.ceil(2 * data.nodes / width));
    this.values = new Float32Array(4 * width * rows);
    this.texture = new THREE.DataTexture(this.values, width, rows, THREE.RGBAFormat, THREE.FloatType);
    this.set(data.last);
  }

  /// Fills in T_now_map of each node; points are stored as the map has them.
  set(time) {
    const {data, values} = this;
    this.moved = time < data.last;
    this.farthest = 0;  // how far a point may lie from its tile [m]
    for (let node = 0; node < data.nodes; ++node) {
      const now = data.at(node, time), then = data.fused(node), T = multiply(now, inverse(then));
      values.set([T[3], T[4], T[5], T[6], T[0], T[1], T[2], data.missionOf[node]], 8 * node);
      if (!this.moved) continue;
      const [metres, degrees] = distance(now, then);
      this.farthest = Math.max(this.farthest, metres + 60 * Math.min(degrees * Math.PI / 180, 1));
    }
    this.texture.needsUpdate = true;
  }
}
