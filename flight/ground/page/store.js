/// What is known of each robot now, and the short past that the plots show.
///
/// Reads messages by topic ("/R1/objects": flight/viewers/topics.md); makes `robots`, a map of Robot by name, and `changed`, the topics
/// that came since they were last taken. Frames and units are the messages'. Draws nothing, reads no clock but the one it is given.

export const KEPT = 240;           // samples of a plot
const BACK_S = 0.5;                // a message so much older than the last one: somebody went back in a run
const SAME_S = 1e-3;               // of two clocks' last digits
const WHOLE_RUN = new Set(["site", "tf", "figures"]);
const LEAST_CHANGE_M = 0.0005;     // of a size, that its history notes

/// A ring of the newest samples, oldest first.
export class Series {
  constructor(most = KEPT) {
    this.most = most;
    this.samples = [];
  }

  add(t_s, ...values) {
    const last = this.samples.at(-1);
    if (last && t_s < last[0] - BACK_S) this.samples = this.samples.filter(([t]) => t < t_s);
    this.samples.push([t_s, ...values]);
    if (this.samples.length > this.most) this.samples.shift();
  }

  cut(t_s) {
    this.samples = this.samples.filter(([t]) => t <= t_s);
  }

  /// Samples that came in another way, older than ours, put before them.
  seed(samples) {
    const first = this.samples[0]?.[0] ?? Infinity;
    this.samples = [...samples.filter(([t]) => t < first), ...this.samples].slice(-this.most);
  }
}

/// Length and width of a cuboid, diameter of a cylinder, each with its standard deviation: [l, w, sd of l, sd of w], m.
export function sizeOf(object) {
  if (object.shape !== "cylinder") return [object.size[0], object.size[1], object.sd?.size?.[0] ?? null, object.sd?.size?.[1] ?? null];
  const sd = object.sd?.radius ?? null;
  return [2 * object.radius, 2 * object.radius, sd === null ? null : 2 * sd, sd === null ? null : 2 * sd];
}

/// Centre of a cuboid, root of a cylinder.
export const placeOf = object => object.position ?? object.root;

export class Robot {
  constructor(name) {
    this.name = name;
    this.newest = {};           // message by the topic's last word
    this.heard_ms = {};         // when it came, by our clock
    this.said_s = {};           // its own time
    this.objects = new Map();   // by id
    this.targets = new Map();   // objects by the id of the target that the tour means
    this.sizes = new Map();     // Series by id
    this.loops = new Map();     // Series [rate, age, worst lateness, p95] by "process/loop"
    this.processes = new Map(); // newest health by process
    this.battery = new Series();
    this.height = new Series();
    this.link = new Series();
    this.log = [];
    this.orders = new Map();    // by id
  }

  take(kind, message, t_s, now_ms) {
    this.newest[kind] = message;
    this.heard_ms[kind] = now_ms;
    this.said_s[kind] = t_s;
    const taker = `take_${kind}`;
    if (taker in this) this[taker](message, t_s);
  }

  take_objects({objects}, t_s) {
    this.objects = new Map(objects.map(object => [object.id, object]));
    this.targets = new Map(objects.filter(({target}) => target).map(object => [object.target.id, object]));
    for (const object of objects) {
      const size = sizeOf(object);
      let series = this.sizes.get(object.id);
      if (!series) this.sizes.set(object.id, series = new Series());
      const last = series.samples.at(-1);
      const moved = !last || t_s < last[0] || size.some((v, i) => Math.abs((v ?? 0) - (last[i + 1] ?? 0)) > LEAST_CHANGE_M);
      if (moved) series.add(t_s, ...size);
    }
  }

  /// What the tour and the viewpoints mean by a target's id: the object that was mapped there, else that of the prior map; undefined: neither.
  target(id) {
    return this.targets.get(id) ?? this.newest.site?.prior?.objects?.find(object => object.id === id);
  }

  take_state({battery_share, height_m}, t_s) {
    this.battery.add(t_s, battery_share === undefined ? null : battery_share * 100);
    this.height.add(t_s, height_m ?? null);
  }

