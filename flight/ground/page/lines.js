/// Lines of a width in pixels, which WebGL's own lines do not have.

import * as THREE from "three";
import {LineMaterial} from "three/lines/LineMaterial.js";
import {LineSegments2} from "three/lines/LineSegments2.js";
import {LineSegmentsGeometry} from "three/lines/LineSegmentsGeometry.js";

export class Lines {
  constructor(scene, group, {colour, width, dashed = null, onTop = false}) {
    this.material = scene.useLine(new LineMaterial({color: new THREE.Color(colour), linewidth: width, transparent: true, depthTest: !onTop}));
    if (dashed) Object.assign(this.material, {dashed: true, dashSize: dashed, gapSize: dashed * 0.8});
    Object.assign(this, {scene, group, mesh: null, onTop});
  }

  /// Segments: [x, y, z, x, y, z, …], two points each.
  setSegments(numbers) {
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.geometry.dispose();
      this.mesh = null;
    }
    if (numbers.length < 6) return;
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(numbers);
    this.mesh = new LineSegments2(geometry, this.material);
    if (this.material.dashed) this.mesh.computeLineDistances();
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = this.onTop ? 3 : 1;
    this.group.add(this.mesh);
  }

  /// A line through points [[x, y, z], …].
  setPoints(points) {
    const numbers = [];
    for (let i = 1; i < points.length; ++i) numbers.push(...points[i - 1], ...points[i]);
    this.setSegments(numbers);
  }

  set visible(shown) {
    if (this.mesh) this.mesh.visible = shown;
  }
}
