/// How sure a map is: the 95 % ellipse of each object's place and 95 % whiskers of its size, on top of it, as large as they are or ten times.

import * as THREE from "three";
import {ellipse95, whiskers95} from "./geometry.js";
import {matrixOf} from "./objects.js";
import {Lines} from "./lines.js";
import {placeOf} from "./store.js";

export const SCALES = [1, 10, 0];  // what the key goes through; 0: off
export const MOST = 1500;          // objects that get them, the nearest to what the camera looks at
const OVER_M = 0.06, RIM_OVER_M = 0.005, CAP_M = 0.22;

export class UncertaintyLayer {
  constructor(scene, group) {
    this.scene = scene;
    this.group = new THREE.Group();
    group.add(this.group);
    this.whiskers = new Lines(scene, this.group, {colour: "#111111", width: 1.8});
    const flat = colour => new THREE.MeshBasicMaterial({color: colour, side: THREE.DoubleSide});
    this.parts = [[new THREE.CircleGeometry(1, 16), flat("#f0e442"), 0], [new THREE.RingGeometry(0.88, 1, 16), flat("#111111"), RIM_OVER_M]];
    this.meshes = [];
    this.count = 0;  // ellipses
  }

  set(objects, scale) {
    for (const mesh of this.meshes) {
      this.group.remove(mesh);
      mesh.dispose();
    }
    const few = scale > 0 ? this.#nearest(objects) : [];
    this.#setEllipses(few, scale);
    this.whiskers.setSegments(few.flatMap(object => (object.shape === "cylinder" ? [] : whiskerSegments(object, scale))));
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
    if (!this.count) return;
    const turn = new THREE.Quaternion(), up = new THREE.Vector3(0, 0, 1), matrix = new THREE.Matrix4(), place = new THREE.Vector3(), axes = new THREE.Vector3();
    this.meshes = this.parts.map(([geometry, material, over]) => {
      const mesh = new THREE.InstancedMesh(geometry, material, this.count);
      ellipses.forEach(({x, y, z, a, b, angle}, i) => {
        turn.setFromAxisAngle(up, angle);
        mesh.setMatrixAt(i, matrix.compose(place.set(x, y, z + over), turn, axes.set(a * scale, b * scale, 1)));
      });
      mesh.frustumCulled = false;
      this.group.add(mesh);
      return mesh;
    });
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
