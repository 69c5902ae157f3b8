// SPDX-License-Identifier: BSD-3-Clause
function setUpHeader(headline) {
  const names = map.missions.map(m => m.name), islands = map.islands.length;
  const title = `${plural(names.length, "mission")}, ${islands === 1 ? "one map" : `${islands} islands`}`;
  $("title").textContent = title;
  document.title = `Cambium: ${names.slice(0, 3).join(", ")}${names.length > 3 ? ", …" : ""}`;
  $("subtitle").textContent = names.length > 12 ? `${names.slice(0, 12).join(" · ")} and ${names.length - 12} more` : names.join(" · ");
  const tile = (value, text) => element("div", {class: "tile"}, element("b", {}, value), element("span", {}, text));
  const count = state => loops.filter(l => l.state === state).length;
  const length = map.missions.reduce((n, m) => n + m.length, 0);
  const tiles = [
    tile(map.missions.reduce((n, m) => n + m.ids.length, 0).toLocaleString("en"), "nodes"),
    tile(length < 1000 ? `${number(length)} m` : `${number(length / 1000)} km`, "walked or flown"),
    tile(`${count("accepted").toLocaleString("en")} of ${loops.length.toLocaleString("en")}`, "loop candidates accepted"),
    tile(`${number(run.steps.reduce((s, step) => s + step.seconds, 0))} s`, "for all steps")];
  if (headline) {
    const [first, last] = [headline.values[0], headline.values[headline.values.length - 1]];
    const unit = last.unit ? ` ${last.unit}` : "";
    tiles.push(tile(first === last ? `${number(last.value)}${unit}` : `${number(first.value)} → ${number(last.value)}${unit}`, headline.name));
  }
  if (map.islands.some(i => i.georeference)) tiles.push(tile("yes", "tied to the globe"));
  $("tiles").append(...tiles);
}

function setUpWarnings() {
  if (!run.warnings.length) return;
  $("warnings").hidden = false;
  $("warning-list").append(...run.warnings.map(w => element("li", {}, w)));
}

setUpWarnings();
setUpHeader(setUpMetrics());
setUpHistogram();
setUpSteps();
setUpMissions();
const refill = setUpMap();
setUpLayers(refill);
setUpLedger();
$("footer").textContent = `Written by Cambium ${run.cambium}. This page holds everything it shows and asks no network for anything.`;
