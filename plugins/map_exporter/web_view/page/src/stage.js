// SPDX-License-Identifier: BSD-3-Clause
// Renderer, camera and the frame: points and stems are shaded by their depth, what explains them (paths,
// loops, fixes) lies on top and is never hidden.
import * as THREE from "three";
import {OrbitControls} from "three/examples/jsm/controls/OrbitControls.js";
import {screenFragment, screenVertex} from "./shaders.js";

const calm = matchMedia("(prefers-reduced-motion: reduce)");

export class Stage {
  constructor(canvas, context) {
    THREE.ColorManagement.enabled = false;  // shaders write what the screen shows
    this.renderer = new THREE.WebGLRenderer({canvas, context});
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.autoClear = false;
    this.solid = new THREE.Scene();
    this.overlay = new THREE.Scene();
    this.solid.add(new THREE.HemisphereLight("#ffffff", "#5c7a66", 3));
    this.camera = new THREE.PerspectiveCamera(50, 1, .1, 1e4);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, {enableDamping: !calm.matches, dampingFactor: .12, zoomToCursor: true, maxPolarAngle: .98 * Math.PI, minDistance: .5});
    this.controls.addEventListener("change", () => this.invalidate());
    this.target = new THREE.WebGLRenderTarget(4, 4, {depthTexture: new THREE.DepthTexture(4, 4, THREE.UnsignedIntType),
      minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter});
    this.setUpScreen();
    this.before = [];  // called with this before each frame
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  setUpScreen() {
    this.uniforms = {colours: {value: this.target.texture}, depths: {value: this.target.depthTexture}, pixel: {value: new THREE.Vector2()},
      near: {value: 0}, far: {value: 0}, strength: {value: 5}};
    const triangle = new THREE.BufferGeometry();
    triangle.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    const mesh = new THREE.Mesh(triangle, new THREE.RawShaderMaterial({vertexShader: screenVertex, fragmentShader: screenFragment,
      glslVersion: THREE.GLSL3, uniforms: this.uniforms, depthTest: false, depthWrite: false}));
    mesh.frustumCulled = false;
    this.screen = new THREE.Scene().add(mesh);
  }

  resize() {
    const canvas = this.renderer.domElement, w = canvas.clientWidth || 1, h = canvas.clientHeight || 1;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(w, h, false);
    const size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    this.target.setSize(size.x, size.y);
    this.uniforms.pixel.value.set(1 / size.x, 1 / size.y);
    Object.assign(this, {width: w, height: h});
    this.camera.aspect = w / h;
    // The middle of what the panel leaves free.
    this.camera.setViewOffset(w, h, w > 760 ? -Math.min(140, .1 * w) : 0, 0, w, h);
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  /// Pixels of the drawing buffer that a metre has at one metre from the camera.
  get scale() { return this.target.height / (2 * Math.tan(this.camera.fov * Math.PI / 360)); }

  invalidate() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(time => { this.asked = false; this.frame(time); });
  }

  frame(time) {
    const {renderer, camera, flight} = this;
    if (flight && flight(time)) this.invalidate();
    this.controls.update();
    camera.near = Math.max(.05, .002 * camera.position.distanceTo(this.controls.target));
    camera.far = 2e5 * camera.near;
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    for (const f of this.before) f(this);
    Object.assign(this.uniforms.near, {value: camera.near});
    Object.assign(this.uniforms.far, {value: camera.far});
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.solid, camera);
    renderer.setRenderTarget(null);
    renderer.clear();
    renderer.render(this.screen, camera);
    renderer.render(this.overlay, camera);
  }

  /// Looks at `centre` so that a sphere of `radius` fits; the direction stays when none is given.
  flyTo(centre, radius, direction = null) {
    const to = new THREE.Vector3(...centre), from = this.controls.target.clone(), start = this.camera.position.clone();
    const away = radius / Math.sin(this.camera.fov * Math.PI / 360) * Math.max(1, 1 / this.camera.aspect);
    const along = direction ? new THREE.Vector3(...direction) : start.clone().sub(from);
    const end = to.clone().add(along.normalize().multiplyScalar(away));
    if (calm.matches || !this.placed) { this.place(to, end); return; }
    let begin = null;
    this.flight = time => {
      begin ??= time;
      const s = Math.min(1, (time - begin) / 700), e = s * s * (3 - 2 * s);
      this.place(from.clone().lerp(to, e), start.clone().lerp(end, e));
      if (s === 1) this.flight = null;
      return s < 1;
    };
    this.invalidate();
  }

  place(target, position) {
    this.placed = true;
    this.controls.target.copy(target);
    this.camera.position.copy(position);
    this.invalidate();
  }

  /// Where a point of the map is on the page: [x, y] in CSS pixels, or null behind the camera.
  project(p) {
    const v = new THREE.Vector3(...p).project(this.camera);
    return v.z > 1 || v.z < -1 ? null : [(v.x + 1) * this.width / 2, (1 - v.y) * this.height / 2];
  }
}
