/// What happens, in plain words. Reads the newest messages of a robot; pure.

import {duration, percent, quantity} from "./format.js";

export const PHASES = ["preflight", "arming", "takeoff", "tour", "return", "landing", "done"];

const PHASE_TITLES = {
  preflight: "On the ground: checks before the flight",
  arming: "Motors are being armed",
  takeoff: "Takes off",
  tour: "Flies its tour",
  return: "Returns to the place of take-off",
  hold: "Holds its place",
  landing: "Lands",
  done: "On the ground: the mission is over",
};

/// The rungs, mildest first, with what each one does.
export const RUNGS = [
  {level: "none", name: "all well", does: "nothing is wrong"},
  {level: "return", name: "returns", does: "flies home and lands there"},
  {level: "hold", name: "holds", does: "stays where it is until the cause is gone"},
  {level: "land", name: "lands", does: "lands where it is"},
  {level: "silence", name: "silent", does: "sends no setpoint: the flight controller descends by itself"},
];

const FAULTS = {
  no_odometry: "the flight controller has no odometry",
  odometry_rejected: "the flight controller rejects the odometry",
  setpoint_expired: "the setpoint has expired",
  battery_low: "the battery is low",
  collision: "it has hit something",
};

/// {title, level, waits, otherwise, because}: what a robot does now, what it waits for, and what happens if that goes on.
export function situation(robot) {
  const mission = robot.newest.mission;
  const faults = (robot.newest.state?.faults ?? []).map(fault => FAULTS[fault] ?? fault);
  if (!mission) return {title: `${robot.name}: nothing said of its mission yet`, level: "unknown", waits: "", otherwise: "", because: faults.join("; ")};
  let title = PHASE_TITLES[mission.phase] ?? mission.phase;
  if (mission.phase === "tour" && mission.targets > 0) title += `: target ${mission.target} of ${mission.targets}`;
  const because = [mission.text ?? "", ...faults].filter(Boolean).join("; ").replace(/^(\w+)/, word => word.replaceAll("_", " "));
  return {title, level: mission.ladder ?? "unknown", waits: mission.waits_for ?? "", otherwise: mission.if_it_goes_on ?? "", because};
}

/// What a battery is enough for, by the site's limits.
export function batteryWords(share, limits) {
  if (share === undefined) return "battery not known";
  const {battery_return_share: back, battery_land_share: land} = limits ?? {};
  if (land !== undefined && share < land) return "lands where it is";
  if (back !== undefined && share < back) return "enough for the way back";
  return back === undefined ? "" : `returns at ${percent(back)}, lands at ${percent(land)}`;
}

/// "waiting for R1_OBJECTS on 127.0.0.1:8765".
export const waitingFor = (robot, kind, host) => `no data yet: waiting for ${robot}_${kind.toUpperCase()} on ${host}`;

const TARGETS = {planned: "in the tour", next: "flown to now", waiting: "not in the tour yet", left: "no longer in the tour: done or out of reach", done: "done", visited: "visited",
  unreachable: "unreachable"};

/// "place 2 in the tour", "unreachable: no way there"; the message counts from 0.
export function targetWords(target) {
  if (!target) return "no target";
  const state = target.state === "planned" && target.tour !== undefined ? `place ${target.tour + 1} in the tour` : (TARGETS[target.state] ?? target.state);
  return target.reason ? `${state}: ${target.reason}` : state;
}

const VERDICTS = {
  occupied: "something is in the way",
  unknown: "a part of the way was never seen",
  stale_scan: "the newest scan is too old",
  no_trajectory: "no trajectory is committed",
};

/// What the collision checker says.
export function verdictWords(verdict) {
  if (!verdict) return "collision checker: nothing yet";
  if (verdict.clear) return "way clear to its end";
  const until = verdict.clear_for_s > 0 ? `; clear for ${duration(verdict.clear_for_s)}` : "";
  return `${VERDICTS[verdict.reason] ?? verdict.reason}${until}`;
}

/// A figure of results.json by its name's ending: [name, value with unit]; null: no figure.
export function figureWords(name, value) {
  if (typeof value === "boolean") return [name.replaceAll("_", " "), value ? "yes" : "no"];
  if (typeof value === "string") return [name.replaceAll("_", " "), value];
  if (typeof value !== "number") return null;
  const units = {m: ["m", 3], s: ["s", 1], ms: ["ms", 1], rad: ["rad", 3], deg: ["°", 1], share: ["%", 0], mps: ["m/s", 2], hz: ["Hz", 1], bytes: ["bytes", 0], nat: ["nat", 2]};
  const [, stem, ending] = name.match(/^(.*)_([a-z]+)$/) ?? [null, name, ""];
  if (ending in units) return [stem.replaceAll("_", " "), quantity(ending === "share" ? value * 100 : value, ...units[ending])];
  return [name.replaceAll("_", " "), Number.isInteger(value) ? `${value}\u00a0(count)` : `${value.toFixed(3)}\u00a0(ratio)`];
}
