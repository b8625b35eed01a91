/// One robot in the picture: its layers, and which of them a message changes.

import * as THREE from "three";
import {GeofenceLayer, PriorLayer} from "./geofence.js";
import {ObjectLayer} from "./objects.js";
import {OccupancyLayer} from "./occupancy.js";
import {PathLayer} from "./path.js";
import {PointsLayer} from "./points.js";
import {placeOf} from "./store.js";
import {SCALES, UncertaintyLayer} from "./uncertainty.js";
import {VehicleLayer} from "./vehicle.js";
import {ViewpointLayer} from "./viewpoints.js";

const LABELLED = 60;  // places in the tour, of all targets
const LARGE = 200;    // objects

export class RobotView {
  constructor(scene, robot, colour) {
    Object.assign(this, {scene, robot, colour});
    const world = scene.frame(`${robot.name}/world`), odom = scene.frame(`${robot.name}/odom`);
    if (odom.parent !== world) world.add(odom);
    this.world = world;
    this.own = new THREE.Group();  // its own map, faded against the merged one
    world.add(this.own);
    this.objects = new ObjectLayer(this.own, world, scene.software);
    this.uncertainty = new UncertaintyLayer(scene, this.own);
    this.prior = new PriorLayer(scene, world);
    this.geofence = new GeofenceLayer(scene, world);
    this.viewpoints = new ViewpointLayer(scene, world);
    this.path = new PathLayer(scene, odom, world, colour);
    this.occupancy = new OccupancyLayer(odom, scene.software);
    this.points = new PointsLayer(odom);
    this.vehicle = new VehicleLayer(odom, colour);
  }

  list() {
    return [...this.robot.objects.values()];
  }

  /// Draws anew what depends on a message of this kind; `chosen`: the person's choices.
  update(kind, chosen) {
    const {newest} = this.robot, {layers} = chosen;
    const target = id => this.robot.target(id), place = id => (target(id) ? placeOf(target(id)) : null);
    switch (kind) {
      case "objects":
        this.objects.set(this.list(), layers.ground ? (newest.objects?.ground ?? []) : []);
        this.#setUncertainty(SCALES[chosen.uncertainty]);
        this.path.setTour(newest.plan, target, newest.odometry?.position, layers.tour);
        break;
      case "odometry":
        if (newest.odometry) this.vehicle.set(newest.odometry, this.floor_m ?? 0);
        this.path.setTour(newest.plan, target, newest.odometry?.position, layers.tour);
        break;
      case "path": this.path.setFlown(newest.path, layers.path); break;
      case "trajectory": this.path.setCommitted(newest.trajectory, layers.committed); break;
      case "plan":
        this.viewpoints.set(newest.plan, layers.viewpoints, place);
        this.path.setTour(newest.plan, target, newest.odometry?.position, layers.tour);
        break;
      case "site":
        this.geofence.set(newest.site?.geofence, layers.geofence);
        this.prior.set(newest.site?.prior?.objects ?? [], layers.prior);
        break;
      case "occupancy": this.occupancy.set(newest.occupancy, layers.occupancy); break;
      case "points": this.points.set(newest.points, layers.points); break;
      default: return false;
    }
    return true;
  }

  // Of a large map no more often than once a second: it changes slowly, and costs more than the objects.
  #setUncertainty(scale) {
    const objects = this.list(), now_ms = performance.now();
    if (scale === this.scale && objects.length > LARGE && now_ms - this.uncertain_ms < 1000) return;
    [this.scale, this.uncertain_ms] = [scale, now_ms];
    this.uncertainty.set(objects, scale);
    this.floor_m = this.#floor();
  }

  updateAll(chosen) {
    for (const kind of ["objects", "odometry", "path", "trajectory", "plan", "site", "occupancy", "points"]) this.update(kind, chosen);
  }

  // The height of the ground, of where objects stand: what the plumb line ends at.
  #floor() {
    const bottoms = this.list().map(o => (o.shape === "cylinder" ? o.root[2] : o.position[2] - o.size[2] / 2)).sort((a, b) => a - b);
    return bottoms.length ? bottoms[Math.floor(bottoms.length / 2)] : 0;
  }

  /// Points of `map` that a picture of all of it should show.
  extent() {
    const name = `${this.robot.name}/world`;
    const points = this.list().map(object => this.scene.toMap(name, placeOf(object)));
    for (const point of this.robot.newest.path?.points ?? []) points.push(this.scene.toMap(`${this.robot.name}/odom`, point));
    if (this.vehicle.place) points.push(this.vehicle.place);
    return points;
  }

  labels(chosen) {
    const labels = [], {newest} = this.robot;
    if (this.vehicle.place) labels.push({point: this.vehicle.place.clone().add(new THREE.Vector3(0, 0, 0.9)), text: this.robot.name, kind: "robot", colour: this.colour});
    if (!chosen.layers.labels || chosen.robot !== this.robot.name) return labels;
    const world = `${this.robot.name}/world`;
    const tour = newest.plan?.tour ?? [];
    if (chosen.layers.tour) {
      tour.slice(0, LABELLED).forEach((id, i) => {
        const object = this.robot.target(id);
        if (!object) return;
        const [x, y, z] = placeOf(object);
        labels.push({point: this.scene.toMap(world, [x, y, z + (object.height ?? object.size[2] / 2) + 0.3]), text: String(i + 1), kind: "stop"});
      });
    }
    const best = chosen.layers.viewpoints && newest.plan?.candidates?.find(candidate => candidate.chosen);
    if (best?.gain_nat !== undefined) labels.push({point: this.scene.toMap(world, best.position), text: `${best.gain_nat.toFixed(1)} nat`, kind: "gain"});
    return labels;
  }
}
