// SPDX-License-Identifier: BSD-3-Clause
// Stems as cylinders of their diameter. How tall a tree is the tables do not say: all are drawn alike.
import * as THREE from "three";

export const height = 4;  // [m]
const unmeasured = .08;   // diameter of a stem that nobody measured [m]

export class Stems {
  constructor(data, scene) {
    this.data = data;
    const shape = new THREE.CylinderGeometry(.5, .5, 1, 20, 1).translate(0, .5, 0).rotateX(Math.PI / 2);  // along z, from its foot
    this.mesh = new THREE.InstancedMesh(shape, new THREE.MeshLambertMaterial(), Math.max(1, data.stems.length));
    this.mesh.frustumCulled = false;
    scene.add(this.mesh);
    this.show(0);
  }

  show(island) {
    this.shown = this.data.stems.filter(s => s.island === island);
    const matrix = new THREE.Matrix4(), up = new THREE.Vector3(0, 0, 1), turn = new THREE.Quaternion(), colour = new THREE.Color();
    this.shown.forEach((stem, i) => {
      const width = stem.dbh || unmeasured;
      turn.setFromUnitVectors(up, new THREE.Vector3(...stem.axis));
      this.mesh.setMatrixAt(i, matrix.compose(new THREE.Vector3(...stem.base), turn, new THREE.Vector3(width, width, height)));
      this.mesh.setColorAt(i, colour.set(stem.dbh ? "#c98a4b" : "#8b9a91"));
    });
    this.mesh.count = this.shown.length;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }

  ends(stem) { return [stem.base, stem.base.map((v, a) => v + height * stem.axis[a])]; }
}
