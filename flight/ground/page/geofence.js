/// Where a robot may fly: the fence's lower and upper edge and its posts; and what was known before the flight, as outlines.

import {Lines} from "./lines.js";

export class GeofenceLayer {
  constructor(scene, group) {
    this.lines = new Lines(scene, group, {colour: "#a11d1d", width: 2, dashed: 1.5});
  }

  set(fence, shown) {
    if (!fence || !shown) return this.lines.setSegments([]);
    const {polygon, lowest_m, highest_m} = fence, numbers = [];
    polygon.forEach(([x, y], i) => {
      const [u, v] = polygon[(i + 1) % polygon.length];
      numbers.push(x, y, lowest_m, u, v, lowest_m, x, y, highest_m, u, v, highest_m, x, y, lowest_m, x, y, highest_m);
    });
    return this.lines.setSegments(numbers);
  }
}

const EDGES = [0, 1, 1, 3, 3, 2, 2, 0, 4, 5, 5, 7, 7, 6, 6, 4, 0, 4, 1, 5, 2, 6, 3, 7];

/// The prior map against what was mapped: dashed outlines.
export class PriorLayer {
  constructor(scene, group) {
    this.lines = new Lines(scene, group, {colour: "#374151", width: 1.4, dashed: 0.25});
  }

  set(objects, shown) {
    this.lines.setSegments((shown ? objects : []).flatMap(({position, size, heading_rad = 0}) => {
      const c = Math.cos(heading_rad), s = Math.sin(heading_rad), [l, w, h] = size ?? [4.5, 1.8, 1.5];
      const corner = k => {
        const u = (k & 1 ? l : -l) / 2, v = (k & 2 ? w : -w) / 2;
        return [position[0] + c * u - s * v, position[1] + s * u + c * v, position[2] + (k & 4 ? h : -h) / 2];
      };
      return EDGES.flatMap(corner);
    }));
  }
}
