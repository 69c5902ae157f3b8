// SPDX-License-Identifier: BSD-3-Clause
// Tables and plots of the run: metrics before and after, residuals, time, missions.
const svgElement = (tag, attributes, ...children) => {
  const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  e.append(...children);
  return e;
};

// The labels of `evaluate` steps in order, and the metrics of each: name -> metric.
function metricsByLabel() {
  const labels = [...new Set(run.steps.filter(s => s.verb === "evaluate").map(s => s.label))];
  const table = new Map(labels.map(l => [l, new Map()]));
  for (const m of run.metrics) {
    const label = labels.find(l => l && m.name.startsWith(`${l}.`)) || "";
    if (!table.has(label)) table.set(label, new Map());
    table.get(label).set(label ? m.name.slice(label.length + 1) : m.name, m);
  }
  for (const [label, metrics] of table) if (!metrics.size) table.delete(label);
  return table;
}

function metricTable(names, table) {
  const labels = [...table.keys()];
  const cells = name => labels.map((label, k) => {
    const m = table.get(label).get(name), first = labels.map(l => table.get(l).get(name)).find(x => x && x.value !== null);
    if (!m) return element("td", {}, "–");
    const sign = first === m || m.better === "neither" || m.value === null ? 0 :
      Math.sign(first.value - m.value) * (m.better === "lower" ? 1 : -1);
    return element("td", {class: sign > 0 ? "better" : sign < 0 ? "worse" : ""}, number(m.value, 4));
  });
  const unit = name => labels.map(l => table.get(l).get(name)).find(x => x).unit;
  return element("div", {class: "scroll"}, element("table", {},
    element("tr", {}, element("th", {}, "metric"), ...labels.map(l => element("th", {}, l || "value")), element("th", {}, "unit")),
    ...names.map(n => element("tr", {}, element("td", {}, n), ...cells(n), element("td", {}, unit(n))))));
}

function setUpMetrics() {
  const table = metricsByLabel(), all = [...new Set([...table.values()].flatMap(t => [...t.keys()]))];
  const seen = new Set(), headline = all.filter(n => !seen.has(n.split(".")[0]) && seen.add(n.split(".")[0]));
  if (!all.length) {
    $("metrics").append(element("p", {class: "note"}, "The pipeline has no evaluate step. 'cambium evaluate RUN' measures a finished run."));
    $("all-metrics").closest("details").hidden = true;
    return null;
  }
  $("metrics").append(metricTable(headline, table));
  $("all-metrics").append(metricTable(all, table));
  const first = headline[0], values = [...table.values()].map(t => t.get(first)).filter(m => m && m.value !== null);
  return values.length ? {name: first, values} : null;
}

// How far accepted loops are from odometry and from the map, in bins of a third of a power of ten.
function setUpHistogram() {
  const accepted = loops.filter(l => l.state === "accepted" && l.after !== null);
  const bins = 16, low = -3, bin = v => Math.max(0, Math.min(bins - 1, Math.floor((Math.log10(Math.max(v, 1e-9)) - low) * 3)));
  if (!accepted.length) return $("histogram").append(element("p", {class: "note"}, "No loop was accepted."));
  const counts = field => { const c = new Array(bins).fill(0); for (const l of accepted) ++c[bin(l[field])]; return c; };
  const before = counts("before"), after = counts("after"), top = Math.max(...before, ...after);
  const [w, h, left, base] = [560, 230, 34, 196], step = (w - left - 8) / bins;
  const bars = (c, colour, shift, name) => c.map((n, k) => svgElement("rect", {x: left + k * step + shift, y: base - 170 * n / top, width: step / 2 - 1.5,
    height: 170 * n / top, rx: 2, fill: colour}, svgElement("title", {}, `${name}: ${n} loops from ${number(10 ** (low + k / 3), 2)} m`)));
  const text = (x, y, anchor, t) => svgElement("text", {x, y, "text-anchor": anchor}, t);
  $("histogram").append(svgElement("svg", {viewBox: `0 0 ${w} ${h}`, role: "img", "aria-label": "Histogram of loop residuals"},
    svgElement("line", {x1: left, x2: w, y1: base, y2: base, stroke: "#9aa59f"}),
    text(left - 5, base - 164, "end", String(top)), text(left - 5, base, "end", "0"),
    ...["1 mm", "1 cm", "0.1 m", "1 m", "10 m", "100 m"].map((t, k) => text(left + 3 * k * step, base + 16, "middle", t)),
    ...bars(before, "#c9b458", 1, "before"), ...bars(after, "#009e73", step / 2, "after"),
    svgElement("rect", {x: w - 190, y: 4, width: 11, height: 11, rx: 2, fill: "#c9b458"}), text(w - 174, 14, "start", "by odometry"),
    svgElement("rect", {x: w - 90, y: 4, width: 11, height: 11, rx: 2, fill: "#009e73"}), text(w - 74, 14, "start", "in the map")));
  const median = field => { const v = accepted.map(l => l[field]).sort((a, b) => a - b); return v[v.length >> 1]; };
  $("histogram-note").textContent = `Distance between the registration of an accepted loop and the two poses: median ` +
    `${number(median("before"))} m by the robots' own odometry, ${number(median("after"))} m in the map (${plural(accepted.length, "loop")}).`;
}

function setUpSteps() {
  const most = Math.max(...run.steps.map(s => s.seconds), 1e-9);
  $("steps").append(element("div", {class: "scroll"}, element("table", {},
    element("tr", {}, ...["step", "plugin", "seconds", "", "items", "cached", "result"].map(t => element("th", {}, t))),
    ...run.steps.map(s => element("tr", {}, element("td", {}, s.verb + (s.label ? ` (${s.label})` : "")), element("td", {}, s.plugin),
      element("td", {}, s.seconds < .01 ? "< 0.01" : number(s.seconds)), element("td", {}, element("div", {class: `bar${s.cached ? " cached" : ""}`, style: `width:${100 * s.seconds / most}%`})),
      element("td", {}, s.items.toLocaleString("en")), element("td", {}, s.cached_items.toLocaleString("en")), element("td", {}, s.summary))))));
}

function setUpMissions() {
  const head = ["mission", "platform", "island", "nodes", "path [m]", "GNSS fixes", "folder"];
  $("missions").append(element("div", {class: "scroll"}, element("table", {}, element("tr", {}, ...head.map(t => element("th", {}, t))),
    ...map.missions.map((m, i) => element("tr", {}, element("td", {}, element("span", {class: "swatch", style: `background:${colourOf(i)}`}), m.name),
      ...[m.platform, m.island, m.ids.length, number(m.length, 4), m.fix_count].map(v => element("td", {}, String(v))), element("td", {}, m.folder))))));
  $("resolved").textContent = map.resolved;
}
