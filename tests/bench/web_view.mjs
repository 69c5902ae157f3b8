// SPDX-License-Identifier: BSD-3-Clause
// node web_view.mjs NODE_MODULES WEB_VIEW: what the page of an export draws and loads from several places, by the page's own choice of
// tiles, at 1400 x 900 pixels. NODE_MODULES holds three and esbuild: build/plugins/map_exporter/web_view/page/node_modules.
// Frames are not timed: without a graphics card their times say nothing.
import {readFileSync} from "node:fs";
import {createRequire} from "node:module";
import {dirname, join} from "node:path";
import {fileURLToPath} from "node:url";

const [modules, folder] = process.argv.slice(2), here = dirname(fileURLToPath(import.meta.url));
const bundle = createRequire(join(modules, "x.js"))("esbuild").buildSync({
  stdin: {contents: 'export * from "./tile_tree.js"; export * as THREE from "three";', resolveDir: join(here, "../../plugins/map_exporter/web_view/page/src")},
  nodePaths: [modules], bundle: true, write: false, format: "esm", platform: "node"});
const {THREE, choose, treeOf} = await import(`data:text/javascript;base64,${Buffer.from(bundle.outputFiles[0].contents).toString("base64")}`);

const map = JSON.parse(readFileSync(join(folder, "map.json"))), {points} = map.islands[0], root = treeOf(points);
const poses = map.stages.at(-1).poses, nodes = poses.length / 7, at = n => new THREE.Vector3(...poses.slice(7 * n, 7 * n + 3));
const ball = new THREE.Box3().setFromPoints(Array.from({length: nodes}, (_, n) => at(n))).getBoundingSphere(new THREE.Sphere());
const [width, height, fov] = [1400, 900, 50], scale = height / (2 * Math.tan(fov * Math.PI / 360));
const loaded = new Set();

function measure(name, target, away, direction, budget) {
  const camera = new THREE.PerspectiveCamera(fov, width / height, .1, 1e4);
  camera.up.set(0, 0, 1);
  camera.position.copy(target).addScaledVector(new THREE.Vector3(...direction).normalize(), away);
  camera.lookAt(target);
  camera.updateMatrixWorld();
  const view = {budget, gapPixels: 1.6, slack: 0}, begin = performance.now();
  for (let i = 0; i < 50; ++i) choose(root, camera, scale, view);
  const ms = (performance.now() - begin) / 50, seen = choose(root, camera, scale, view);
  const fresh = seen.chosen.filter(t => !loaded.has(t.name));
  fresh.forEach(t => loaded.add(t.name));
  const bytes = 12 * fresh.reduce((n, t) => n + t.points, 0);
  console.log(`| ${[name, (budget / 1e6).toFixed(1), (seen.points / 1e6).toFixed(2), seen.chosen.length, (bytes / 1e6).toFixed(1), ms.toFixed(2)].join(" | ")} |`);
}

console.log(`${(points.points / 1e6).toFixed(2)} million points in ${Object.keys(points.tiles).length} tiles, ${nodes} nodes\n`);
console.log("| view | budget [million] | drawn [million] | tiles | loaded for it [MB] | choosing them [ms] |\n|---|---|---|---|---|---|");
const far = .82 * ball.radius / Math.sin(fov * Math.PI / 360), middle = at(Math.floor(nodes / 2));
measure("all of it, first picture", ball.center, far, [-.35, -.8, .62], 2e6);
measure("nearer", ball.center, far / 3, [-.35, -.8, .62], 2e6);
measure("at a path, 12 m away", middle, 12, [-.6, -.6, .5], 2e6);
measure("the same", middle, 12, [-.6, -.6, .5], 5e5);
measure("standing in it, 3 m away", middle, 3, [-1, -.3, .15], 2e6);
measure("the same", middle, 3, [-1, -.3, .15], 5e6);
