/// A made flight over a street of parked cars, trees and poles: the messages of every topic at any time, by flight/viewers/topics.md.
///
/// Pure: a function of time. s, m, rad; the vehicle circles each target at 3 m height; an object is in the map from the moment it is near, and
/// its standard deviation falls with every view.

const TAKEOFF_S = 3, TARGET_S = 6, RETURN_S = 6, LAND_S = 3, SEEN_WITHIN_M = 16, HEIGHT_M = 3;
const LIMITS = {battery_return_share: 0.3, battery_land_share: 0.15, land_after_s: 10, recover_s: 3};
const COLOURS = {vehicle: [0, 0.447, 0.698], trunk: [0, 0.62, 0.451], pole: [0.902, 0.624, 0]};

/// The same numbers every time (mulberry32).
function random(seed) {
  let a = seed;
  return () => {
    a = (a + 0x6d2b79f5) | 0;
    let t = Math.imul(a ^ (a >>> 15), 1 | a);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const round = (value, digits = 4) => Number(value.toFixed(digits));
const yawQuaternion = yaw => [0, 0, round(Math.sin(yaw / 2)), round(Math.cos(yaw / 2))];

function car(id, x, y, heading, rnd) {
  const size = [4 + rnd() * 1.1, 1.7 + rnd() * 0.25, 1.4 + rnd() * 0.35].map(v => round(v, 3));
  return {id, class: "vehicle", shape: "cuboid", x, y, heading, size};
}

/// `targets` cars beside a street along x, and trees and poles behind them; `more`: objects in all, the rest in rows beside.
function world({targets, more, seed}) {
  const rnd = random(seed), objects = [];
  for (let i = 0; i < targets; ++i) objects.push(car(objects.length, 5 + 6.2 * Math.floor(i / 2) + rnd(), i % 2 ? 4.2 : -4.2, (i % 2 ? Math.PI : 0) + (rnd() - 0.5) * 0.2, rnd));
  for (let i = 0; i < 2 * targets; ++i) {
    const trunk = i % 4 !== 3;
    objects.push({id: objects.length, class: trunk ? "trunk" : "pole", shape: "cylinder", x: 3 + 3.2 * Math.floor(i / 2) + rnd(), y: (i % 2 ? 8 : -8) + rnd() * 2, radius: round(trunk ? 0.14 + rnd() * 0.16 : 0.07, 3),
      height: round(trunk ? 2.5 + rnd() * 2 : 5, 2)});
  }
  while (objects.length < more) {
    const k = objects.length, row = Math.floor(k / 40);
    objects.push(car(k, (k % 40) * 6.5 - 100, 14 + row * 3.4, rnd() * 0.3, rnd));
  }
  return objects;
}

export class MadeRun {
  constructor({robot = "R1", targets = 8, more = 0, seed = 7, colour = [0.84, 0.37, 0], shift = [0, 0], all = false} = {}) {
    Object.assign(this, {robot, colour, shift, all});
    this.objects = world({targets, more, seed});
    this.targets = this.objects.slice(0, targets);
    this.tour_s = TAKEOFF_S + TARGET_S * targets;
    this.end_s = this.tour_s + RETURN_S + LAND_S + 2;
    this.holds = null;  // {since, phase}: an order
  }

  /// Where the vehicle is: {place, yaw, phase, at (target)}.
  at(t) {
    const over = i => [this.targets[i].x, this.targets[i].y];
    const side = i => [over(i)[0] - 1.5, over(i)[1] * 0.1];
    if (t < 0.5) return {place: [0, 0, 0.1], yaw: 0, phase: "preflight", at: -1};
    if (t < TAKEOFF_S) return {place: [0, 0, 0.1 + ((t - 0.5) / (TAKEOFF_S - 0.5)) * (HEIGHT_M - 0.1)], yaw: 0, phase: "takeoff", at: -1};
    if (t < this.tour_s) {
      const i = Math.min(this.targets.length - 1, Math.floor((t - TAKEOFF_S) / TARGET_S)), part = (t - TAKEOFF_S) / TARGET_S - i;
      const from = i ? side(i - 1) : [0, 0], to = side(i), s = part * part * (3 - 2 * part);
      const place = [from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1]) + Math.sin(part * Math.PI) * 0.8, HEIGHT_M + 0.2 * Math.sin(t)];
      return {place, yaw: Math.atan2(over(i)[1] - place[1], over(i)[0] - place[0]), phase: "tour", at: i};
    }
    const last = side(this.targets.length - 1), back = Math.min(1, (t - this.tour_s) / RETURN_S);
    const place = [last[0] * (1 - back), last[1] * (1 - back), HEIGHT_M];
    if (back < 1) return {place, yaw: Math.PI, phase: "return", at: this.targets.length};
    const down = Math.min(1, (t - this.tour_s - RETURN_S) / LAND_S);
    return {place: [0, 0, HEIGHT_M - down * (HEIGHT_M - 0.1)], yaw: Math.PI, phase: down < 1 ? "landing" : "done", at: this.targets.length};
  }

  #nearestBefore(object, t) {
    if (this.all) return {first: 0, views: 40 + (object.id % 30)};
    let first = null, views = 0;
    for (let s = 0; s <= t; s += 0.5) {
      const {place} = this.at(s);
      if (Math.hypot(place[0] - object.x, place[1] - object.y) > SEEN_WITHIN_M) continue;
      first ??= s;
      views += 1;
    }
    return {first, views};
  }

  #target(object, t) {
    const i = this.targets.indexOf(object), {at, phase} = this.at(t);
    if (i < 0) return undefined;
    const id = 100 + i;
    if (i < at || phase === "done") return {id, state: "done", reason: ""};
    if (i === at) return {id, state: "next", tour: 0, reason: ""};
    return i === this.targets.length - 1 && t > this.tour_s / 2 ? {id, state: "unreachable", reason: "no way there"} : {id, state: "planned", tour: i - Math.max(at, 0), reason: ""};
  }

  #object(object, t) {
    const {first, views} = this.#nearestBefore(object, t);
    if (first === null || views < 3) return null;
    const sd = round(0.14 / Math.sqrt(views)), sizeSd = [round(0.3 / Math.sqrt(views)), round(0.16 / Math.sqrt(views))];
    const wrong = 0.35 * Math.exp(-views / 12), c = Math.cos(object.heading ?? 0), s = Math.sin(object.heading ?? 0);
    const [a, b] = [4 * sd * sd, sd * sd];
    const common = {id: object.id, class: object.class, shape: object.shape, probability: round(1 - 0.3 / views, 3), observations: views, colour: COLOURS[object.class], heard_s: 0.4,
      place_covariance: [a * c * c + b * s * s, (a - b) * s * c, a * s * s + b * c * c].map(v => round(v, 7))};
    const target = this.#target(object, t);
    if (target) common.target = target;
    const [x, y] = [round(object.x + this.shift[0], 3), round(object.y + this.shift[1], 3)];
    if (object.shape === "cylinder") return {...common, root: [x, y, 0], axis: [0, 0, 1], radius: object.radius, height: object.height, sd: {position: [sd, sd], radius: round(0.02 / Math.sqrt(views))}};
    const size = [round(object.size[0] - wrong, 3), round(object.size[1] + wrong / 4, 3), object.size[2]];
    return {...common, position: [x, y, round(size[2] / 2, 3)], rotation: yawQuaternion(object.heading), size, heading_rad: object.heading, sd: {position: [2 * sd, sd], size: sizeSd}};
  }

  messages(t) {
    const r = this.robot, state = this.at(this.holds ? this.holds.since : t), phase = this.holds?.phase ?? state.phase, utime = Math.round(t * 1e6);
    const flying = !["preflight", "done"].includes(phase), speed = flying && !this.holds ? 1.1 : 0;
    const cycle = Math.floor(t);
    if (this.cycle !== cycle || this.cached.t > t) this.cached = {t, objects: this.objects.map(object => this.#object(object, t)).filter(Boolean)};
    this.cycle = cycle;
    const {objects} = this.cached;
    const world = `${r}/world`, odom = `${r}/odom`;
    return {
      state: {utime, armed: flying, mode: flying ? (this.holds ? "hold" : "guided") : "idle", attitude: yawQuaternion(state.yaw), height_m: round(state.place[2] - 0.1, 2), battery_share: round(0.92 - t * 0.004, 3), faults: []},
      odometry: {utime, frame: odom, position: state.place.map(v => round(v, 3)), orientation: yawQuaternion(state.yaw), velocity: [speed, 0, 0], speed_mps: speed, angular_velocity: [0, 0, 0.02], sd_m: [0.01, 0.01, 0.02],
        sd_rad: [0.001, 0.001, 0.002], status: "ok", reset_counter: 0},
      tf: {transforms: [["map", world], [world, odom]].map(([parent, child]) => ({timestamp: {sec: Math.floor(t), nsec: 0}, parent_frame_id: parent, child_frame_id: child, translation: {x: 0, y: 0, z: 0}, rotation: {x: 0, y: 0, z: 0, w: 1}}))},
      link: {age_s: 0.02, lost: false, channels: {STATE: 0.02, ODOMETRY: 0.01, OBJECTS: 0.4, MISSION: 0.6}, malformed: 0, message_rate_hz: 171},
      objects: {utime, frame: world, total: objects.length, objects, ground: this.#ground()},
      path: this.#path(this.holds ? this.holds.since : t),
      trajectory: this.#trajectory(t, utime),
      plan: this.#plan(state, utime),
      mission: this.#mission(t, phase, state.at, utime),
      health: this.#health(t, utime),
      verdict: {utime, trajectory_id: 16, clear: true, reason: "none", clear_for_s: 6.3, clearance_m: round(0.8 + 0.3 * Math.sin(t), 2)},
      site: {robot: r, colour: this.colour, geofence: {polygon: [[-12, -16], [60, -16], [60, 16], [-12, 16]], lowest_m: 0.8, highest_m: 8}, origin: {latitude_deg: 47.1, longitude_deg: 8.2, heading_deg: 90},
        prior: {objects: this.targets.map((o, i) => ({id: 100 + i, class: "vehicle", position: [o.x + 0.6, o.y - 0.4, 0.75], size: [4.5, 1.8, 1.5], heading_rad: 0}))},
        classes: Object.entries(COLOURS).map(([name, colour]) => ({name, shape: name === "vehicle" ? "cuboid" : "cylinder", target: name === "vehicle", colour})), limits: LIMITS},
      occupancy: this.#cloud(state.place, true),
      points: this.#cloud(state.place, false),
    };
  }

  #ground() {
    return Array.from({length: 10}, (_, i) => ({normal: [0, 0, 1], point: [i * 5, 0, -0.01], radius: 5.5}));
  }

  #path(t) {
    const t_s = [], points = [];
    for (let s = 0; s <= t; s += 0.4) {
      t_s.push(round(s, 1));
      points.push(this.at(s).place.map(v => round(v, 2)));
    }
    const length = points.slice(1).reduce((sum, p, i) => sum + Math.hypot(...p.map((v, k) => v - points[i][k])), 0);
    return {frame: `${this.robot}/odom`, t_s, points, length_m: round(length, 1)};
  }

  #trajectory(t, utime) {
    const points = this.holds ? [] : Array.from({length: 50}, (_, i) => this.at(t + i * 0.1).place.map(v => round(v, 2)));
    return {utime, frame: `${this.robot}/odom`, id: 16, start_utime: utime, step_s: 0.1, points, yaw_rad: points.map(() => 0), ...(points.length ? {end_s: 5} : {})};
  }

  #plan({at, phase}, utime) {
    const left = phase === "tour" ? this.targets.slice(at) : phase === "takeoff" ? this.targets : [];
    const about = left[0], ring = k => [about.x + 4.5 * Math.cos(k), about.y + 4.5 * Math.sin(k), HEIGHT_M].map(v => round(v, 2));
    const candidates = about ? Array.from({length: 9}, (_, i) => ({target_id: 100 + this.targets.indexOf(about), position: ring(i * 0.7), yaw_rad: round(i * 0.7 - Math.PI, 3), gain_nat: round(3 - Math.abs(i - 3) * 0.45, 2), path_m: round(3 + i, 1), chosen: i === 3})) : [];
    const refused = about ? Array.from({length: 5}, (_, i) => ({target_id: 100, position: ring(i * 0.7 + 0.35).map((v, k) => (k < 2 ? v * 1.03 : v)), reason: i % 2 ? "hidden" : "occupied"})) : [];
    return {utime, frame: `${this.robot}/world`, trajectory_id: 16, tour: left.map(o => 100 + this.targets.indexOf(o)), choice: candidates.length ? 3 : -1, reason: "", candidates, refused};
  }

  #mission(t, phase, at, utime) {
    const n = this.targets.length, target = Math.min(Math.max(at + 1, 0), n);
    const words = {
      preflight: ["the first scan", "it gives up after 30 s"], takeoff: ["its height of 3.0 m", "it lands after 20 s"], tour: ["nothing: it flies its tour", `it maps target ${target} of ${n} and goes on to the next`],
      return: ["nothing: it flies home", "it lands where it took off"], hold: ["an order to go on: it was told to hold", "it stays here until its battery is low, then it returns"], landing: ["touch-down", "the motors stop on the ground"], done: ["nothing", "nothing happens"],
    }[phase];
    return {utime, phase, target, targets: n, ...(t > 0.5 ? {elapsed_s: round(t - 0.5, 1)} : {}), cause: phase === "hold" ? "ordered" : "took_off", cause_code: phase === "hold" ? 36 : 31,
      text: phase === "hold" ? "ordered: hold, from the ground" : phase === "tour" ? "took_off: 3.0 m above where it stood" : phase === "done" ? "landed: at the place of take-off" : "", ladder: phase === "hold" ? "hold" : "none",
      waits_for: words[0], if_it_goes_on: words[1], gain_nat: round(Math.max(0, target - 1) * 2.6, 1)};
  }

  #health(t, utime) {
    const loop = (name, rate, median, extra = {}) => ({name, misses: 0, age_ms: round(1000 / (rate ?? 20) + 5 * Math.sin(t), 1), median_ms: round(median * (1 + 0.1 * Math.sin(t * 1.3)), 2), p95_ms: round(median * 1.7 * (1 + 0.15 * Math.cos(t)), 2), cpu: round(median / 100, 3),
      drops: 0, ...(rate ? {rate_hz: round(rate * (1 + 0.01 * Math.sin(3 * t)), 2), worst_lateness_ms: round(1.2 + t / 90, 2)} : {}), ...extra});
    return {utime, process: "saker-flight", loops: [loop("ingestion", null, 12), loop("segmentation", 2, 33), loop("slam", 2, 40), loop("planning", 1, 8, {misses: 1}), loop("guidance", 50, 0.2), loop("safety", 50, 0.1)], counters: {packets_dropped: 0, imu_dropped: 0}};
  }

  // Cells of a car's faces and the ground near by, as an occupancy block has them.
  #cloud([x, y], cells) {
    const near = this.objects.filter(o => Math.hypot(o.x - x, o.y - y) < 12), points = [];
    for (const o of near) {
      for (let u = 0; u < (o.size?.[0] ?? 0.3); u += 0.25) {
        for (let z = 0.1; z < (o.size?.[2] ?? o.height); z += 0.25) for (const side of [-1, 1]) points.push([o.x + u - (o.size?.[0] ?? 0.3) / 2, o.y + (side * (o.size?.[1] ?? 0.3)) / 2, z]);
      }
    }
    const data = Buffer.alloc(points.length * 12);
    points.forEach((p, i) => p.forEach((v, k) => data.writeFloatLE(v, i * 12 + k * 4)));
    return {timestamp: {sec: 0, nsec: 0}, frame_id: `${this.robot}/odom`, pose: {position: {x: 0, y: 0, z: 0}, orientation: {x: 0, y: 0, z: 0, w: 1}}, point_stride: 12,
      fields: ["x", "y", "z"].map((name, i) => ({name, offset: 4 * i, type: 7})), data: data.toString("base64"), ...(cells ? {resolution_m: 0.25} : {})};
  }
}
