// SPDX-License-Identifier: BSD-3-Clause
// The keyboard: everything that the mouse can do.
import * as THREE from "three";
import {$, element} from "./dom.js";

function turn(stage, yaw, tilt) {
  const {target} = stage.controls, s = new THREE.Spherical(), up = new THREE.Quaternion().setFromUnitVectors(stage.camera.up, new THREE.Vector3(0, 1, 0));
  s.setFromVector3(stage.camera.position.clone().sub(target).applyQuaternion(up));
  s.theta += yaw; s.phi = Math.max(.02, Math.min(.98 * Math.PI, s.phi + tilt));
  stage.place(target.clone(), new THREE.Vector3().setFromSpherical(s).applyQuaternion(up.invert()).add(target));
}

function move(stage, right, ahead) {
  const {target} = stage.controls, view = target.clone().sub(stage.camera.position), step = .12 * view.length();
  const forward = new THREE.Vector3(view.x, view.y, 0);
  if (forward.lengthSq() < 1e-12) forward.setFromMatrixColumn(stage.camera.matrix, 1).setZ(0);
  forward.normalize();
  const by = new THREE.Vector3(forward.y, -forward.x, 0).multiplyScalar(step * right).addScaledVector(forward, step * ahead);
  stage.place(target.clone().add(by), stage.camera.position.clone().add(by));
}

function nearer(stage, factor) {
  const {target} = stage.controls;
  stage.place(target.clone(), stage.camera.position.clone().sub(target).multiplyScalar(factor).add(target));
}

const keys = app => [
  ["← ↑ → ↓", "move", {ArrowLeft: () => move(app.stage, -1, 0), ArrowRight: () => move(app.stage, 1, 0), ArrowUp: () => move(app.stage, 0, 1), ArrowDown: () => move(app.stage, 0, -1)}],
  ["+ −", "nearer, farther", {"+": () => nearer(app.stage, .8), "=": () => nearer(app.stage, .8), "-": () => nearer(app.stage, 1.25)}],
  ["q e", "turn", {q: () => turn(app.stage, -.15, 0), e: () => turn(app.stage, .15, 0)}],
  ["r f", "tilt", {r: () => turn(app.stage, 0, .1), f: () => turn(app.stage, 0, -.1)}],
  ["0", "see all", {0: () => app.seeAll(), Home: () => app.seeAll()}],
  ["t", "from above", {t: () => app.seeAll([0, -.001, 1])}],
  ["1 2 3 4", "colour", {1: () => app.setColour(0), 2: () => app.setColour(1), 3: () => app.setColour(2), 4: () => app.setColour(3)}],
  ["space", "play the optimisation", {" ": () => app.play()}],
  ["n p", "next, previous loop", {n: () => app.nextLoop(1), p: () => app.nextLoop(-1)}],
  ["b", "the loop before and after", {b: () => app.beforeAfter()}],
  ["Esc", "close", {Escape: () => { $("help").hidden = true; app.pick(null); }}],
  ["h", "these keys", {h: () => { $("help").hidden = !$("help").hidden; }, "?": () => { $("help").hidden = !$("help").hidden; }}],
];

export function setUpKeys(app) {
  const table = keys(app), actions = Object.assign({}, ...table.map(row => row[2]));
  $("help").replaceChildren(element("b", {}, "Keys"), element("dl", {}, ...table.flatMap(([names, does]) => [
    element("dt", {}, ...names.split(" ").flatMap(k => [element("kbd", {}, k), " "])), element("dd", {}, does)])),
    element("p", {}, "Drag to turn, right button or two fingers to move, wheel or pinch to zoom."));
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    // A slider, a list or a button in focus keeps the keys that work it.
    const own = {INPUT: /^(Arrow|Home|End|Page)/, SELECT: /^(Arrow|Home|End|Page| |[a-z0-9])/i, BUTTON: /^( |Enter)$/}[event.target.tagName];
    if (own && own.test(event.key) || !actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
}
