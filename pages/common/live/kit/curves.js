// Panels that both instruments have: colours, time axes, Nyquist with its Ms circles, sensitivities.

import { nearest, text } from "./format.js";
import { ALARM, Panel } from "./panel.js";
import { listed, numeral, said } from "./words.js";

// Colours are CSS variables, written by simc_core/figures/palette.py.
export const Y = "--simc-y";
export const U = "--simc-u";
export const R = "--simc-r";
export const D = "--simc-d";
export const S_LINE = "--simc-s";
const PIN_DASHES = [
  [8, 4],
  [2, 3],
  [8, 3, 2, 3],
  [14, 4],
];
const LABELS_AT = [0.61, 1.4, 2.27]; // on the circles of Ms, rad
const AXES = [
  { x: [-1e3, 1e3], y: [0, 0] },
  { x: [0, 0], y: [-1e3, 1e3] },
];
export const EMPTY = { x: [], y: [] };

/** What stands on the axes; an instrument puts the user's own units here before it makes panels. */
const TIME = said("time unit");
export const LABELS = {
  t: said("t  [{unit}]", { unit: TIME }),
  omega: said("ω  [rad/{unit}]", { unit: TIME }),
  y: "y",
  u: "u",
};

/** A number with the user's unit of what it is of, "time" or "OP/PV", where that has a name. */
export const measured = (words, what) => (LABELS[what] ? `${words} ${LABELS[what]}` : words);

/** Of the i-th design behind the present one; there are four shades. */
export const shadeOf = (color, i) => `${color}-pin-${(i % 4) + 1}`;

export const pinned = (color, pins) =>
  pins.map(({ name }, i) => ({
    color: shadeOf(color, i),
    dash: PIN_DASHES[i % PIN_DASHES.length],
    width: 1.6,
    name, // it stands at the curve, see names.js
  }));

/** What the last curves of the panel, called `names`, are at the instant or frequency nearest to the cursor. */
const tellNearest = (axis, names, what) => (panel, at) => {
  const curves = panel.curves.slice(-names.length),
    { x } = curves[0];
  if (!x.length) return "";
  const i = nearest(x, at);
  return [
    `${axis} = ${measured(text(x[i]), what)}`,
    ...names.map((name, n) => `${name} = ${text(curves[n].y[i])}`),
  ].join("   ");
};

/** Smallest and largest value of the panel's curves, and always `always`. */
export function extent(panel, [from, to], always) {
  let [low, high] = always;
  for (const { x, y } of panel.curves.slice(panel.spec.aids ?? 0)) // what only helps the eye does not count
    for (let i = 0; i < y.length; i++)
      if (x[i] >= from && x[i] <= to && Number.isFinite(y[i])) {
        low = Math.min(low, y[i]);
        high = Math.max(high, y[i]);
      }
  return [low, high];
}

/** spec: as of a Panel, without x; names: of its last curves. */
export function timePanel({ names, ...spec }, end, scale) {
  return new Panel(
    {
      ...spec,
      names,
      along: "t",
      x: { label: LABELS.t, limits: () => [0, end] },
      tell: tellNearest("t", names, "time"),
    },
    scale,
  );
}

/** loops [{name, color, dash, ring}]: L of each, and the colour of the circle that it touches; behind: more styles. */
export function nyquistPanel({ title, loops, legend, behind = [] }, { omega, circles }, scale) {
  const nearestTo = (panel, x, y) => {
    let best = null;
    for (const [n, { x: re, y: im }] of panel.curves.slice(-loops.length).entries())
      for (let i = 0; i < re.length; i++) {
        const away = Math.hypot(re[i] - x, im[i] - y);
        if (!best || away < best.away) best = { away, i, name: loops[n].name, re: re[i], im: im[i] };
      }
    return best;
  };
  const tell = (panel, x, y) => {
    const best = nearestTo(panel, x, y);
    if (!best) return "";
    const value = `${text(best.re, 3)} ${best.im < 0 ? "−" : "+"} ${text(Math.abs(best.im), 3)} j`;
    return `ω = ${measured(text(omega[best.i]), "frequency")}   ${best.name} = ${value}`;
  };
  return new Panel(
    {
      key: "nyquist",
      title,
      short: said("Nyquist"),
      square: true,
      tell,
      names: loops.map(({ name }) => name),
      along: "omega",
      omega,
      where: (panel, x, y) => omega[nearestTo(panel, x, y)?.i],
      legend: [...legend, { text: `Ms ${listed(circles.map(shown))}`, color: R, dash: true }],
      x: { label: "Re L", limits: () => [-2.4, 0.9] },
      y: { label: "Im L", limits: () => [-1.75, 0.8] },
      styles: [
        { color: R, width: 1, aid: true },
        { color: R, width: 1, aid: true },
        ...circles.map(() => ({ color: R, dash: [2, 3], width: 1, aid: true })),
        ...loops.map(({ ring, dash }) => ({ color: ring, width: 1.6, dash })),
        ...behind,
        ...loops.map(({ color, dash }) => ({ color, dash, width: 2.2 })),
      ],
    },
    scale,
  );
}

/** Curves and marks for a nyquistPanel: peaks Ms of the loops, what is behind, L of the loops. */
export function nyquistCurves(circles, peaks, behind, loops) {
  const rings = peaks.map((Ms) => (Number.isFinite(Ms) ? circle(Ms) : EMPTY));
  const labels = circles.map((Ms, i) => ({
    x: -1 + Math.cos(LABELS_AT[i]) / Ms,
    y: Math.sin(LABELS_AT[i]) / Ms,
    label: shown(Ms),
    align: LABELS_AT[i] > 1.5 ? "right" : "left",
  }));
  const point = { x: -1, y: 0, color: ALARM, label: "−1", cross: true, align: "right" };
  return [
    [...AXES, ...circles.map(circle), ...rings, ...behind, ...loops],
    [...labels, point],
  ];
}

/** Magnitudes over omega; the first curve is the line at 1. */
export function magnitudePanel({ names, styles, ...spec }, omega, scale) {
  return new Panel(
    {
      ...spec,
      names,
      along: "omega",
      tell: tellNearest("ω", names, "frequency"),
      x: { label: LABELS.omega, log: true, limits: () => [omega[0], omega.at(-1)] },
      y: { label: "", log: true, limits: (p) => [0.01, p.curves.some(({ y }) => y.some((v) => v > 3.2)) ? 100 : 4] },
      styles: [{ color: R, width: 1, aid: true }, ...styles],
    },
    scale,
  );
}

export const unity = (omega) => ({ x: [omega[0], omega.at(-1)], y: [1, 1] });

const shown = (Ms) => numeral(Ms.toFixed(1));

function circle(Ms) {
  const x = [],
    y = [];
  for (let i = 0; i <= 120; i++) {
    x.push(-1 + Math.cos((i * Math.PI) / 60) / Ms);
    y.push(Math.sin((i * Math.PI) / 60) / Ms);
  }
  return { x, y };
}
