// SPDX-License-Identifier: BSD-3-Clause
// Plan and side view.
const point = (list, i) => [list[3 * i], list[3 * i + 1], list[3 * i + 2]];
const points = list => Array.from({length: list.length / 3}, (_, i) => point(list, i));
for (const m of map.missions) { m.pathPoints = points(m.path); m.odometryPoints = points(m.odometry); m.fixPoints = points(m.fixes); }

const onIsland = () => map.missions.map((m, i) => [m, i]).filter(([m]) => m.island === view.island);
const layerOn = name => view.layers[name] !== false;
const missionOn = i => layerOn(`mission ${i}`);
const endsOf = loop => [["tail_mission", "tail"], ["head_mission", "head"]].map(
  ([mission, node]) => map.missions[ledger[mission][loop.index]].pathPoints[ledger[node][loop.index]]);
const loopOn = loop => map.missions[ledger.tail_mission[loop.index]].island === view.island &&
  map.missions[ledger.head_mission[loop.index]].island === view.island &&
  missionOn(ledger.tail_mission[loop.index]) && missionOn(ledger.head_mission[loop.index]) &&
  (loop.state === "accepted" ? layerOn("accepted") : loop.state === "rejected" ? layerOn("rejected") : false);

// The side view looks across the longest extent of the map: its first principal axis on the plan.
function longAxis() {
  let n = 0, mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
  for (const [m] of onIsland()) for (const [x, y] of m.pathPoints) {
    ++n; const dx = x - mx, dy = y - my; mx += dx / n; my += dy / n;
    xx += dx * (x - mx); xy += dx * (y - my); yy += dy * (y - my);
  }
  const angle = Math.atan2(2 * xy, xx - yy) / 2;
  return [Math.cos(angle), Math.sin(angle)];
}

function line(canvas, list, colour, width, dash = []) {
  const pen = canvas.pen;
  pen.strokeStyle = colour; pen.lineWidth = width; pen.setLineDash(dash); pen.lineJoin = "round";
  pen.beginPath();
  list.forEach((p, i) => i ? pen.lineTo(...canvas.at(p)) : pen.moveTo(...canvas.at(p)));
  pen.stroke();
  pen.setLineDash([]);
}

function dots(canvas, list, colour, radius) {
  canvas.pen.fillStyle = colour;
  for (const p of list) { const [x, y] = canvas.at(p); canvas.pen.beginPath(); canvas.pen.arc(x, y, radius, 0, 7); canvas.pen.fill(); }
}

function drawLoops(canvas, state, colour) {
  const pen = canvas.pen;
  pen.strokeStyle = colour; pen.lineWidth = 1.2;
  pen.beginPath();
  for (const loop of view.shown) if (loop.state === state && loopOn(loop)) {
    const [a, b] = endsOf(loop);
    pen.moveTo(...canvas.at(a)); pen.lineTo(...canvas.at(b));
  }
  pen.stroke();
}

function drawMap(canvas) {
  const missions = onIsland().filter(([, i]) => missionOn(i));
  if (layerOn("fixes")) for (const [m, i] of missions) { canvas.pen.globalAlpha = .28; dots(canvas, m.fixPoints, colourOf(i), 2.2); canvas.pen.globalAlpha = 1; }
  if (layerOn("odometry")) for (const [m, i] of missions) { canvas.pen.globalAlpha = .55; line(canvas, m.odometryPoints, colourOf(i), 1, [5, 4]); canvas.pen.globalAlpha = 1; }
  drawLoops(canvas, "rejected", "rgba(213,94,0,.55)");
  drawLoops(canvas, "accepted", "rgba(0,158,115,.75)");
  for (const [m, i] of missions) {
    line(canvas, m.pathPoints, colourOf(i), 2);
    if (m.pathPoints.length < 60 * canvas.width / 100) dots(canvas, m.pathPoints, colourOf(i), 2.4);
    if (m.pathPoints.length) drawStart(canvas, m.pathPoints[0], colourOf(i));
  }
  if (view.picked && map.missions[ledger.tail_mission[view.picked.index]].island === view.island) drawPicked(canvas);
}

