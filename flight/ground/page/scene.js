/// The 3D view: camera, light, floor, and a group for each frame. Draws only when something changed.
///
/// Frames: `map` is the scene itself, z up; `frame("R1/world")` is moved by the newest /R1/tf. Layers (objects.js, path.js, …) put their
/// meshes into these groups.

import * as THREE from "three";
import {OrbitControls} from "three/controls";
import {roundLength} from "./geometry.js";

const SLOW_MS = 60, MEASURED = 3;      // mean time of so many pictures, above which they get coarser
const IDLE_SHARE = 0.3;                // of a picture's time, in which none is drawn: words and orders come first
const SHOWN = 0, HELD_BACK = 1;        // layers; the camera sees the first
const GRID_M = 300, GRID_STEP_M = 10;
const COARSENESS = [1, 0.75, 0.5];     // of the screen's pixels, from the finest

/// Whether WebGL is computed by the processor: then edges are not smoothed.
function bySoftware() {
  const gl = document.createElement("canvas").getContext("webgl2"), names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = names ? gl.getParameter(names.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    const software = this.software = bySoftware();
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: !software, powerPreference: "low-power"});
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color("#eef1f4");
    this.camera = new THREE.PerspectiveCamera(45, 1, 0.2, 4000);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-28, -34, 34);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.screenSpacePanning = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.invalidate());
    this.frames = new Map();
    this.lineMaterials = new Set();
    this.drawn = 0;  // frames so far
    this.warm = new WeakSet();  // materials that were drawn
    this.times = [];
    this.coarse = software ? 1 : 0;
    this.idleUntil_ms = 0;
    this.#light();
    this.#floor();
    new ResizeObserver(() => this.#fit()).observe(canvas.parentElement);
    this.#fit();
  }

  #light() {
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#b8b2a6", 2.1));
    const sun = new THREE.DirectionalLight("#ffffff", 1.4);
    sun.position.set(-0.4, 0.7, 1.2);
    this.scene.add(sun);
  }

  #floor() {
    const numbers = [];
    for (let k = -GRID_M; k <= GRID_M; k += GRID_STEP_M) {
      // In pieces: WebGL by software loses a line that begins behind the camera.
      for (let l = -GRID_M; l < GRID_M; l += GRID_STEP_M) numbers.push(k, l, 0, k, l + GRID_STEP_M, 0, l, k, 0, l + GRID_STEP_M, k, 0);
    }
    const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(numbers, 3));
    this.floor = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({color: "#b4bec8"}));
    this.floor.position.z = -0.05;
    this.scene.add(this.floor);
  }

  /// The ground under what is mapped, m: the grid lies there.
  setFloor(z) {
    if (Math.abs(this.floor.position.z - (z - 0.05)) < 0.1) return;
    this.floor.position.z = z - 0.05;
    this.invalidate();
  }

  #fit() {
    const {clientWidth: width, clientHeight: height} = this.canvas.parentElement;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2) * COARSENESS[this.coarse]);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    for (const material of this.lineMaterials) material.resolution.set(width, height);
    this.size = {width, height};
    this.invalidate();
  }

  /// Wide lines need the size of the picture.
  useLine(material) {
    this.lineMaterials.add(material);
    material.resolution.set(this.size?.width ?? 1, this.size?.height ?? 1);
    return material;
  }

  /// The group of a frame; made on first use, in `map` until its transform is known.
  frame(name) {
    if (!this.frames.has(name)) {
      const group = new THREE.Group();
      group.name = name;
      this.frames.set(name, group);
      this.scene.add(group);
    }
    return this.frames.get(name);
  }

  /// A foxglove.FrameTransforms.
  setTransforms({transforms}) {
    for (const {parent_frame_id: parent, child_frame_id: child, translation: t, rotation: q} of transforms) {
      const group = this.frame(child), above = parent === "map" ? this.scene : this.frame(parent);
      if (group.parent !== above) above.add(group);
      group.position.set(t.x, t.y, t.z);
      group.quaternion.set(q.x, q.y, q.z, q.w);
    }
    this.invalidate();
  }

  /// A point of a frame in `map`.
  toMap(frameName, point) {
    const group = this.frame(frameName);
    group.updateWorldMatrix(true, false);
    return new THREE.Vector3(...point).applyMatrix4(group.matrixWorld);
  }

  invalidate() {
    this.dirty = true;
  }

  /// Draws if something changed; says whether it did.
  draw(now_ms) {
    if (!this.#ready(now_ms)) return false;
    this.#glide(now_ms);
    if (!this.dirty) return false;
    if (this.#tooSlow()) this.#coarser();
    this.dirty = false;
    const later = this.#holdBack();
    this.renderer.render(this.scene, this.camera);
    for (const object of later) object.layers.set(SHOWN);
    if (later.length) this.invalidate();
    const gl = this.renderer.getContext();
    this.fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.flush();
    this.begun_ms = now_ms;
    this.drawn += 1;
    return true;
  }

  // A material's shader is compiled when it is first drawn, which takes WebGL by software a quarter of a second: one more a picture, the
  // vehicle's first. What is left out meanwhile.
  #holdBack() {
    const cold = [];
    this.scene.traverseVisible(object => object.material && !this.warm.has(object.material) && cold.push(object));
    const first = cold.filter(object => object.userData.first);
    for (const {material} of first.length ? first : cold.slice(0, 1)) this.warm.add(material);
    const later = cold.filter(({material}) => !this.warm.has(material));
    for (const object of later) object.layers.set(HELD_BACK);
    return later;
  }

  // Whether the last picture is done, and some time has passed since: pictures never queue up before what comes next.
  #ready(now_ms) {
    if (this.fence) {
      const gl = this.renderer.getContext();
      if (gl.getSyncParameter(this.fence, gl.SYNC_STATUS) !== gl.SIGNALED && !gl.isContextLost()) return false;
      gl.deleteSync(this.fence);
      this.fence = null;
      const took_ms = now_ms - this.begun_ms;
      this.times.push(took_ms);
      this.idleUntil_ms = took_ms > SLOW_MS ? now_ms + IDLE_SHARE * took_ms : 0;
    }
    return now_ms >= this.idleUntil_ms;
  }

  // A slow machine gets fewer pixels, never a slower instrument.
  #tooSlow() {
    if (this.times.length < MEASURED) return false;
    const mean = this.times.reduce((a, b) => a + b) / this.times.length;
    this.times = [];
    return mean > SLOW_MS && this.coarse + 1 < COARSENESS.length;
  }

  #coarser() {
    this.coarse += 1;
    this.#fit();
  }

  /// Moves the camera there within a third of a second; `distance` m, or as it is.
  lookAt(target, {distance, from} = {}) {
    const direction = from ?? this.camera.position.clone().sub(this.controls.target).normalize();
    const away = distance ?? this.camera.position.distanceTo(this.controls.target);
    this.gliding = {begin: null, fromTarget: this.controls.target.clone(), fromPlace: this.camera.position.clone(), target: target.clone(), place: target.clone().addScaledVector(direction, away)};
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.gliding.begin = -1e9;
  }

  #glide(now_ms) {
    if (!this.gliding) return;
    this.gliding.begin ??= now_ms;
    const part = Math.min(1, (now_ms - this.gliding.begin) / 330), smooth = part * part * (3 - 2 * part);
    this.controls.target.lerpVectors(this.gliding.fromTarget, this.gliding.target, smooth);
    this.camera.position.lerpVectors(this.gliding.fromPlace, this.gliding.place, smooth);
    this.controls.update();
    this.invalidate();
    if (part === 1) this.gliding = null;
  }

  /// All of these points of `map` in view, from the direction given or as it is.
  showAll(points, from) {
    if (!points.length) return;
    const sphere = new THREE.Box3().setFromPoints(points).getBoundingSphere(new THREE.Sphere());
    const narrow = Math.min(1, this.camera.aspect);
    this.lookAt(sphere.center, {distance: Math.max(12, (sphere.radius * 1.08) / (Math.sin((this.camera.fov * Math.PI) / 360) * narrow)), from});
  }

  static TOP = new THREE.Vector3(0, -0.001, 1).normalize();
  static OBLIQUE = new THREE.Vector3(-0.45, -0.62, 0.64).normalize();

  /// The camera follows a point: it moves by as much as that does.
  moveBy(difference) {
    if (this.gliding) return;
    this.controls.target.add(difference);
    this.camera.position.add(difference);
    this.controls.update();
    this.invalidate();
  }

  /// Where a point of `map` lies on the canvas, CSS pixels; null behind the camera.
  toScreen(point) {
    const p = point.clone().project(this.camera);
    if (p.z > 1 || Math.abs(p.x) > 1.1 || Math.abs(p.y) > 1.1) return null;
    return [((p.x + 1) / 2) * this.size.width, ((1 - p.y) / 2) * this.size.height];
  }

  rayAt(clientX, clientY) {
    const box = this.canvas.getBoundingClientRect();
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2), this.camera);
    return caster;
  }

  /// A scale bar for what the camera looks at: {length_m, pixels}, at most `most` pixels.
  scale(most) {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const metres = (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.size.height;  // a pixel
    const length_m = roundLength(metres * most);
    return {length_m, pixels: length_m / metres};
  }
}
