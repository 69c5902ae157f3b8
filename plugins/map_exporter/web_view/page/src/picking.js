// SPDX-License-Identifier: BSD-3-Clause
// What lies under a click, by distance on the screen: nodes before loops before changes before stems.
const toSegment = ([x, y], [ax, ay], [bx, by]) => {
  const l = (bx - ax) ** 2 + (by - ay) ** 2, t = l ? Math.max(0, Math.min(1, ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / l)) : 0;
  return Math.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay));
};

/// {kind: "node" | "loop" | "change" | "stem", item} or null. `reach`: pixels; fingers need more than a mouse.
export function pickAt(x, y, app, reach) {
  const {stage, overlay, data, stems, layers} = app, at = [x, y];
  let best = null;
  const offer = (kind, item, distance, limit) => { if (distance < (best && best.kind === kind ? best.distance : limit)) best = {kind, item, distance}; };
  if (layers.paths !== false)
    for (let node = 0; node < data.nodes; ++node) {
      if (data.islandOf(node) !== app.island || layers[`mission ${data.missionOf[node]}`] === false) continue;
      const p = stage.project(overlay.at(node));
      if (p) offer("node", node, Math.hypot(p[0] - x, p[1] - y), .8 * reach);
    }
  if (best) return best;
  for (const loop of overlay.visibleLoops) {
    const [a, b] = [stage.project(overlay.at(loop.tail)), stage.project(overlay.at(loop.head))];
    if (a && b) offer("loop", loop, toSegment(at, a, b), reach);
  }
  if (best) return best;
  const offerTrees = (kind, trees, ends, width) => {
    for (const tree of trees) {
      const [a, b] = ends(tree).map(p => stage.project(p));
      if (a && b) offer(kind, tree, toSegment(at, a, b), reach + (width(tree) || 0) / 2 * stage.height / stage.camera.position.distanceTo(stage.controls.target));
    }
  };
  if (app.changes) offerTrees("change", app.changes.shown, s => app.changes.ends(s), s => s.dbh_before || s.dbh_after);
  if (best) return best;
  if (layers.stems !== false) offerTrees("stem", stems.shown, s => stems.ends(s), s => s.dbh);
  return best;
}
