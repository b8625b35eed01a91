/// The picture: every robot, the merged map, what is chosen. Reads the store and the choices; says what was clicked.

import {ofRobot} from "./colours.js";
import {Labels} from "./labels.js";
import {mergeMaps} from "./merge.js";
import {Highlight, ObjectLayer} from "./objects.js";
import {RobotView} from "./robot_view.js";
import {Scene} from "./scene.js";
import {placeOf} from "./store.js";
import {el, say} from "./dom.js";

const CLICK_PX = 5;

export class View {
  constructor({canvas, labels, scale, store, choices}) {
    Object.assign(this, {store, choices, scaleNode: scale});
    this.scene = new Scene(canvas);
    this.labels = new Labels(labels, this.scene);
    this.robots = new Map();
    this.merged = new ObjectLayer(this.scene.frame("merged"), undefined, this.scene.software);
    this.merged.setOpacity(0);
    this.mergedMap = [];
    this.highlight = new Highlight();
    this.framed = false;
    choices.on(what => this.#choose(what));
    this.#listen(canvas);
  }

  #listen(canvas) {
    let down = null;
    canvas.addEventListener("pointerdown", event => { down = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", event => {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < CLICK_PX) this.#click(event);
    });
    this.scene.controls.addEventListener("start", () => { this.touched = true; });
  }

  #click(event) {
    const caster = this.scene.rayAt(event.clientX, event.clientY);
    const hits = [...this.robots].flatMap(([robot, view]) => {
      const hit = view.objects.pick(caster);
      return hit ? [{...hit, robot}] : [];
    }).sort((a, b) => a.distance - b.distance);
    this.choices.set({object: hits[0] ? {robot: hits[0].robot, id: hits[0].id} : null});
  }

  /// Takes what changed in the store into the picture.
  update(changed) {
    if (!changed.size) return;
    if (changed.has("robots")) this.#meet();
    let objects = false;
    for (const topic of changed) {
      const [, name, kind] = topic.split("/");
      const view = this.robots.get(name);
      if (!view) continue;
      if (kind === "tf") this.scene.setTransforms(view.robot.newest.tf);
      else if (kind === "odometry") this.#follow(name, () => view.update(kind, this.choices));
      else if (view.update(kind, this.choices)) objects ||= kind === "objects";
      else continue;
      this.scene.invalidate();
    }
    if (objects) this.#objectsCame();
    this.#label();
  }

  #objectsCame() {
    this.#merge();
    this.#mark();
    const floors = [...this.robots.values()].map(({floor_m}) => floor_m).filter(v => v !== undefined);
    if (floors.length) this.scene.setFloor(Math.min(...floors));
    if (!this.framed) {
      this.framed = true;
      this.showAll(Scene.OBLIQUE);
    }
  }

  #meet() {
    this.store.names().forEach((name, index) => {
      if (this.robots.has(name)) return;
      this.robots.set(name, new RobotView(this.scene, this.store.robots.get(name), ofRobot(index)));
    });
  }

  #follow(name, move) {
    const view = this.robots.get(name), before = view.vehicle.place?.clone();
    move();
    if (this.choices.follow && this.choices.robot === name && before) this.scene.moveBy(view.vehicle.place.clone().sub(before));
  }

  #choose(what) {
    if (what.layers || what.uncertainty !== undefined) for (const view of this.robots.values()) view.updateAll(this.choices);
    if (what.merged !== undefined) this.#merge();
    if (what.object !== undefined || what.layers) this.#mark();
    if (what.follow && this.choices.robot) {
      const place = this.robots.get(this.choices.robot)?.vehicle.place;
      if (place) this.scene.lookAt(place, {distance: 22});
    }
    this.#label();
    this.scene.invalidate();
  }

  #merge() {
    const part = this.choices.merged;
    for (const view of this.robots.values()) {
      view.objects.setOpacity(1 - part);
    }
    if (part > 0) {
      this.mergedMap = mergeMaps([...this.robots].map(([robot, view]) => ({robot, objects: view.list(), toMap: place => this.scene.toMap(`${robot}/world`, place).toArray()})));
      const moved = this.mergedMap.map(({object, robot, place}) => ({...object, ...(object.shape === "cylinder" ? {root: place} : {position: place}), robot}));
      this.merged.set(moved);
    }
    this.merged.setOpacity(part);
  }

  #mark() {
    const chosen = this.choices.object, view = chosen && this.robots.get(chosen.robot);
    this.highlight.set(view?.world, view?.robot.objects.get(chosen.id));
    this.scene.invalidate();
  }

  #label() {
    const labels = [...this.robots.values()].flatMap(view => view.labels(this.choices));
    const chosen = this.choices.object, object = chosen && this.store.robots.get(chosen.robot)?.objects.get(chosen.id);
    if (object) {
      const [x, y, z] = placeOf(object);
      labels.push({point: this.scene.toMap(`${chosen.robot}/world`, [x, y, z + (object.height ?? object.size[2] / 2) + 0.7]), text: `${object.class} ${object.id}`, kind: "chosen"});
    }
    this.labels.set(labels);
  }

  /// Goes to an object and marks it.
  goTo(robot, id) {
    const object = this.store.robots.get(robot)?.objects.get(id);
    if (!object) return;
    this.choices.set({object: {robot, id}, follow: false});
    this.scene.lookAt(this.scene.toMap(`${robot}/world`, placeOf(object)), {distance: object.shape === "cylinder" ? 12 : 16});
  }

  showAll(from) {
    this.choices.set({follow: false});
    this.scene.showAll([...this.robots.values()].flatMap(view => view.extent()), from);
  }

  fromAbove() {
    this.showAll(Scene.TOP);
  }

  draw(now_ms) {
    if (!this.scene.draw(now_ms)) return;
    this.labels.place();
    const {length_m, pixels} = this.scene.scale(120);
    this.scaleNode.style.width = `${pixels.toFixed(0)}px`;
    say(this.scaleNode, `${length_m} m`);
  }
}

/// The classes' colours and marks, for the corner of the picture.
export function legend(node, classes) {
  node.replaceChildren(...classes.map(({name, glyph, colour}) => {
    const mark = el("b", {"aria-hidden": "true"}, glyph);
    mark.style.color = colour;
    return el("span", {}, mark, ` ${name}`);
  }));
}
