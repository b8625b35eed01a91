/// One map out of the robots' maps, for looking at. Of an object that several robots have, the estimate that says the smallest standard
/// deviation of size stays: maps that were exchanged share measurements, so that weighting them would count those twice. Pure.

import {placeOf, sizeOf} from "./store.js";

const SAME_WITHIN_M = 1.5;  // as `saker map eval` compares two maps

/// `maps`: [{robot, objects, toMap}], where toMap takes an object's place to the common frame. Makes [{robot, object, robots}], best first seen.
export function mergeMaps(maps) {
  const merged = [], cells = new Map();
  const cellOf = (x, y) => `${Math.floor(x / SAME_WITHIN_M)},${Math.floor(y / SAME_WITHIN_M)}`;
  const note = entry => {
    const cell = cellOf(entry.place[0], entry.place[1]);
    cells.set(cell, [...(cells.get(cell) ?? []), entry]);
  };
  const about = ([x, y]) => [-1, 0, 1].flatMap(i => [-1, 0, 1].flatMap(j => cells.get(cellOf(x + i * SAME_WITHIN_M, y + j * SAME_WITHIN_M)) ?? []));
  for (const {robot, objects, toMap} of maps) {
    const before = merged.length;  // two objects of one robot are two
    for (const object of objects) {
      const place = toMap(placeOf(object));
      const entry = {robot, object, robots: [robot], place, sd: sizeOf(object)[2] ?? Infinity};
      const same = nearest(about(place).filter(other => other.index < before && !other.robots.includes(robot) && other.object.class === object.class), place);
      if (!same) {
        entry.index = merged.push(entry) - 1;
        note(entry);
      } else {
        same.robots.push(robot);
        if (entry.sd < same.sd) note(Object.assign(same, {robot, object, place, sd: entry.sd}));
      }
    }
  }
  return merged;
}

function nearest(entries, place) {
  let best = null, least = SAME_WITHIN_M;
  for (const entry of entries) {
    const distance = Math.hypot(entry.place[0] - place[0], entry.place[1] - place[1]);
    if (distance <= least) [best, least] = [entry, distance];
  }
  return best;
}
