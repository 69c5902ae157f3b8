// SPDX-License-Identifier: BSD-3-Clause
// A browser with the page in it, and what tests ask of the page. Arguments of the program that imports it:
// NODE_MODULES CHROMIUM ADDRESS POINTS PICTURES.
import assert from "node:assert/strict";
import {createRequire} from "node:module";
import {join} from "node:path";

const [modules, executablePath, address] = process.argv.slice(2);
export const [points, pictures] = process.argv.slice(5);
const {chromium} = createRequire(join(modules, "x.js"))("playwright-core");
const quiet = ["--no-sandbox", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"];

/// Fails at close() when the page wrote an error to its console or asked another server.
export async function open(options, flags) {
  const browser = await chromium.launch({executablePath, args: [...quiet, ...flags]});
  const page = await (await browser.newContext(options)).newPage(), wrong = [];
  page.on("console", m => { if (m.type() === "error") wrong.push(`console: ${m.text()}`); });
  page.on("pageerror", e => wrong.push(`error: ${e.message}`));
  page.on("requestfailed", r => { if (!/ERR_ABORTED/.test(r.failure()?.errorText)) wrong.push(`no answer: ${r.url()}`); });
  page.on("request", r => { if (!r.url().startsWith(address) && !/^(data|blob):/.test(r.url())) wrong.push(`asks for ${r.url()}`); });
  page.setDefaultTimeout(240000);  // without a graphics card, on a machine that has other work, a frame takes seconds
  await page.goto(address);
  return {browser, page, close: async () => { assert.deepEqual(wrong, []); await browser.close(); }};
}

export const software = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
export const complete = page => page.waitForFunction(() => document.getElementById("status").dataset.complete === "true");
export const settled = page => page.waitForFunction(() => !window.cambium.stage.flight);
export const text = (page, id) => page.textContent(`#${id}`);
export const drawn = page => page.evaluate(() => +document.getElementById("status").dataset.drawn);

/// The share of the picture that points and stems cover.
export const covered = page => page.evaluate(() => {
  const {renderer, target} = window.cambium.stage, bytes = new Uint8Array(4 * target.width * target.height);
  renderer.readRenderTargetPixels(target, 0, 0, target.width, target.height, bytes);
  let n = 0;
  for (let i = 3; i < bytes.length; i += 4) n += bytes[i] > 0;
  return n / (target.width * target.height);
});
export const frames = page => page.evaluate(() => new Promise(done => { window.cambium.stage.invalidate(); requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(done))); }));
