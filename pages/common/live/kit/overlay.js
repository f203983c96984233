// What a lecture lays over the curves: what is hidden, the ghost of the last position, one crosshair for all panels.

import { nearest } from "./format.js";

const GHOST = 0.4; // opacity
const EMPTY = { x: [], y: [] };

/** What of a curve is to be seen. hides: "curves", "future" or nothing; until: where the future begins. */
export function seen(curve, { aid }, hides, until) {
  if (aid || !hides) return curve;
  if (hides === "curves") return EMPTY;
  if (hides !== "future" || until === undefined) return curve;
  const past = curve.x.findIndex((x) => x > until);
  return past < 0 ? curve : { x: curve.x.slice(0, past), y: curve.y.slice(0, past) };
}

/** The curves as they were, faint, behind those of now; they are drawn with `trace`. */
export function ghosts({ ghost, spec, theme, scale }, u, trace) {
  u.ctx.globalAlpha = GHOST;
  u.ctx.setLineDash([]);
  ghost?.forEach((curve, i) => {
    const { aid, color } = spec.styles[i];
    if (aid) return;
    u.ctx.strokeStyle = theme.ink(color);
    u.ctx.lineWidth = 2 * scale * devicePixelRatio;
    u.ctx.stroke(trace(u, curve, new Path2D(), true));
  });
  u.ctx.globalAlpha = 1;
}

/** The same instant or frequency in every panel: a line where it is on the axis, a point on each curve. */
export function cross(panel, axis, value) {
  const { chart: u, spec } = panel;
  if (!u) return;
  for (const old of u.over.querySelectorAll(".cross, .dot")) old.remove();
  if (axis !== spec.along || value === undefined) return;
  const curves = panel.curves.slice(-spec.names.length);
  for (const { x, y } of curves) {
    const places = spec.omega ?? x;
    if (!x.length || places.length !== x.length) continue;
    const i = nearest(places, value);
    put(u, "dot", x[i], y[i]);
  }
  if (!spec.omega) put(u, "cross", value);
}

function put(u, name, x, y) {
  const made = Object.assign(document.createElement("div"), { className: name });
  made.style.left = `${u.valToPos(x, "x")}px`;
  if (y !== undefined) made.style.top = `${u.valToPos(y, "y")}px`;
  u.over.append(made);
}
