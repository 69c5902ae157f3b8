// SPDX-License-Identifier: BSD-3-Clause
// map.json as the page uses it. Nodes are numbered over all missions.
import {between, distance, inverse, multiply, poseAt} from "./pose.js";

// Okabe and Ito's hues as in report.html, lighter where the dark ground would swallow them.
const colours = ["#2f8fd6", "#e69f00", "#d98bb5", "#7fcdf5", "#b8944f", "#9a7fe0", "#d9d9d9"];
export const colourOf = mission => colours[mission % colours.length];

// Codes of the ASPRS from LAS, and the parts of trees in its range for users.
export const labels = {0: ["no label", "#7d8a83"], 1: ["unclassified", "#7d8a83"], 2: ["ground", "#b08d57"], 3: ["low vegetation", "#a6d96a"],
  4: ["medium vegetation", "#5fb85f"], 5: ["high vegetation", "#2f9e5a"], 6: ["building", "#d95f5f"], 9: ["water", "#4aa3df"],
  64: ["trunk", "#d9773b"], 65: ["branch", "#e8c25a"], 66: ["leaf", "#57b65a"]};
export const labelOf = code => labels[code] || [`label ${code}`, `hsl(${(code * 67) % 360} 55% 60%)`];

export class MapData {
  constructor(json) {
    this.missions = json.missions;
    this.islands = json.islands;
    this.stages = json.stages.map(s => ({name: s.name, poses: Float64Array.from(s.poses)}));
    this.stems = json.stems;
    this.images = new Map(json.images);
    this.missionOf = [];
    this.missions.forEach((m, i) => { m.first = this.missionOf.length; m.ids.forEach(() => this.missionOf.push(i)); });
    this.loops = this.readLoops(json.loops);
    for (const island of this.islands) island.pairNodes = new Set(island.pairs);
  }

  get nodes() { return this.missionOf.length; }
  get last() { return this.stages.length - 1; }
  idOf(node) { return this.missions[this.missionOf[node]].ids[node - this.missions[this.missionOf[node]].first]; }
  nameOf(node) { return `${this.missions[this.missionOf[node]].name} ${this.idOf(node)}`; }
  islandOf(node) { return this.missions[this.missionOf[node]].island; }
  fused(node) { return poseAt(this.stages[this.last].poses, node); }
  byOdometry(node) { return poseAt(this.stages[0].poses, node); }

  /// The pose of a node at a place of the slider: 0 is the first stage, 1 the second, 1.5 half way to the third.
  at(node, time) {
    const k = Math.min(Math.floor(time), this.last), s = time - k;
    const A = poseAt(this.stages[k].poses, node);
    return s > 0 ? between(A, poseAt(this.stages[k + 1].poses, node), s) : A;
  }

  readLoops({strings: s, rows}) {
    return rows.map(([tail, head, state, proposed, registered, decided, reason, weight, T, scores], index) => {
      const loop = {index, tail, head, state: s[state], proposed: s[proposed], registered: s[registered], decided: s[decided],
        reason: s[reason], weight, T_tail_head: T, scores: []};
      for (let k = 0; k < scores.length; k += 2) loop.scores.push([s[scores[k]], scores[k + 1]]);
      return loop;
    });
  }

  /// T_tail_head by the robots' odometry, as registered (or null), and in the map.
  placements(loop) {
    const odometry = multiply(inverse(this.byOdometry(loop.tail)), this.byOdometry(loop.head));
    const map = multiply(inverse(this.fused(loop.tail)), this.fused(loop.head));
    return {odometry, registration: loop.T_tail_head, map};
  }

  /// How far a registration is from odometry and from the map: [m, degrees] each, or null.
  differences(loop) {
    const oneFrame = this.islandOf(loop.tail) === this.islandOf(loop.head), p = this.placements(loop);
    if (!oneFrame || !p.registration) return {before: null, after: null};
    return {before: distance(p.registration, p.odometry), after: distance(p.registration, p.map)};
  }
}
