// SPDX-License-Identifier: BSD-3-Clause
import {App} from "./app.js";
import {colourOf, MapData} from "./data.js";
import {$, element, message, number, plural} from "./dom.js";
import {setUpKeys} from "./keys.js";
import {pickAt} from "./picking.js";
import {Stage} from "./stage.js";

function webgl(canvas) {
  try { return canvas.getContext("webgl2", {antialias: false, powerPreference: "high-performance"}); } catch { return null; }
}

async function json(name) {
  const answer = await fetch(name);
  if (!answer.ok) throw new Error(`${name}: the server answered ${answer.status}. Did the export come to its end?`);
  return answer.json();
}

async function load() {
  const map = await json("map.json");
  if (map.format !== 1) throw new Error(`map.json has format ${map.format}, this page reads 1. Run the pipeline again.`);
  return new MapData(map);
}

function setUpHeader(data) {
  const names = data.missions.map(m => m.name), length = data.missions.reduce((n, m) => n + m.length, 0);
  $("title").textContent = `${plural(names.length, "mission")}, ${data.islands.length === 1 ? "one map" : `${data.islands.length} islands`}`;
  $("subtitle").textContent = `${names.slice(0, 12).join(" · ")}${names.length > 12 ? ` and ${names.length - 12} more` : ""} · ${plural(data.nodes, "node")}, ` +
    `${length < 1000 ? `${number(length)} m` : `${number(length / 1000)} km`} walked or flown`;
  document.title = `Cambium: ${names.slice(0, 3).join(", ")}${names.length > 3 ? ", …" : ""}`;
  $("labels").append(...data.missions.map((m, i) => { const s = element("span", {}, m.name); s.style.borderColor = colourOf(i); return s; }));
}

function setUpControls(app) {
  $("side").hidden = $("time").hidden = false;
  $("stage").max = app.data.last;
  app.setTime(app.data.last);
  $("stage").addEventListener("input", () => { app.playing = false; app.setTime(+$("stage").value); });
  $("play").addEventListener("click", () => app.play());
  $("size").addEventListener("input", () => { app.uniforms.size.value = +$("size").value * app.stage.renderer.getPixelRatio(); app.stage.invalidate(); });
  $("budget").addEventListener("change", () => { app.points.budget = +$("budget").value; app.stage.invalidate(); });
  $("island").addEventListener("change", () => app.setIsland(+$("island").value));
  $("menu").addEventListener("click", () => { $("side").hidden = !$("side").hidden; $("menu").setAttribute("aria-expanded", !$("side").hidden); });
  if (matchMedia("(max-width: 760px)").matches) $("menu").click();
  if (matchMedia("(pointer: coarse)").matches) { $("budget").value = "1000000"; app.points.budget = 1e6; }  // phones
}

function setUpClicks(app, canvas) {
  let down = null;
  canvas.addEventListener("pointerdown", e => { down = e.isPrimary && e.button === 0 ? [e.clientX, e.clientY] : null; });
  canvas.addEventListener("pointerup", e => {
    if (!down || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 5) return;
    const found = pickAt(e.offsetX, e.offsetY, app, e.pointerType === "touch" ? 16 : 8);
    // While two clouds are looked at, a click beside everything does not take them away.
    if (found || !app.pair.loop) app.pick(found);
  });
}

async function main() {
  const canvas = $("view"), context = webgl(canvas);
  if (!context) {
    const report = element("p", {}, "The plan of the same map, its loops and figures need no WebGL: open report.html in the folder of the run.");
    message("This page needs WebGL 2", "The browser does not have it, or it is switched off. Another browser may have it; in this one, look for hardware acceleration in the settings.");
    $("message").append(report);
    return;
  }
  try {
    const [data, layers] = [await load(), await json("layers.json")];
    setUpHeader(data);
    const app = new App(data, new Stage(canvas, context), layers);
    setUpControls(app);
    setUpClicks(app, canvas);
    setUpKeys(app);
    canvas.focus({preventScroll: true});
    window.cambium = app;  // for the console and for tests
  } catch (error) {
    message("The map cannot be shown", location.protocol === "file:" ?
      "Browsers read no data beside a page that is opened as a file. Open it with 'cambium view RUN', or through any web server." : error.message);
    if (location.protocol !== "file:") console.error(error);
  }
}

main();
