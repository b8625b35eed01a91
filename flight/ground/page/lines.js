/// Lines of a width in pixels, which WebGL's own lines do not have; where there are very many, WebGL's own.

import * as THREE from "three";
import {LineMaterial} from "three/lines/LineMaterial.js";
import {LineSegments2} from "three/lines/LineSegments2.js";
import {LineSegmentsGeometry} from "three/lines/LineSegmentsGeometry.js";

const MOST_WIDE = 4000;  // segments; each is a small mesh

export class Lines {
  constructor(scene, group, {colour, width, dashed = null}) {
    this.material = scene.useLine(new LineMaterial({color: new THREE.Color(colour), linewidth: width, transparent: true}));
    if (dashed) Object.assign(this.material, {dashed: true, dashSize: dashed, gapSize: dashed * 0.8});
    this.thin = new THREE.LineBasicMaterial({color: colour});
    Object.assign(this, {scene, group, mesh: null});
  }

  /// Segments: [x, y, z, x, y, z, …], two points each.
  setSegments(numbers) {
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.geometry.dispose();
      this.mesh = null;
    }
    if (numbers.length < 6) return;
    this.mesh = numbers.length / 6 > MOST_WIDE ? this.#thin(numbers) : this.#wide(numbers);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1;
    this.group.add(this.mesh);
  }

  #wide(numbers) {
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(numbers);
    const mesh = new LineSegments2(geometry, this.material);
    if (this.material.dashed) mesh.computeLineDistances();
    return mesh;
  }

  #thin(numbers) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(numbers, 3));
    return new THREE.LineSegments(geometry, this.thin);
  }

  /// A line through points [[x, y, z], …].
  setPoints(points) {
    const numbers = [];
    for (let i = 1; i < points.length; ++i) numbers.push(...points[i - 1], ...points[i]);
    this.setSegments(numbers);
  }
}