  take_link({age_s}, t_s) {
    this.link.add(t_s, age_s ?? null);
  }

  take_health(health, t_s) {
    this.processes.set(health.process, health);
    for (const loop of health.loops) {
      const key = `${health.process}/${loop.name}`;
      if (!this.loops.has(key)) this.loops.set(key, new Series());
      this.loops.get(key).add(t_s, loop.rate_hz ?? null, loop.age_ms ?? null, loop.worst_lateness_ms ?? null, loop.p95_ms ?? null);
    }
  }

  take_log(entry, t_s) {
    if (this.log.length && t_s < this.log.at(-1).t_s - BACK_S) this.log = this.log.filter(other => other.t_s < t_s);
    if (this.log.some(other => other.t_s === t_s && other.message === entry.message)) return;  // said again after a jump
    this.log.push({...entry, t_s});
    if (this.log.length > 200) this.log.shift();
  }

  take_orders(order) {
    this.orders.set(order.id, order);
  }

  /// What came after `t_s`, when somebody goes back in a run: the kinds that are not known any more. What holds for the whole run stays.
  forgetAfter(t_s) {
    const gone = Object.keys(this.newest).filter(kind => !WHOLE_RUN.has(kind) && this.said_s[kind] > t_s + SAME_S);
    for (const kind of gone) delete this.newest[kind];
    if (gone.includes("objects")) for (const map of [this.objects, this.targets]) map.clear();
    if (gone.includes("health")) this.processes.clear();
    for (const series of [this.battery, this.height, this.link, ...this.sizes.values(), ...this.loops.values()]) series.cut(t_s + SAME_S);
    this.log = this.log.filter(entry => entry.t_s <= t_s + SAME_S);
    return gone;
  }

  /// Sizes of one object over time, from whole maps of the past: [{t_s, message}].
  seedSizes(id, messages) {
    const samples = messages.flatMap(({t_s, message}) => {
      const object = message.objects.find(other => other.id === id);
      return object ? [[t_s, ...sizeOf(object)]] : [];
    });
    this.sizes.get(id)?.seed(samples);
  }
}

export class Store {
  constructor(now = () => performance.now()) {
    this.now = now;
    this.robots = new Map();
    this.changed = new Set();  // topics
    this.playback = null;      // of a finished run
    this.played_s = -Infinity; // its time when it was said last
    this.time_s = null;        // of the newest message
    this.base = null;          // what the base station holds of each robot
  }

  /// Robots in the order of their names, so that each keeps its colour.
  names() {
    return [...this.robots.keys()].sort((a, b) => a.localeCompare(b, "en", {numeric: true}));
  }

  /// A robot is known from the moment that its channels are advertised.
  know(topic) {
    const [, name, kind] = topic.split("/");
    if (!kind) return null;
    if (!this.robots.has(name)) {
      this.robots.set(name, new Robot(name));
      this.changed.add("robots");
    }
    return this.robots.get(name);
  }

  take(topic, message, time_s) {
    this.changed.add(topic);
    this.time_s = time_s;
    if (topic === "/playback") this.#play(message);
    else if (topic === "/store") this.base = message;
    else this.know(topic)?.take(topic.split("/")[2], message, time_s, this.now());
  }

  // The answer of `seek` comes before this message: what is compared is what came this way.
  #play(playback) {
    if (playback.t_s < this.played_s) {
      for (const robot of this.robots.values()) for (const kind of robot.forgetAfter(playback.t_s)) this.changed.add(`/${robot.name}/${kind}`);
    }
    this.playback = playback;
    this.played_s = playback.t_s;
  }

  /// Seconds since a robot's newest message of that kind; null: none yet.
  age_s(name, kind) {
    const heard = this.robots.get(name)?.heard_ms[kind];
    return heard === undefined ? null : (this.now() - heard) / 1000;
  }

  /// What changed since the last call.
  takeChanges() {
    const changed = this.changed;
    this.changed = new Set();
    return changed;
  }
}
