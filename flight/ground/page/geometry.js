/// Small geometry of the page, without three.js, so that it is tested alone. Metres, radians.

const CHI2_95_OF_TWO = 5.991;  // 95 % of a plane's normal distribution lie within this squared distance
export const SD_95 = 1.96;     // 95 % of a line's

/// The 95 % ellipse of a covariance [xx, xy, yy], m²: {a, b} half axes, the longer first, and the angle of a to x. Null where there is none.
export function ellipse95(covariance) {
  if (!covariance || covariance.some(v => !Number.isFinite(v))) return null;
  const [xx, xy, yy] = covariance;
  const mean = (xx + yy) / 2, half = Math.hypot((xx - yy) / 2, xy);
  if (mean - half < 0) return null;  // no covariance
  return {a: Math.sqrt(CHI2_95_OF_TWO * (mean + half)), b: Math.sqrt(CHI2_95_OF_TWO * (mean - half)), angle: Math.atan2(2 * xy, xx - yy) / 2};
}

/// Where the 95 % whiskers of a cuboid's length and width lie on its axes: [[axis, sign, near, far], …], m from the centre. A size's error is
/// shared by both of its ends.
export function whiskers95(size, sd, scale = 1) {
  return [0, 1].flatMap(axis => {
    const half = size[axis] / 2, reach = (SD_95 * (sd?.[axis] ?? NaN) * scale) / 2;
    if (!Number.isFinite(reach)) return [];
    return [1, -1].map(sign => [axis, sign, Math.max(0, half - reach), half + reach]);
  });
}

/// float32 fields of a foxglove.PointCloud as one array of x, y, z.
export function pointsOf(cloud) {
  const raw = Uint8Array.from(atob(cloud.data), c => c.charCodeAt(0));
  const view = new DataView(raw.buffer);
  const offsets = ["x", "y", "z"].map(name => cloud.fields.find(field => field.name === name).offset);
  const count = Math.floor(raw.length / cloud.point_stride);
  const points = new Float32Array(3 * count);
  for (let i = 0; i < count; ++i) {
    for (let k = 0; k < 3; ++k) points[3 * i + k] = view.getFloat32(i * cloud.point_stride + offsets[k], true);
  }
  return points;
}

/// Latitude and longitude, degrees, of a place in the frame of an origin {latitude_deg, longitude_deg, heading_deg}, whose x points to
/// `heading_deg`, clockwise from north. WGS 84's radii at the origin: good to a millimetre within a kilometre.
export function toGeodetic(origin, [x, y]) {
  const heading = (origin.heading_deg * Math.PI) / 180, latitude = (origin.latitude_deg * Math.PI) / 180;
  const east = x * Math.sin(heading) - y * Math.cos(heading), north = x * Math.cos(heading) + y * Math.sin(heading);
  const A = 6378137, E2 = 6.69437999014e-3, w = 1 - E2 * Math.sin(latitude) ** 2;
  const meridian = (A * (1 - E2)) / w ** 1.5, normal = A / Math.sqrt(w);
  return [origin.longitude_deg + ((east / (normal * Math.cos(latitude))) * 180) / Math.PI, origin.latitude_deg + ((north / meridian) * 180) / Math.PI];
}

/// Corners of a cuboid's footprint, counter-clockwise from the front left; heading from x.
export function footprint({position, size, heading_rad}) {
  const c = Math.cos(heading_rad), s = Math.sin(heading_rad);
  return [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([i, j]) => {
    const u = (i * size[0]) / 2, v = (j * size[1]) / 2;
    return [position[0] + c * u - s * v, position[1] + s * u + c * v];
  });
}

/// A round length for a scale bar of at most `most` m: 1, 2 or 5 times a power of ten.
export function roundLength(most) {
  const power = 10 ** Math.floor(Math.log10(most));
  return power * ([5, 2].find(k => k * power <= most) ?? 1);
}

/// Yaw of a quaternion x y z w.
export const yawOf = ([x, y, z, w]) => Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));

/// Vertices of `count` shapes: {position, normal, …}, written into `into`, a flat array each: place and normal in the frame
/// of the matrices (4 × 4, column-major), colour (white without `colours`), place, normal and size in the unit shape. `unit`: {position, normal}.
export function writeVertices(unit, matrices, colours, count, into) {
  const corners = unit.position.length / 3;
  for (let i = 0, at = 0; i < count; ++i) {
    const m = 16 * i, size = [0, 1, 2].map(k => Math.hypot(matrices[m + 4 * k], matrices[m + 4 * k + 1], matrices[m + 4 * k + 2]));
    for (let c = 0; c < corners; ++c, at += 3) {
      let length = 0;
      for (let row = 0; row < 3; ++row) {
        let place = matrices[m + 12 + row], normal = 0;
        for (let k = 0; k < 3; ++k) {
          place += matrices[m + 4 * k + row] * unit.position[3 * c + k];
          normal += matrices[m + 4 * k + row] * unit.normal[3 * c + k] / (size[k] * size[k] || 1);
        }
        into.position[at + row] = place;
        into.normal[at + row] = normal;
        length += normal * normal;
        into.color[at + row] = colours ? colours[3 * i + row] : 1;
        into.unitPlace[at + row] = unit.position[3 * c + row];
        into.unitNormal[at + row] = unit.normal[3 * c + row];
        into.unitSize[at + row] = size[row];
      }
      const scale = 1 / (Math.sqrt(length) || 1);
      for (let row = 0; row < 3; ++row) into.normal[at + row] *= scale;
    }
  }
}
