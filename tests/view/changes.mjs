// SPDX-License-Identifier: BSD-3-Clause
// node changes.mjs NODE_MODULES CHROMIUM ADDRESS COUNTS PICTURES: the page with what `cambium changes` found.
// COUNTS: its trees by kind, as JSON.
import assert from "node:assert/strict";
import {join} from "node:path";
import {complete, frames, open, pictures, points as counts, settled, software, text} from "./session.mjs";

const expected = JSON.parse(counts);
const {page, close} = await open({viewport: {width: 1000, height: 700}}, software);
await complete(page);
assert.match(await text(page, "compared"), /map:spring → .*map:autumn/);
for (const [kind, count] of Object.entries(expected)) {
  const chip = await page.$(`[data-layer='change ${kind}']`);
  assert.equal(count > 0, chip !== null, kind);
  if (chip) assert.equal((await chip.textContent()).split(" ")[0], count.toLocaleString("en"), kind);
}
console.log("layers");

// A click on a tree that is gone tells its figures.
await page.keyboard.press("t"); await settled(page);
await page.click("[data-layer=paths]"); await page.click("[data-layer=accepted]"); await page.click("[data-layer=rejected]");
const gone = await page.evaluate(() => {
  const app = window.cambium;
  app.stage.camera.updateMatrixWorld();
  for (const tree of app.changes.shown.filter(s => s.change === "gone")) {
    const at = app.stage.project([tree.x, tree.y, tree.z + 4]);
    if (at && document.elementFromPoint(...at)?.id === "view") return {at, tree};
  }
  return null;
});
assert.ok(gone, "no tree that is gone lies free");
await page.mouse.click(...gone.at);
assert.equal(await page.evaluate(() => window.cambium.picked?.kind), "change");
const row = await text(page, "detail"), picked = await page.evaluate(() => window.cambium.picked.item);
assert.ok(row.includes(`${(100 * picked.dbh_before).toFixed(1)}`) && /diameter in .*spring/.test(row), row);
await page.screenshot({path: join(pictures, "changes.png")});

await page.evaluate(() => { const app = window.cambium; app.pick({kind: "change", item: app.changes.layer.stems.find(s => s.change === "kept" && s.growth !== null)}); });
assert.match(await text(page, "detail"), /Tree, grown.*growth-?\d+( ± \d+)? mm/);
await page.keyboard.press("Escape");
console.log("figures");

// Each kind can be hidden; the squares of ground and canopy come when asked for.
const visible = name => page.evaluate(n => (window.cambium.changes.trees[n] || window.cambium.changes.squares[n]).object.visible, name);
assert.equal(await visible("gone"), true);
await page.click("[data-layer='change gone']"); await frames(page);
assert.equal(await visible("gone"), false);
await page.click("[data-layer='change gone']");
assert.equal(await visible("canopy"), false);
await page.click("[data-layer='change canopy']"); await page.click("[data-layer=points]"); await frames(page);
assert.equal(await visible("canopy"), true);
await page.screenshot({path: join(pictures, "canopy.png")});
console.log("heights");
await close();
