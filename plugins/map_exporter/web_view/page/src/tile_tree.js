// SPDX-License-Identifier: BSD-3-Clause
// Which tiles of the octree to draw from here: the coarsest first, until no gap between points is wider
// than a few pixels or the budget is spent.
import * as THREE from "three";

const samples = 64;  // points a side of a tile that has octants; the exporter knows it

export class Tile {
  constructor(name, low, width, points) {
    Object.assign(this, {name, low, width, points, octants: [], state: "absent", object: null, used: 0});
    this.box = new THREE.Box3(new THREE.Vector3(...low), new THREE.Vector3(...low.map(v => v + width)));
  }
  get gap() { return this.width / samples; }
}

/// The root, or null when the island has no points.
export function treeOf(points) {
  const tiles = new Map();
  for (const name of Object.keys(points.tiles).sort((a, b) => a.length - b.length || (a < b ? -1 : 1))) {
    const parent = tiles.get(name.slice(0, -1)), digit = +name.slice(-1);
    const width = parent ? parent.width / 2 : points.width;
    const low = parent ? parent.low.map((v, a) => v + width * (digit >> (2 - a) & 1)) : points.low;
    const tile = new Tile(name, low, width, points.tiles[name]);
    if (parent) parent.octants.push(tile);
    tiles.set(name, tile);
  }
  const root = tiles.get("r") || null;
  if (root) setGrain(root);
  return root;
}

/// About the distance between neighbours where all tiles are drawn: points grow to it when one is near.
function setGrain(tile) {
  tile.octants.forEach(setGrain);
  tile.grain = tile.octants.length ? Math.min(...tile.octants.map(t => t.grain)) : Math.min(.6 * tile.width / Math.sqrt(tile.points || 1), .09);
}

/// Tiles by how wide their gaps look, the widest on top.
class Heap {
  constructor() { this.items = []; }
  push(key, value) {
    const a = this.items;
    let i = a.push([key, value]) - 1;
    for (let p; i > 0 && a[p = (i - 1) >> 1][0] < a[i][0]; i = p) [a[p], a[i]] = [a[i], a[p]];
  }
  pop() {
    const a = this.items, top = a[0], last = a.pop();
    if (a.length) {
      a[0] = last;
      for (let i = 0, c; (c = 2 * i + 1) < a.length; i = c) {
        if (c + 1 < a.length && a[c + 1][0] > a[c][0]) ++c;
        if (a[c][0] <= a[i][0]) break;
        [a[c], a[i]] = [a[i], a[c]];
      }
    }
    return top[1];
  }
}

/// The tiles to draw in order of their importance, and how many points they have. `scale`: pixels a
/// metre at one metre; `slack`: how far points may lie outside of their tile [m].
export function choose(root, camera, scale, {budget, gapPixels, slack}) {
  const frustum = new THREE.Frustum().setFromProjectionMatrix(
    new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
  const heap = new Heap(), chosen = [], box = new THREE.Box3();
  let points = 0;
  const offer = tile => {
    box.copy(tile.box).expandByScalar(slack);
    if (!frustum.intersectsBox(box)) return;
    const away = Math.max(box.distanceToPoint(camera.position), 0.5);
    heap.push(tile.gap * scale / away, tile);
    tile.looks = tile.gap * scale / away;
  };
  if (root) offer(root);
  while (heap.items.length) {
    const tile = heap.pop();
    if (points + tile.points > budget) break;
    points += tile.points;
    chosen.push(tile);
    if (tile.looks > gapPixels) tile.octants.forEach(offer);
  }
  return {chosen, points};
}