function drawStart(canvas, p, colour) {
  const [x, y] = canvas.at(p), pen = canvas.pen;
  pen.beginPath(); pen.arc(x, y, 5.5, 0, 7);
  pen.fillStyle = "#fff"; pen.fill(); pen.strokeStyle = colour; pen.lineWidth = 2.5; pen.stroke();
}

function drawPicked(canvas) {
  const ends = endsOf(view.picked), pen = canvas.pen;
  line(canvas, ends, "#fff", 6); line(canvas, ends, "#111", 3); dots(canvas, ends, "#111", 5);
  pen.font = "600 12px system-ui, sans-serif"; pen.textAlign = "left";
  [view.picked.tail, view.picked.head].forEach((text, k) => {
    const [x, y] = canvas.at(ends[k]), at = y + (k ? 16 : -9);
    pen.lineWidth = 4; pen.strokeStyle = "#fff"; pen.strokeText(text, x + 7, at);
    pen.fillStyle = "#111"; pen.fillText(text, x + 7, at);
  });
}

// The loop nearest to a click, at most 8 pixels away.
function pickAt(canvas, x, y) {
  let best = null, least = 8;
  for (const loop of view.shown) if (loopOn(loop)) {
    const [[ax, ay], [bx, by]] = endsOf(loop).map(p => canvas.at(p));
    const l = (bx - ax) ** 2 + (by - ay) ** 2;
    const t = l ? Math.max(0, Math.min(1, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / l)) : 0;
    const d = Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay));
    if (d < least) [best, least] = [loop, d];
  }
  pick(best, true);
}

let planCanvas;

function setUpMap() {
  let axis = longAxis();
  const content = () => onIsland().flatMap(([m]) => m.pathPoints.concat(m.odometryPoints));
  const plan = new Canvas($("plan"), p => p, false, drawMap, (x, y) => pickAt(plan, x, y));
  const side = new Canvas($("side"), p => [axis[0] * p[0] + axis[1] * p[1], p[2]], true, drawMap, (x, y) => pickAt(side, x, y));
  const refill = () => {
    axis = longAxis();
    for (const c of [plan, side]) { c.content = content(); c.fit(); c.draw(); }
    const heading = (90 - Math.atan2(axis[1], axis[0]) * 180 / Math.PI + 360) % 180;
    $("side-caption").textContent = `Side view, along the longest extent of the map (${heading.toFixed(0)}° from the map's y axis); ` +
      `heights are stretched ${number(side.sy / side.sx, 2)} times.`;
  };
  planCanvas = plan;
  refill();
  view.listeners.push(() => { plan.draw(); side.draw(); });
  return refill;
}

function setUpLayers(refill) {
  const chip = (name, text, colour) => {
    const b = element("button", {class: "chip", type: "button", "aria-pressed": layerOn(name), style: `--c:${colour}`,
      onclick() { view.layers[name] = !layerOn(name); b.setAttribute("aria-pressed", layerOn(name)); view.changed(); }}, text);
    return b;
  };
  const build = () => {
    const here = onIsland(), fixes = here.some(([m]) => m.fixPoints.length), step = Math.max(...here.map(([m]) => m.fix_step));
    const count = state => loops.filter(l => l.state === state && map.missions[ledger.tail_mission[l.index]].island === view.island).length;
    $("layers").replaceChildren(
      ...here.map(([m, i]) => chip(`mission ${i}`, m.name, colourOf(i))),
      chip("accepted", plural(count("accepted"), "accepted loop"), "var(--accepted)"),
      chip("rejected", `${count("rejected").toLocaleString("en")} rejected`, "var(--rejected)"),
      chip("odometry", "odometry (dashed)", "#888"),
      ...(fixes ? [chip("fixes", step > 1 ? `GNSS fixes (every ${step}th)` : "GNSS fixes", "#b9c4bd")] : []));
    if (map.islands.length < 2) return;
    const select = element("select", {"aria-label": "Island", onchange() { view.island = +select.value; build(); refill(); }},
      ...map.islands.map((island, i) => element("option", {value: i}, `island ${i}: ${island.missions.join(", ")}`)));
    select.value = view.island;
    $("layers").prepend(select);
  };
  if (loops.filter(l => l.state === "rejected").length > 300) view.layers.rejected = false;
  build();
}
