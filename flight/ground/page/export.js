/// What the table shows, as a file: JSON as it came, CSV, GeoJSON where the site has an origin. Pure, but for `save`.

import {footprint, toGeodetic} from "./geometry.js";
import {placeOf} from "./store.js";

const number = value => (value === null || value === undefined ? "" : String(value));
const quoted = text => (/[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

export const toJson = rows => JSON.stringify({objects: rows.map(({robot, object}) => ({robot, ...object}))}, null, 1);

const FIELDS = {
  robot: ({robot}) => robot,
  id: ({id}) => number(id),
  class: row => quoted(row.class),
  probability: ({probability}) => number(probability),
  observations: ({observations}) => number(observations),
  x_m: ({object}) => number(placeOf(object)[0]),
  y_m: ({object}) => number(placeOf(object)[1]),
  z_m: ({object}) => number(placeOf(object)[2]),
  heading_rad: ({object}) => number(object.heading_rad),
  length_m: ({size}) => number(size[0]),
  width_m: ({size}) => number(size[1]),
  height_m: ({height_m}) => number(height_m),
  length_sd_m: ({sd}) => number(sd[0]),
  width_sd_m: ({sd}) => number(sd[1]),
  target: ({state}) => quoted(state),
};

export function toCsv(rows) {
  const lines = rows.map(row => Object.values(FIELDS).map(of => of(row)).join(","));
  return [Object.keys(FIELDS).join(","), ...lines, ""].join("\n");
}

/// RFC 7946; `originOf(robot)` is the origin of that robot's frame. Null where one has none.
export function toGeoJson(rows, originOf) {
  const features = [];
  for (const row of rows) {
    const origin = originOf(row.robot);
    if (!origin) return null;
    const {object} = row, round = row.shape === "cylinder";
    const corners = round ? null : footprint(object).map(corner => toGeodetic(origin, corner));
    features.push({
      type: "Feature",
      id: `${row.robot}/${row.id}`,
      geometry: round ? {type: "Point", coordinates: toGeodetic(origin, object.root)} : {type: "Polygon", coordinates: [[...corners, corners[0]]]},
      properties: {robot: row.robot, id: row.id, class: row.class, probability: row.probability, observations: row.observations, length_m: row.size[0], width_m: row.size[1],
        height_m: row.height_m, length_sd_m: row.sd[0], width_sd_m: row.sd[1], target: row.state},
    });
  }
  return JSON.stringify({type: "FeatureCollection", features}, null, 1);
}

/// Offers a text as a file.
export function save(name, text, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
