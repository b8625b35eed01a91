/// Rows of the table of objects: what is shown, how it is sorted. Pure.

import {targetWords} from "./words.js";
import {sizeOf} from "./store.js";

const STATES = {next: 0, planned: 1, waiting: 2, unreachable: 3, left: 4, visited: 5, done: 6};

/// Columns by name; `of` gives what is sorted by, unknown ones come last both ways.
export const COLUMNS = {
  id: row => row.id,
  class: row => row.class,
  length: row => row.size[0],
  width: row => row.size[1],
  height: row => row.height_m,
  seen: row => row.observations,
  target: row => (row.target ? (STATES[row.target.state] ?? 7) * 1000 + (row.target.tour ?? 0) : null),
  robot: row => row.robot,
};

/// A row of an object: sizes with sd in m, and words.
export function rowOf(robot, object) {
  const [length, width, lengthSd, widthSd] = sizeOf(object);
  return {
    robot,
    id: object.id,
    class: object.class,
    shape: object.shape,
    size: [length, width],
    sd: [lengthSd, widthSd],
    height_m: object.shape === "cylinder" ? object.height : object.size[2],
    observations: object.observations,
    probability: object.probability ?? null,
    target: object.target ?? null,
    state: targetWords(object.target),
    object,
  };
}

/// Those of a class whose id, class or state has the words.
export function chosenRows(rows, {classes = null, words = ""} = {}) {
  const wanted = words.trim().toLowerCase();
  return rows.filter(row => (!classes || classes.has(row.class)) && (!wanted || `${row.class} ${row.id} ${row.state} ${row.robot}`.toLowerCase().includes(wanted)));
}

export function sortedRows(rows, column, descending) {
  const of = COLUMNS[column], sign = descending ? -1 : 1;
  return rows.map(row => [of(row), row]).sort(([a, x], [b, y]) => {
    if (a === null || b === null || a === undefined || b === undefined) return (a ?? null) === (b ?? null) ? x.id - y.id : (a ?? null) === null ? 1 : -1;
    const order = typeof a === "string" ? a.localeCompare(b) : a - b;
    return sign * order || x.id - y.id;
  }).map(([, row]) => row);
}
