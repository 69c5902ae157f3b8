// SPDX-License-Identifier: BSD-3-Clause
// The ledger: a table of all candidates that sorts, filters, and draws only the rows in sight.
const rowHeight = 28;
const columns = [
  ["state", "verdict"], ["tail", "tail"], ["head", "head"], ["proposed", "proposed by"], ["registered", "registered by"],
  ["before", "before [m]", "Distance of the registration from the odometry"], ["after", "after [m]", "Distance of the registration from the map"],
  ["degrees", "after [°]", "The same as an angle"], ["weight", "weight", "Of the last optimisation, 0 to 1"], ["decided", "decided by"],
  ["reason", "reason"]];
const numeric = new Set(["before", "after", "degrees", "weight"]);
const filterNames = {verdict: "state", pair: "pair", proposed: "proposed", registered: "registered", decided: "decided"};
const filters = {reason: "", sort: "", descending: false};

// The address keeps the filters, so that a view can be passed on: #verdict=rejected&sort=after.
function readAddress() {
  const given = new URLSearchParams(location.hash.slice(1));
  for (const name of [...Object.keys(filterNames), "reason", "sort"]) filters[name] = given.get(name) || "";
  if (!columns.some(c => c[0] === filters.sort)) filters.sort = "";
  filters.descending = given.get("order") === "down";
}

function writeAddress() {
  const out = new URLSearchParams();
  for (const name of [...Object.keys(filterNames), "reason", "sort"]) if (filters[name]) out.set(name, filters[name]);
  if (filters.descending) out.set("order", "down");
  try { history.replaceState(null, "", `#${out}`); } catch { /* not allowed for this address: the view works without */ }
}

function compare(a, b) {
  const [x, y] = [a[filters.sort], b[filters.sort]], turn = filters.descending ? -1 : 1;
  if (x === y) return a.index - b.index;
  if (x === null || x === "") return 1;  // what is not there comes last in both orders
  if (y === null || y === "") return -1;
  return turn * (numeric.has(filters.sort) ? x - y : x.localeCompare(y, "en", {numeric: true}));
}

function applyFilters() {
  const text = filters.reason.toLowerCase();
  view.shown = loops.filter(l => Object.entries(filterNames).every(([name, field]) => !filters[name] || l[field] === filters[name]) &&
    (!text || l.reason.toLowerCase().includes(text)));
  if (filters.sort) view.shown = [...view.shown].sort(compare);
  $("count").textContent = view.shown.length === loops.length ? plural(loops.length, "candidate") :
    `${view.shown.length.toLocaleString("en")} of ${plural(loops.length, "candidate")}`;
  writeAddress();
  $("ledger").scrollTop = 0;
  drawHead(); drawRows(); view.changed();
}

function drawHead() {
  $("head").replaceChildren(...columns.map(([field, title, hint]) => {
    const sorted = filters.sort === field;
    return element("button", {type: "button", title: hint || null, role: "columnheader", "data-field": field,
      "aria-sort": sorted ? filters.descending ? "descending" : "ascending" : "none", class: numeric.has(field) ? "n" : "",
      onclick() { filters.descending = sorted && !filters.descending; filters.sort = field; applyFilters(); }},
      title + (sorted ? filters.descending ? " ▼" : " ▲" : ""));
  }));
}

function rowOf(loop, position) {
  const cell = ([field]) => field === "state" ? element("span", {class: `verdict ${loop.state}`}, loop.state) :
    numeric.has(field) ? element("span", {class: "n"}, number(loop[field])) :
    element("span", {title: field === "reason" ? loop.reason : null}, loop[field] || "–");
  return element("div", {class: `row body${loop === view.picked ? " picked" : ""}`, role: "row", style: `top:${position * rowHeight}px`,
    onclick() { pick(loop); }}, ...columns.map(cell));
}

function drawRows() {
  const box = $("ledger"), first = Math.max(0, Math.floor(box.scrollTop / rowHeight) - 8);
  const last = Math.min(view.shown.length, first + Math.ceil(box.clientHeight / rowHeight) + 20);
  $("rows").style.height = `${view.shown.length * rowHeight}px`;
  $("rows").replaceChildren(...view.shown.slice(first, last).map((loop, i) => rowOf(loop, first + i)));
}

// Picks a loop: its row, its details, its place on the map.
function pick(loop, scroll = false) {
  view.picked = loop;
  if (loop) view.island = map.missions[ledger.tail_mission[loop.index]].island;
  const box = $("ledger"), at = view.shown.indexOf(loop);
  if (loop && (scroll || at * rowHeight < box.scrollTop || (at + 3) * rowHeight > box.scrollTop + box.clientHeight))
    box.scrollTop = Math.max(0, at * rowHeight - box.clientHeight / 3);
  drawRows();
  drawDetail(loop);
  view.changed();
}

function drawDetail(loop) {
  if (!loop) return $("detail").replaceChildren("Pick a row, or a loop on the map, to see its scores.");
  const item = (name, value) => element("div", {}, element("dt", {}, name), element("dd", {}, value));
  const error = (m, deg) => m === null ? "–" : `${number(m)} m, ${number(deg)}°`;
  $("detail").replaceChildren(
    element("b", {}, `${loop.tail} ← ${loop.head}: `), element("span", {class: `verdict ${loop.state}`}, loop.state),
    loop.decided ? ` by ${loop.decided}` : "", loop.reason ? `: ${loop.reason}` : "",
    element("dl", {}, item("off the odometry", error(loop.before, loop.beforeDegrees)), item("off the map", error(loop.after, loop.degrees)),
      ...(loop.weight === null ? [] : [item("weight", number(loop.weight))]), ...loop.scores.map(([name, value]) => item(name, number(value, 4)))));
}

function setUpLedger() {
  readAddress();
  const control = (name, field) => {
    const values = [...new Set(loops.map(l => l[field]))].filter(v => v).sort();
    if (values.length === 1 && name !== "verdict" && !filters[name]) return [];
    if (filters[name] && !values.includes(filters[name])) values.push(filters[name]);
    const select = element("select", {"data-filter": name, onchange() { filters[name] = select.value; applyFilters(); }},
      element("option", {value: ""}, "all"), ...values.map(v => element("option", {}, v)));
    select.value = filters[name];
    return [element("label", {}, {verdict: "Verdict", pair: "Missions", proposed: "Proposed by", registered: "Registered by", decided: "Decided by"}[name], select)];
  };
  const reason = element("input", {type: "search", placeholder: "part of it", "data-filter": "reason", oninput() { filters.reason = reason.value; applyFilters(); }});
  reason.value = filters.reason;
  const clear = element("button", {type: "button", onclick() {
    for (const name of Object.keys(filters)) filters[name] = "";
    for (const c of document.querySelectorAll("[data-filter]")) c.value = "";
    applyFilters();
  }}, "Show all");
  $("filters").append(...Object.entries(filterNames).flatMap(([name, field]) => control(name, field)),
    element("label", {}, "Reason", reason), clear, element("span", {id: "count"}));
  $("ledger").append(element("div", {class: "row head", id: "head", role: "row"}), element("div", {class: "body-space", id: "rows"}));
  $("ledger").addEventListener("scroll", drawRows);
  $("ledger").addEventListener("keydown", e => {
    const step = {ArrowDown: 1, ArrowUp: -1, PageDown: 12, PageUp: -12}[e.key];
    if (!step || !view.shown.length) return;
    e.preventDefault();
    const at = view.picked ? view.shown.indexOf(view.picked) : -1;
    pick(view.shown[Math.max(0, Math.min(view.shown.length - 1, at + step))]);
  });
  applyFilters();
  pick(null);
}
