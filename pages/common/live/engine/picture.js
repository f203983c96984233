// Everything the instrument shows of a plant and a controller, computed where it is drawn, in about a millisecond.

import { factorsOf, grid, logL, margins, unstablePoles } from "./frequency.js";
import { openedLoop } from "./loop.js";
import { scenario, unitSteps } from "./time.js";

/**
 * steps: {r, d, load, r_ramp, d_ramp}, heights, when the load begins, and in what times the heights are reached, 0 for
 * steps; end: of the time axis.
 * Returns {stable, unstable, t, y, u, omega, re, im, figures}, or null where the loop has no response to draw.
 */
export function picture(plant, controller, steps, end) {
  const loop = openedLoop(plant, controller);
  const record = loop && unitSteps(loop, end);
  if (!record) return null;
  const L = factorsOf(plant, controller);
  const omega = grid(L);
  const unstable = unstablePoles(L);
  const ramps = steps.r_ramp || steps.d_ramp ? unitSteps(openedLoop(plant, controller, true), end) : null;
  const curves = scenario(record, ramps, steps, end);
  const [re, im] = [[], []];
  for (const w of omega) {
    const [size, phase] = logL(L, w);
    re.push(Math.exp(size) * Math.cos(phase));
    im.push(Math.exp(size) * Math.sin(phase));
  }
  const figures = unstable ? null : { ...margins(L, omega), ...measures(record) };
  return { stable: !unstable, unstable, ...curves, omega, re, im, figures };
}

const COUNTED = 0.05; // share of the last quarter above which an integral is not told: its tail is not in the picture

/** IAE and TV of unit steps, overshoot of the set-point step; sums over the points drawn, good to two digits. */
export function measures({ t, y, u }) {
  const target = [1, 0];
  const IAE = y.map((curve, i) =>
    told(t, (k) => ((Math.abs(target[i] - curve[k]) + Math.abs(target[i] - curve[k + 1])) / 2) * (t[k + 1] - t[k])),
  );
  const TV = u.map((curve) => curve.reduce((sum, value, k) => sum + (k ? Math.abs(value - curve[k - 1]) : 0), 0));
  return {
    IAE_setpoint: IAE[0],
    IAE_disturbance: IAE[1],
    TV_setpoint: TV[0] + Math.abs(u[0][0]),
    TV_disturbance: TV[1],
    overshoot: Math.max(0, Math.max(...y[0]) - 1),
  };
}

function told(t, piece) {
  let [sum, late] = [0, 0];
  for (let k = 0; k + 1 < t.length; k++) {
    const part = piece(k);
    sum += part;
    if (t[k] > 0.75 * t[t.length - 1]) late += part;
  }
  return late > COUNTED * sum ? NaN : sum;
}
