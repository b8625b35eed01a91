/// A robot's way: flown so far, committed, and the tour that is left; all in the robot's own frames.

import {Lines} from "./lines.js";
import {placeOf} from "./store.js";

export class PathLayer {
  constructor(scene, odom, world, colour) {
    this.flown = new Lines(scene, odom, {colour, width: 3});
    this.committed = new Lines(scene, odom, {colour, width: 6});
    this.committed.material.opacity = 0.55;
    this.tour = new Lines(scene, world, {colour: "#374151", width: 2, dashed: 0.8});
  }

  setFlown(path, shown) {
    this.flown.setPoints(shown && path ? path.points : []);
  }

  setCommitted(trajectory, shown) {
    this.committed.setPoints(shown && trajectory ? trajectory.points : []);
  }

  /// From the vehicle over the targets in the order of the tour, on the height of their tops.
  setTour(plan, targetOf, from, shown) {
    const stops = (plan?.tour ?? []).map(targetOf).filter(Boolean);
    const over = object => {
      const [x, y, z] = placeOf(object);
      return [x, y, z + (object.height ?? object.size[2] / 2) + 0.3];
    };
    const points = stops.map(over);
    this.tour.setPoints(shown && points.length ? [...(from ? [from] : []), ...points] : []);
  }
}
