// SPDX-License-Identifier: BSD-3-Clause
// node browser.mjs NODE_MODULES CHROMIUM ADDRESS POINTS PICTURES: uses the page as a person would, in a real browser.
// POINTS: how many the map has; PICTURES: folder for screenshots. Fails with the first thing that is not as it should be.
import assert from "node:assert/strict";
import {join} from "node:path";
import {complete, covered, drawn, frames, open, pictures, points, settled, software, text} from "./session.mjs";

async function showsTheMap(page) {
  await complete(page);
  assert.equal(await text(page, "title"), "2 missions, one map");
  assert.deepEqual(await page.$$eval("#missions .chip", c => c.map(x => x.textContent)), ["backpack", "drone <i>"]);
  assert.ok(await drawn(page) > .9 * points && await drawn(page) <= points, `${await drawn(page)} of ${points} points are drawn`);
  assert.ok(await covered(page) > .05, "the map is not in the picture");
  await page.screenshot({path: join(pictures, "map.png")});
}

async function coloursAndLayers(page) {
  for (const [key, name] of [["1", "mission"], ["4", "label"], ["2", "height"]]) {
    await page.keyboard.press(key);
    assert.equal(await page.getAttribute(`[data-colour=${name}]`, "aria-pressed"), "true", name);
  }
  await page.keyboard.press("3");  // the clouds have no intensity
  assert.equal(await page.getAttribute("[data-colour=height]", "aria-pressed"), "true");
  assert.deepEqual(await page.evaluate(() => [...window.cambium.labels].sort((a, b) => a - b)), [2, 64, 65, 66]);
  const before = await covered(page);
  await page.click("[data-layer='mission 0']"); await frames(page);
  const less = await covered(page);
  await page.click("[data-layer=points]"); await frames(page);
  const none = await covered(page);
  assert.ok(before > less && less > none, `${before} > ${less} > ${none}`);
  await page.click("[data-layer=points]"); await page.click("[data-layer='mission 0']");
}

/// An accepted loop between the missions whose middle lies free, and where that is on the page.
const aLoop = page => page.evaluate(() => {
  const app = window.cambium;
  app.stage.camera.updateMatrixWorld();
  const at = n => app.stage.project(app.overlay.at(n)), ends = l => [at(l.tail), at(l.head)];
  const distance = ([x, y], [[a, b], [c, d]]) => { const l = (c - a) ** 2 + (d - b) ** 2 || 1, t = Math.max(0, Math.min(1, ((x - a) * (c - a) + (y - b) * (d - b)) / l)); return Math.hypot(x - a - t * (c - a), y - b - t * (d - b)); };
  let best = null;
  for (const loop of app.overlay.visibleLoops) {
    const [a, b] = ends(loop), middle = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
    if (loop.state !== "accepted" || !app.pair.has(loop) || document.elementFromPoint(...middle)?.id !== "view") continue;
    const free = Math.min(...app.overlay.visibleLoops.filter(l => l !== loop).map(l => distance(middle, ends(l))),
      ...app.data.missionOf.map((_, n) => Math.hypot(at(n)[0] - middle[0], at(n)[1] - middle[1]) - 7));
    if (!best || free > best.free) best = {free, index: loop.index, x: middle[0], y: middle[1], tail: app.data.nameOf(loop.tail), head: app.data.nameOf(loop.head)};
  }
  return best;
});

async function aClickOnALoopOpensItsRow(page) {
  await page.keyboard.press("t"); await settled(page);  // from above
  const loop = await aLoop(page);
  await page.mouse.click(loop.x, loop.y);
  assert.equal(await page.evaluate(() => window.cambium.picked?.item.index), loop.index);
  const row = await text(page, "detail");
  for (const part of [loop.tail, loop.head, "accepted", "pairwise_consistency", "off the odometry", "off the map", "overlap", "gicp"])
    assert.ok(row.includes(part), `'${part}' is not in: ${row}`);
  await page.waitForFunction(() => window.cambium.pair.objects?.length === 2);
  await settled(page); await frames(page);
  await page.screenshot({path: join(pictures, "loop_before.png")});
  assert.ok(await covered(page) > .002, "no cloud of the loop is in the picture");
  assert.equal(await drawn(page), 0);  // the others step back
  const apart = () => page.evaluate(() => { const {pair, data} = window.cambium, T = data.placements(pair.loop).registration; return Math.hypot(...[0, 1, 2].map(k => pair.T_tail_head[k] - T[k])); });
  assert.ok(await apart() > .05, "odometry and registration agree: nothing to see");
  await page.keyboard.press("b");
  await page.waitForFunction(() => window.cambium.placement === "registration");
  // It goes there within half a second of frames.
  await page.waitForFunction(() => { const {pair, data} = window.cambium, T = data.placements(pair.loop).registration; return Math.hypot(...[0, 1, 2].map(k => pair.T_tail_head[k] - T[k])) < 1e-6; });
  await frames(page);
  await page.screenshot({path: join(pictures, "loop_after.png")});
  await page.click("[data-placement=map]");
  await page.keyboard.press("n");
  assert.notEqual(await page.evaluate(() => window.cambium.picked.item.index), loop.index);
  await page.keyboard.press("Escape");
  assert.equal(await page.isVisible("#detail"), false);
}

