// SPDX-License-Identifier: BSD-3-Clause
// Pictures as planes at the poses of their nodes, upright before the robot as it looked along its x axis. Only the
// nearest ones are loaded.
import * as THREE from "three";

const loaded = 24;   // pictures in memory at most
const width = 1.6;   // of a plane [m]
const ahead = 1.2;   // from the node to its plane [m]

export class Images {
  constructor(data, scene, redraw) {
    Object.assign(this, {data, redraw, group: new THREE.Group(), planes: new Map(), loader: new THREE.TextureLoader(), time: data.last, island: 0, on: true});
    scene.add(this.group);
  }

  nodes() { return [...this.data.images.keys()].filter(n => this.data.islandOf(n) === this.island && this.shows(n)); }

  /// `shows(node)`: whether its mission is shown.
  update(time, island, on, shows) {
    Object.assign(this, {time, island, on, shows});
    for (const [node, plane] of this.planes) this.place(node, plane);
  }

  beforeFrame(camera, hidden) {
    this.group.visible = this.on && !hidden;
    if (!this.group.visible) return;
    const distance = n => { const p = this.data.at(n, this.time); return camera.position.distanceToSquared(new THREE.Vector3(p[0], p[1], p[2])); };
    const nearest = new Set(this.nodes().map(n => [distance(n), n]).sort((a, b) => a[0] - b[0]).slice(0, loaded).map(([, n]) => n));
    for (const [node, plane] of this.planes) if (!nearest.has(node)) this.drop(node, plane);
    for (const node of nearest) if (!this.planes.has(node)) this.load(node);
  }

  load(node) {
    const material = new THREE.MeshBasicMaterial({color: "#22332c", side: THREE.DoubleSide});
    const plane = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), material);
    this.planes.set(node, plane);
    this.group.add(plane);
    this.place(node, plane);
    this.loader.load(this.data.images.get(node), texture => {
      if (this.planes.get(node) !== plane) { texture.dispose(); return; }
      material.map = texture;
      material.color.set("#ffffff");
      material.needsUpdate = true;
      plane.userData.aspect = texture.image.height / texture.image.width;
      this.place(node, plane);
      this.redraw();
    });
  }

  drop(node, plane) {
    this.group.remove(plane);
    plane.material.map?.dispose();
    plane.material.dispose();
    plane.geometry.dispose();
    this.planes.delete(node);
  }

  /// The picture's right is the robot's -y, its top the robot's z.
  place(node, plane) {
    const [x, y, z, ...q] = this.data.at(node, this.time), pose = new THREE.Matrix4().compose(new THREE.Vector3(x, y, z), new THREE.Quaternion(...q), new THREE.Vector3(1, 1, 1));
    const axes = new THREE.Matrix4().makeBasis(new THREE.Vector3(0, -1, 0), new THREE.Vector3(0, 0, 1), new THREE.Vector3(-1, 0, 0)).setPosition(ahead, 0, 0);
    plane.matrixAutoUpdate = false;
    plane.matrix.copy(pose).multiply(axes).scale(new THREE.Vector3(width, width * (plane.userData.aspect || .75), 1));
    plane.matrixWorldNeedsUpdate = true;
  }

  /// The corners of a plane in the map, or null where it is not shown.
  corners(node) {
    const plane = this.group.visible && this.planes.get(node);
    return plane ? [[-.5, -.5], [.5, -.5], [.5, .5], [-.5, .5]].map(([u, v]) => new THREE.Vector3(u, v, 0).applyMatrix4(plane.matrix).toArray()) : null;
  }
}
