// SPDX-License-Identifier: BSD-3-Clause
// The panel about what was picked: a loop with its row of the ledger, a node, a stem, a
// change.
import {kinds} from "./changes.js";
import {$, element, number, plural} from "./dom.js";
import {distance} from "./pose.js";

const error = d => d ? `${number(d[0])} m, ${number(d[1])}°` : "–";
const list = rows => element("dl", {}, ...rows.filter(r => r).flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
const placementNames = {odometry: "odometry", registration: "registration", map: "map"};

function show(app, title, ...content) {
  $("detail").replaceChildren(element("h3", {}, ...title), element("button", {type: "button", class: "close", "aria-label": "Close", onclick: () => app.pick(null)}, "×"), ...content);
  $("detail").hidden = false;
}

export function hideDetail() { $("detail").hidden = true; }

/// The ledger's row, with the words of report.html.
export function showLoop(app, loop) {
  const {data} = app, d = data.differences(loop);
  const verdict = element("p", {}, element("span", {class: `verdict ${loop.state}`}, loop.state),
    loop.decided ? ` by ${loop.decided}` : "", loop.reason ? `: ${loop.reason}` : "");
  const rows = [["proposed by", loop.proposed || "–"], ["registered by", loop.registered || "–"], ["off the odometry", error(d.before)],
    ["off the map", error(d.after)], loop.weight === null ? null : ["weight", number(loop.weight)], ...loop.scores.map(([name, v]) => [name, number(v, 4)])];
  show(app, [element("span", {class: "tail"}, data.nameOf(loop.tail)), " ← ", element("span", {class: "head"}, data.nameOf(loop.head))],
    verdict, placements(app, loop), list(rows), stepButtons(app));
}

function placements(app, loop) {
  if (!app.pair.has(loop)) return element("p", {}, "The clouds of this loop were not exported, or there are none.");
  const there = app.data.placements(loop);
  const button = name => element("button", {type: "button", "data-placement": name, "aria-pressed": app.placement === name,
    onclick: () => app.place(name)}, placementNames[name]);
  const box = element("div", {class: "segments", role: "group", "aria-label": "Where the second cloud lies"},
    ...Object.keys(placementNames).map(button));
  if (!there.registration) { const b = box.children[1]; b.disabled = true; b.title = "It was not registered"; }
  const rest = element("button", {type: "button", "aria-pressed": app.withRest, onclick: () => app.showRest(!app.withRest)}, app.withRest ? "Hide the rest" : "Show the rest");
  return element("div", {}, element("p", {}, element("span", {class: "head"}, `${app.data.nameOf(loop.head)} placed by`)), box, element("div", {class: "row"}, rest));
}

function stepButtons(app) {
  return element("div", {class: "row"}, element("button", {type: "button", onclick: () => app.nextLoop(-1)}, "‹ Previous"),
    element("button", {type: "button", onclick: () => app.nextLoop(1)}, "Next loop ›"));
}

export function showNode(app, node) {
  const {data} = app, loops = app.overlay.visibleLoops.filter(l => l.tail === node || l.head === node), p = data.fused(node);
  const moved = distance(data.byOdometry(node), p), picture = data.images.get(node);
  const button = l => element("button", {type: "button", class: "chip", onclick: () => app.pick({kind: "loop", item: l})},
    element("span", {class: `verdict ${l.state}`}, data.nameOf(l.tail === node ? l.head : l.tail)));
  show(app, [data.nameOf(node)],
    ...(picture ? [element("img", {src: picture, alt: `What the robot saw at ${data.nameOf(node)}`})] : []),
    list([["position in the map", `${p.slice(0, 3).map(v => v.toFixed(2)).join(", ")} m`], ["off the odometry", error(moved)]]),
    element("p", {}, loops.length ? `${plural(loops.length, "loop")} with` : "No loop in sight."),
    element("div", {class: "chips"}, ...loops.slice(0, 24).map(button), ...(loops.length > 24 ? [`and ${loops.length - 24} more`] : [])));
}

export function showStem(app, stem) {
  show(app, ["Stem"], list([["diameter", stem.dbh ? `${(100 * stem.dbh).toFixed(1)}${stem.dbh_spread ? ` ± ${(100 * stem.dbh_spread).toFixed(1)}` : ""} cm` : "not measured"], ["sightings", String(stem.sightings)],
    ["seen by", stem.missions.map(m => app.data.missions[m].name).join(", ")], ["base in the map", `${stem.base.map(v => v.toFixed(2)).join(", ")} m`]]));
}

const diameter = (dbh, sigma) => dbh === null ? "–" : `${(100 * dbh).toFixed(1)}${sigma ? ` ± ${(100 * sigma).toFixed(1)}` : ""} cm`;

/// A row of `cambium changes`, by the words of docs/monitoring.md.
export function showChange(app, stem) {
  const {layer} = app.changes, kept = stem.change === "kept";
  const title = element("span", {}, kept && stem.growth !== null ? "Tree, grown" : `Tree, ${kinds[stem.change][0]}`);
  title.style.color = kinds[stem.change][1];
  const growth = stem.growth === null ? "–" : `${(1000 * stem.growth).toFixed(0)}${stem.growth_sigma === null ? "" : ` ± ${(1000 * stem.growth_sigma).toFixed(0)}`} mm`;
  show(app, [title], stem.reason ? element("p", {}, stem.reason) : "", list([
    [`diameter in ${layer.before}`, diameter(stem.dbh_before, stem.sigma_before)], [`diameter in ${layer.after}`, diameter(stem.dbh_after, stem.sigma_after)],
    kept ? ["growth", growth] : ["detections expected", number(stem.expected)], kept ? null : ["detections there", String(stem.near)],
    ["sightings", `${stem.sightings_before ?? 0} and ${stem.sightings_after ?? 0}`],
    ["base in the map", `${[stem.x, stem.y, stem.z].map(v => v.toFixed(2)).join(", ")} m`]]));
}
