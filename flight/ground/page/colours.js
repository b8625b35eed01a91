/// Colours that a colour-blind person tells apart: Okabe and Ito, "Color Universal Design", 2008. Classes differ in shape, too, and robots in
/// their names, so that no colour is needed to read the page.

export const CLASSES = {
  vehicle: {colour: "#0072b2", glyph: "\u25a0"},
  trunk: {colour: "#009e73", glyph: "\u25cf"},
  pole: {colour: "#e69f00", glyph: "\u25b2"},
};
const OTHER = {colour: "#6b7280", glyph: "\u25c6"};

export const ofClass = name => CLASSES[name] ?? OTHER;

const ROBOTS = ["#d55e00", "#8e3b7e", "#1f2933", "#56b4e9", "#a6761d", "#4d7c0f"];

/// A robot's colour by its place among the robots' names; the seventh begins anew.
export const ofRobot = index => ROBOTS[index % ROBOTS.length];

/// Levels of the safety ladder, mildest first; each is named beside its colour.
export const LEVELS = {
  ok: "#00624a",
  return: "#8a5a00",
  hold: "#b34700",
  land: "#a11d1d",
  silence: "#6d0f4f",
  unknown: "#4b5563",
};
