/// Viewpoints that the planner weighed: an arrowhead at each, darker with more gain; the chosen one large; crosses where one was refused.

import * as THREE from "three";
import {Lines} from "./lines.js";

const LIGHT = new THREE.Color("#e6d0e0"), DARK = new THREE.Color("#5b1a52");
const LENGTH_M = 0.7, CHOSEN = 1.9;

export class ViewpointLayer {
  constructor(scene, group) {
    this.group = new THREE.Group();
    group.add(this.group);
    this.cone = new THREE.ConeGeometry(0.42, 1, 4).rotateZ(-Math.PI / 2).scale(LENGTH_M, LENGTH_M, LENGTH_M * 0.35);
    this.material = new THREE.MeshLambertMaterial();
    this.crosses = new Lines(scene, this.group, {colour: "#4b5563", width: 1.6});
    this.sight = new Lines(scene, this.group, {colour: "#5b1a52", width: 2, dashed: 0.35});
  }

  /// `targetPlace(id)`: where a target stands, or null.
  set(plan, shown, targetPlace) {
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
      this.mesh = null;
    }
    const candidates = shown ? (plan?.candidates ?? []) : [];
    this.#setArrows(candidates);
    this.crosses.setSegments(shown ? (plan?.refused ?? []).flatMap(({position: [x, y, z]}) => {
      const r = 0.22;
      return [x - r, y - r, z, x + r, y + r, z, x - r, y + r, z, x + r, y - r, z];
    }) : []);
    const chosen = candidates.find(candidate => candidate.chosen), seen = chosen && targetPlace(chosen.target_id);
    this.sight.setPoints(seen ? [chosen.position, seen] : []);
  }

  #setArrows(candidates) {
    if (!candidates.length) return;
    const most = Math.max(...candidates.map(({gain_nat}) => gain_nat ?? 0), 1e-9);
    this.mesh = new THREE.InstancedMesh(this.cone, this.material, candidates.length);
    const turn = new THREE.Quaternion(), up = new THREE.Vector3(0, 0, 1), matrix = new THREE.Matrix4(), colour = new THREE.Color();
    candidates.forEach(({position, yaw_rad, gain_nat, chosen}, i) => {
      const k = chosen ? CHOSEN : 1;
      turn.setFromAxisAngle(up, yaw_rad);
      this.mesh.setMatrixAt(i, matrix.compose(new THREE.Vector3(...position), turn, new THREE.Vector3(k, k, k)));
      this.mesh.setColorAt(i, colour.lerpColors(LIGHT, DARK, (gain_nat ?? 0) / most));
    });
    this.mesh.frustumCulled = false;
    this.group.add(this.mesh);
  }
}
