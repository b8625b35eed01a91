/// How sure a map is: the 95 % ellipse of each object's place and 95 % whiskers of its size, on top of it, as large as they are or ten times.

import * as THREE from "three";
import {ellipse95, whiskers95} from "./geometry.js";
import {matrixOf} from "./objects.js";
import {Lines} from "./lines.js";
import {placeOf} from "./store.js";

export const SCALES = [1, 10, 0];  // what the key goes through; 0: off
const MOST = 1500;                 // objects that get them, the first ones of the map
const OVER_M = 0.06, CAP_M = 0.22;

export class UncertaintyLayer {
  constructor(scene, group) {
    this.group = new THREE.Group();
    group.add(this.group);
    this.whiskers = new Lines(scene, this.group, {colour: "#111111", width: 1.8});
    this.disc = new THREE.CircleGeometry(1, 28);
    this.material = new THREE.MeshBasicMaterial({color: "#f0e442", transparent: true, opacity: 0.85, depthWrite: false, side: THREE.DoubleSide});
    this.rims = new Lines(scene, this.group, {colour: "#111111", width: 1.6});
    this.shown = 0;
  }

  set(objects, scale) {
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
      this.mesh = null;
    }
    const few = scale > 0 ? objects.slice(0, MOST) : [];
    this.#setEllipses(few, scale);
    this.whiskers.setSegments(few.flatMap(object => (object.shape === "cylinder" ? [] : whiskerSegments(object, scale))));
    this.shown = few.length;
  }

  #setEllipses(objects, scale) {
    const all = objects.flatMap(object => {
      const ellipse = ellipse95(object.place_covariance);
      if (!ellipse) return [];
      const [x, y] = placeOf(object);
      return [{x, y, z: topOf(object) + OVER_M, a: ellipse.a * scale, b: ellipse.b * scale, angle: ellipse.angle}];
    });
    if (all.length) {
      this.mesh = new THREE.InstancedMesh(this.disc, this.material, all.length);
      const turn = new THREE.Quaternion(), up = new THREE.Vector3(0, 0, 1), matrix = new THREE.Matrix4();
      all.forEach(({x, y, z, a, b, angle}, i) => {
        turn.setFromAxisAngle(up, angle);
        this.mesh.setMatrixAt(i, matrix.compose(new THREE.Vector3(x, y, z), turn, new THREE.Vector3(a, b, 1)));
      });
      this.mesh.frustumCulled = false;
      this.group.add(this.mesh);
    }
    this.rims.setSegments(all.flatMap(rim));
  }
}

function topOf(object) {
  return object.shape === "cylinder" ? object.root[2] + object.height : object.position[2] + object.size[2] / 2;
}

function rim({x, y, z, a, b, angle}) {
  const numbers = [], c = Math.cos(angle), s = Math.sin(angle);
  const at = k => {
    const u = a * Math.cos((k * Math.PI) / 10), v = b * Math.sin((k * Math.PI) / 10);
    return [x + c * u - s * v, y + s * u + c * v, z + 0.005];
  };
  for (let k = 0; k < 20; ++k) numbers.push(...at(k), ...at(k + 1));
  return numbers;
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
