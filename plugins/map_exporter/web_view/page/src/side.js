// SPDX-License-Identifier: BSD-3-Clause
// The panel with colours, missions and layers.
import {kinds, surfaces} from "./changes.js";
import {$, element, many, number, plural} from "./dom.js";
import {colourOf, labelOf} from "./data.js";

export const rampStops = ["#2d4f97", "#1f8f95", "#3fb86a", "#b9d64c", "#ffeb99"];
const colourNames = ["mission", "height", "intensity", "label"];

function chip(app, name, text, colour) {
  const b = element("button", {class: "chip", type: "button", "data-layer": name, "aria-pressed": app.layers[name] !== false, onclick() {
    app.layers[name] = app.layers[name] === false;
    b.setAttribute("aria-pressed", app.layers[name] !== false);
    app.layersChanged();
  }}, element("i"), text);
  b.firstChild.style.background = colour;
  return b;
}

export function buildSide(app) {
  const {data, island} = app, here = data.missions.map((m, i) => [m, i]).filter(([m]) => m.island === island);
  const count = state => data.loops.filter(l => l.state === state && data.islandOf(l.tail) === island).length;
  const fixes = here.reduce((n, [m]) => n + m.fixes.length, 0), step = Math.max(...here.map(([m]) => m.fix_step));
  const pictures = [...data.images.keys()].filter(n => data.islandOf(n) === island).length;
  const stems = data.stems.filter(s => s.island === island).length;
  $("missions").replaceChildren(...here.map(([m, i]) => chip(app, `mission ${i}`, m.name, colourOf(i))));
  $("layers").replaceChildren(
    chip(app, "points", "points", "#b9d64c"), chip(app, "paths", "paths", "#ffffff"),
    chip(app, "accepted", plural(count("accepted"), "accepted loop"), "var(--accepted)"),
    chip(app, "rejected", `${count("rejected").toLocaleString("en")} rejected`, "var(--rejected)"),
    chip(app, "odometry", "odometry (dashed)", "#888"),
    ...(stems ? [chip(app, "stems", plural(stems, "stem"), "#c98a4b")] : []),
    ...(fixes ? [chip(app, "fixes", step > 1 ? `GNSS fixes (every ${step}th)` : "GNSS fixes", "#b9c4bd")] : []),
    ...(pictures ? [chip(app, "images", plural(pictures, "image"), "#fff")] : []));
  buildChanges(app);
  $("islands").hidden = data.islands.length < 2;
  $("island").replaceChildren(...data.islands.map((entry, i) =>
    element("option", {value: i}, `${i}: ${entry.missions.map(m => data.missions[m].name).join(", ")}`)));
  $("island").value = island;
  buildColours(app);
}

function buildChanges(app) {
  const {changes} = app, here = changes && (changes.foreign || changes.island === app.island);
  $("comparison").hidden = !here;
  if (!here) return;
  $("compared").textContent = changes.foreign || `${changes.layer.before} → ${changes.layer.after}`;
  if (changes.foreign) return;
  const trees = Object.entries(kinds).filter(([kind]) => changes.count(kind)).map(([kind, [name, colour]]) =>
    chip(app, `change ${kind}`, `${changes.count(kind).toLocaleString("en")} ${name}`, colour));
  const heights = Object.entries(surfaces).filter(([name]) => changes.count(name)).map(([name, [text]]) =>
    chip(app, `change ${name}`, `${text}, ±${number(changes.squares[name].most, 2)} m`, "linear-gradient(90deg, #2166d9, #eee, #d93321)"));
  $("changes").replaceChildren(...trees, ...heights);
}

export function buildColours(app) {
  const known = [true, true, app.data.islands[app.island].intensity !== null, [...app.labels].some(l => l > 0)];
  $("colours").replaceChildren(...colourNames.map((name, i) => element("button", {type: "button", "data-colour": name,
    "aria-pressed": app.colour === i, ...(known[i] ? {} : {disabled: "", title: `The clouds have no ${name}`}), onclick: () => app.setColour(i)}, name)));
  drawLegend(app);
}

function drawLegend(app) {
  const swatch = ([text, colour]) => { const s = element("span", {class: "chip"}, element("i"), text); s.firstChild.style.background = colour; return s; };
  const bar = (stops, low, high) => {
    const c = element("canvas", {width: 256, height: 1}), pen = c.getContext("2d"), g = pen.createLinearGradient(0, 0, 256, 0);
    stops.forEach((colour, i) => g.addColorStop(i / (stops.length - 1), colour));
    pen.fillStyle = g; pen.fillRect(0, 0, 256, 1);
    return [c, element("div", {class: "ends"}, element("span", {}, low), element("span", {}, high))];
  };
  const range = app.data.islands[app.island].intensity;
  $("legend").replaceChildren(...[
    () => [],
    () => app.heights ? bar(rampStops, `${number(app.heights[0], 3)} m`, `${number(app.heights[1], 3)} m`) : [],
    () => bar(["#1a2926", "#fffae6"], number(range[0]), number(range[1])),
    () => [element("div", {class: "chips"}, ...[...app.labels].sort((a, b) => a - b).map(l => swatch(labelOf(l))))],
  ][app.colour]());
}

export function drawStatus(app, complete) {
  const {points} = app, all = app.data.islands[app.island].points.points;
  const status = $("status");
  status.textContent = points.failed || (all ? `${many(points.shown)} of ${plural(all, "point").replace(/^[\d,]+/, many(all))} drawn, ` +
    `${plural(points.loaded.size, "tile")} in memory${complete ? "" : ", loading …"}` : "This island has no points.");
  Object.assign(status.dataset, {drawn: points.shown, tiles: points.loaded.size, bytes: points.bytes, complete});
}
