/// Values as people read them: no number without its unit, nothing empty. Pure.

const MINUS = "\u2212", THIN = "\u00a0";

const known = value => value !== null && value !== undefined && !Number.isNaN(Number(value));

function digitsOf(value, digits) {
  return Number(value).toFixed(digits).replace(/^-(?=[\d.]*[1-9])/, MINUS).replace(/^-/, "");
}

/// "3.20 m"; what is not known is said so.
export function quantity(value, unit, digits = 1, unknown = "not known") {
  return known(value) && Number.isFinite(Number(value)) ? digitsOf(value, digits) + THIN + unit : unknown;
}

/// "4.68 ± 0.05 m"; "4.68 m (± not computed)".
export function withSd(value, sd, unit, digits = 2) {
  if (!known(value)) return "not known";
  if (!known(sd)) return `${digitsOf(value, digits)}${THIN}${unit} (±${THIN}not computed)`;
  return `${digitsOf(value, digits)}${THIN}±${THIN}${digitsOf(sd, digits)}${THIN}${unit}`;
}

/// A share as percent.
export const percent = (share, unknown = "not known") => quantity(known(share) ? share * 100 : null, "%", 0, unknown);

/// "12.3 s", "2 min 05 s", "1 h 02 min".
export function duration(seconds, unknown = "not known") {
  if (!known(seconds)) return unknown;
  if (seconds < 60) return quantity(seconds, "s", seconds < 10 ? 1 : 0);
  const s = Math.round(seconds);
  if (s < 3600) return `${Math.floor(s / 60)}${THIN}min${THIN}${String(s % 60).padStart(2, "0")}${THIN}s`;
  return `${Math.floor(s / 3600)}${THIN}h${THIN}${String(Math.floor((s % 3600) / 60)).padStart(2, "0")}${THIN}min`;
}

/// "12 times", "once", "never".
export const times = count => (count === 1 ? "once" : count > 0 ? `${count}${THIN}times` : "never");

/// A date as a person on the ground reads it, local time.
export const wallClock = date => date.toLocaleTimeString("en-GB", {hour12: false});
