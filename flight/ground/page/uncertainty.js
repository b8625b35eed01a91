/// How sure a map is: the 95 % ellipse of each object's place and 95 % whiskers of its size, on top of it, as large as they are or ten times.

import * as THREE from "three";
import {Batch} from "./batch.js";
import {ellipse95, whiskers95} from "./geometry.js";
import {matrixOf} from "./objects.js";
import {Lines} from "./lines.js";
import {placeOf} from "./store.js";

export const SCALES = [1, 10, 0];  // what the key goes through; 0: off
export const MOST = 1500;          // objects that get them, the nearest to what the camera looks at
const OVER_M = 0.06, CAP_M = 0.22;
const RIM = 0.88;                  // of the radius: outside of it the ellipse's dark rim
const LEAST_PX = 4;                // whiskers that the camera shows smaller than this are left out: they would be a dot
const LONGEST_M = 5;               // an object, about

// An ellipse is drawn into a square: four corners each, where a disc and a ring would have fifty.
function disc() {
  const material = new THREE.MeshBasicMaterial({color: "#f0e442", side: THREE.DoubleSide});
  material.onBeforeCompile = shader => {
    shader.vertexShader = shader.vertexShader.replace("#include <common>", "#include <common>\nvarying vec2 vDisc; attribute vec3 unitPlace;").replace("#include <begin_vertex>", "#include <begin_vertex>\nvDisc = unitPlace.xy;");
    shader.fragmentShader = shader.fragmentShader.replace("#include <common>", "#include <common>\nvarying vec2 vDisc;").replace("#include <color_fragment>", `#include <color_fragment>
      float away = dot(vDisc, vDisc);
      if (away > 1.0) discard;
      if (away > ${(RIM * RIM).toFixed(4)}) diffuseColor.rgb = vec3(0.067);`);
  };
  return material;
}

export class UncertaintyLayer {
  constructor(scene, group) {
    this.scene = scene;
    this.group = new THREE.Group();
    group.add(this.group);
    this.whiskers = new Lines(scene, this.group, {colour: "#111111", width: 1.8});
    this.ellipses = new Batch(this.group, new THREE.PlaneGeometry(2, 2), disc());
    this.count = 0;  // ellipses
  }

  set(objects, scale) {
    const few = scale > 0 ? this.#nearest(objects) : [];
    this.#setEllipses(few, scale);
    const seen = object => object.shape !== "cylinder" && this.#pixels(object, scale) >= LEAST_PX;
    this.whiskers.setSegments(few.flatMap(object => (seen(object) ? whiskerSegments(object, scale) : [])));
  }

  // How large the camera shows an object's whiskers, about, in the picture's own pixels.
  #pixels(object, scale) {
    const [x, y, z] = placeOf(object), {position, fov} = this.scene.camera;
    const away = Math.hypot(x - position.x, y - position.y, z - position.z);
    const sd = Math.max(...(object.sd?.size ?? [0]));
    return ((4 * sd * scale + CAP_M) / Math.max(away - LONGEST_M, 1)) * (this.scene.size?.height ?? 1) * this.scene.renderer.getPixelRatio() / (2 * Math.tan((fov * Math.PI) / 360));
  }

  #nearest(objects) {
    if (objects.length <= MOST) return objects;
    const {x, y} = this.scene.controls.target;
    const away = object => Math.hypot(placeOf(object)[0] - x, placeOf(object)[1] - y);
    return objects.map(object => [away(object), object]).sort(([a], [b]) => a - b).slice(0, MOST).map(([, object]) => object);
  }

  #setEllipses(objects, scale) {
    const ellipses = objects.flatMap(object => {
      const ellipse = ellipse95(object.place_covariance), [x, y] = placeOf(object);
      return ellipse ? [{x, y, z: topOf(object) + OVER_M, ...ellipse}] : [];
    });
    this.count = ellipses.length;
    const turn = new THREE.Quaternion(), up = new THREE.Vector3(0, 0, 1), matrix = new THREE.Matrix4(), place = new THREE.Vector3(), axes = new THREE.Vector3();
    const matrices = new Float32Array(16 * this.count);
    ellipses.forEach(({x, y, z, a, b, angle}, i) => {
      turn.setFromAxisAngle(up, angle);
      matrix.compose(place.set(x, y, z), turn, axes.set(a * scale, b * scale, 1)).toArray(matrices, 16 * i);
    });
    this.ellipses.set(matrices, null, this.count);
  }
}

function topOf(object) {
  return object.shape === "cylinder" ? object.root[2] + object.height : object.position[2] + object.size[2] / 2;
}

/// A line along the axis with a cap at its end, on the top face.
function whiskerSegments(object, scale) {
  const M = matrixOf(object).clone();
  const [length, width, height] = object.size;
  const local = (axis, along, across) => {
    const p = axis === 0 ? [along / length, across / width] : [across / length, along / width];
    return new THREE.Vector3(p[0], p[1], 0.5 + OVER_M / height).applyMatrix4(M).toArray();
  };
  return whiskers95(object.size, object.sd?.size, scale).flatMap(([axis, sign, near, far]) => [
    ...local(axis, sign * near, 0), ...local(axis, sign * far, 0),
    ...local(axis, sign * far, -CAP_M), ...local(axis, sign * far, CAP_M),
    ...local(axis, sign * near, -CAP_M / 2), ...local(axis, sign * near, CAP_M / 2),
  ]);
}