async function nodesAndStems(page) {
  await page.keyboard.press("0"); await settled(page);
  const at = await page.evaluate(() => { const app = window.cambium; return app.stage.project(app.overlay.at([...app.data.images.keys()][0])); });
  await page.mouse.click(...at);
  await page.waitForFunction(() => { const i = document.querySelector("#detail img"); return i && i.complete && i.naturalWidth === 8; });
  assert.match(await text(page, "detail"), /position in the map/);
  await page.evaluate(() => window.cambium.pick({kind: "stem", item: window.cambium.stems.shown.find(s => s.dbh)}));
  assert.match(await text(page, "detail"), /diameter[\d.]+( ± [\d.]+)? cm/);
  await page.keyboard.press("Escape");
}

/// The middle of the first picture's plane: where it is in the map, and its colour on the screen.
const plane = page => page.evaluate(() => {
  const app = window.cambium, [node] = app.images.planes.keys(), corners = app.images.corners(node);
  const middle = [0, 1, 2].map(k => (corners[0][k] + corners[2][k]) / 2), at = app.stage.project(middle), {renderer, target} = app.stage;
  const bytes = new Uint8Array(4), ratio = target.width / app.stage.width;
  if (at) renderer.readRenderTargetPixels(target, Math.round(at[0] * ratio), Math.round(target.height - at[1] * ratio), 1, 1, bytes);
  return {node, middle, colour: [...bytes.slice(0, 3)], width: app.images.planes.get(node).material.map?.image.naturalWidth};
});

async function picturesStandAtTheirPoses(page) {
  await page.waitForFunction(() => [...window.cambium.images.planes.values()].some(p => p.material.map));
  const {node, middle} = await plane(page);
  const pose = await page.evaluate(n => window.cambium.data.fused(n), node);
  assert.ok(Math.abs(Math.hypot(...middle.map((v, k) => v - pose[k])) - 1.2) < 1e-6, "the plane does not stand before its node");
  await page.click("[data-layer=points]"); await page.click("[data-layer=stems]");
  // From behind the robot, as it looked.
  await page.evaluate(([m, p]) => window.cambium.stage.flyTo(m, 1.2, p.map((v, k) => v - m[k])), [middle, pose.slice(0, 3)]);
  await settled(page); await frames(page);
  const seen = await plane(page);
  assert.equal(seen.width, 8);
  [0x30, 0x90, 0x50].forEach((v, k) => assert.ok(Math.abs(seen.colour[k] - v) < 12, `the picture is ${seen.colour}`));
  await page.screenshot({path: join(pictures, "image.png")});
  await page.click("[data-layer=images]"); await frames(page);
  assert.equal(await page.evaluate(() => window.cambium.images.group.visible), false);
  for (const layer of ["images", "points", "stems"]) await page.click(`[data-layer=${layer}]`);
  await page.keyboard.press("0"); await settled(page);
}

async function theSlider(page) {
  const first = () => page.evaluate(() => { const app = window.cambium; return app.overlay.at(app.data.nodes - 1); });
  const inMap = await first();
  await page.focus("#stage"); await page.keyboard.press("Home"); await frames(page);
  assert.equal(await text(page, "stage-name"), "odometry only");
  assert.ok(Math.hypot(...(await first()).map((v, k) => v - inMap[k])) > .05, "odometry is where the map is");
  assert.equal(await page.evaluate(() => window.cambium.uniforms.moved.value), true);
  await page.screenshot({path: join(pictures, "odometry.png")});
  await page.keyboard.press("End");
  assert.equal(await text(page, "stage-name"), "the map");
  assert.deepEqual(await first(), inMap);
  assert.ok(await page.evaluate(() => window.cambium.data.stages.length) >= 3, "no stage of an optimisation");
  await page.click("#play");
  await page.waitForFunction(() => window.cambium.time < window.cambium.data.last);
  await page.click("#play");
  await page.focus("#view"); await page.keyboard.press("h");
  assert.equal(await page.isVisible("#help"), true);
  const where = () => page.evaluate(() => window.cambium.stage.camera.position.toArray());
  for (const key of ["ArrowUp", "ArrowLeft", "+", "-", "q", "e", "r", "f"]) {
    const before = await where();
    await page.keyboard.press(key);
    assert.notDeepEqual(await where(), before, key);
  }
  await page.keyboard.press("Escape");
}

async function onAPhone() {
  const {page, close} = await open({viewport: {width: 390, height: 780}, hasTouch: true, isMobile: true, deviceScaleFactor: 2}, software);
  await complete(page);
  assert.equal(await page.isVisible("#side"), false);
  await page.tap("#menu");
  assert.equal(await page.isVisible("#side"), true);
  await page.tap("#menu");
  const at = await page.evaluate(() => { const app = window.cambium, p = app.data.missionOf.map((_, n) => app.stage.project(app.overlay.at(n))); return p.find(q => document.elementFromPoint(...q)?.id === "view"); });
  await page.touchscreen.tap(...at);
  await page.waitForSelector("#detail:not([hidden])");
  await frames(page);
  await page.screenshot({path: join(pictures, "phone.png")});
  await close();
}

async function withoutWebGL() {
  const {page, close} = await open({viewport: {width: 900, height: 600}}, ["--disable-gpu", "--disable-3d-apis"]);
  await page.waitForSelector("#message:not([hidden])");
  assert.match(await text(page, "message"), /This page needs WebGL 2/);
  assert.match(await text(page, "message"), /report\.html/);
  await page.screenshot({path: join(pictures, "no_webgl.png")});
  await close();
}

const {page, close} = await open({viewport: {width: 1000, height: 700}}, software);
for (const step of [showsTheMap, coloursAndLayers, aClickOnALoopOpensItsRow, nodesAndStems, picturesStandAtTheirPoses, theSlider]) {
  await step(page);
  console.log(step.name);
}
await close();
for (const step of [onAPhone, withoutWebGL]) {
  await step();
  console.log(step.name);
}
