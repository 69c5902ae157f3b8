// SPDX-License-Identifier: BSD-3-Clause
"use strict";
const map = JSON.parse(document.getElementById("map").textContent);
const run = JSON.parse(document.getElementById("run").textContent);
const ledger = map.ledger;
const $ = id => document.getElementById(id);

// Okabe and Ito's colours, those of the exporter `plan`; green and red are for loops.
const colours = ["#0072b2", "#e69f00", "#cc79a7", "#56b4e9", "#8c6d31", "#5b3fa0", "#222222"];
const colourOf = mission => colours[mission % colours.length];

function element(tag, attributes = {}, ...children) {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith("on")) e.addEventListener(name.slice(2), value);
    else if (value !== null) e.setAttribute(name, value);
  e.append(...children);
  return e;
}

const number = (v, digits = 3) => v === null || v === undefined ? "–" :
  Math.abs(v) >= 10 ** (digits + 1) ? Math.round(v).toLocaleString("en") : String(+v.toPrecision(digits));
const plural = (n, word) => `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;

// A row of the ledger as an object; the ledger itself is kept by columns.
function loopAt(i) {
  const s = ledger.strings, m = map.missions;
  const node = (mission, index) => `${m[mission].name} ${m[mission].ids[index]}`;
  return {
    index: i, state: s[ledger.state[i]], tail: node(ledger.tail_mission[i], ledger.tail[i]),
    head: node(ledger.head_mission[i], ledger.head[i]), proposed: s[ledger.proposed_by[i]],
    registered: s[ledger.registered_by[i]], decided: s[ledger.decided_by[i]], reason: s[ledger.reason[i]],
    weight: ledger.weight[i], before: ledger.before_m[i], after: ledger.after_m[i], degrees: ledger.after_deg[i],
    beforeDegrees: ledger.before_deg[i], pair: pairOf(i),
    scores: Array.from({length: ledger.scores[i].length / 2}, (_, k) => [s[ledger.scores[i][2 * k]], ledger.scores[i][2 * k + 1]]),
  };
}

function pairOf(i) {
  const a = map.missions[ledger.tail_mission[i]].name, b = map.missions[ledger.head_mission[i]].name;
  return a === b ? `within ${a}` : `${a} – ${b}`;
}

const loops = ledger.state.map((_, i) => loopAt(i));

// What the page shows: loops that pass the filters, the picked one, the island, the layers.
const view = {shown: loops, picked: null, island: 0, layers: {}, listeners: [],
  changed() { for (const f of this.listeners) f(); }};
