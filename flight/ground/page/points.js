/// Live points of the newest scan, thinned by the server; coloured by height.

import * as THREE from "three";
import {pointsOf} from "./geometry.js";

const LOW = new THREE.Color("#8a5a00"), HIGH = new THREE.Color("#0b3d91");

export class PointsLayer {
  constructor(group) {
    this.geometry = new THREE.BufferGeometry();
    this.mesh = new THREE.Points(this.geometry, new THREE.PointsMaterial({size: 2.2, sizeAttenuation: false, vertexColors: true}));
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
    group.add(this.mesh);
  }

  set(cloud, shown) {
    this.mesh.visible = Boolean(cloud && shown);
    if (!this.mesh.visible) return;
    const points = pointsOf(cloud), colours = new Float32Array(points.length), colour = new THREE.Color();
    for (let i = 0; i < points.length; i += 3) {
      colour.lerpColors(LOW, HIGH, Math.min(1, Math.max(0, (points[i + 2] + 0.5) / 5))).toArray(colours, i);
    }
    this.geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
    this.geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  }
}
