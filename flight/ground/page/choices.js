/// What a person chose to see: robot, object, layers. One place, so that keys, buttons and pictures agree.

export const LAYERS = [
  {name: "path", key: "p", text: "way flown"},
  {name: "committed", key: "c", text: "committed way"},
  {name: "tour", key: "r", text: "tour that is left"},
  {name: "viewpoints", key: "v", text: "viewpoints, refused ones"},
  {name: "ground", key: "b", text: "ground planes"},
  {name: "prior", key: "m", text: "prior map (dashed)"},
  {name: "geofence", key: "g", text: "geofence"},
  {name: "occupancy", key: "o", text: "occupied cells nearby"},
  {name: "points", key: "l", text: "live points"},
  {name: "labels", key: "n", text: "names"},
];
const OFF_AT_FIRST = new Set(["occupancy", "points"]);

export class Choices {
  constructor() {
    this.robot = null;      // name
    this.object = null;     // {robot, id}
    this.layers = Object.fromEntries(LAYERS.map(({name}) => [name, !OFF_AT_FIRST.has(name)]));
    this.uncertainty = 0;   // place in uncertainty.js's SCALES
    this.merged = 0;        // 0: own maps … 1: the merged one
    this.follow = false;
    this.listeners = [];
  }

  on(listener) {
    this.listeners.push(listener);
  }

  set(what) {
    Object.assign(this, what);
    for (const listener of this.listeners) listener(what);
  }

  toggle(layer) {
    this.set({layers: {...this.layers, [layer]: !this.layers[layer]}});
  }
}
