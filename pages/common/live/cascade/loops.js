// Both loops of a cascade from the settings of their controllers, exactly: Lb = Cb Gb, La = Ca Ga Lb/(1 + Lb); margins.

import { sensitivities } from "../kit/table.js";

/** C(j omega) of Kp, Ki, Kd, tau_F, as [re, im]: (Kp + Ki/s + Kd s)/(tau_F s + 1). */
function controller([Kp, Ki, Kd, tau_F], omega) {
  const im = Kd * omega - Ki / omega,
    lag = tau_F * omega,
    size = 1 + lag * lag;
  return [(Kp + im * lag) / size, (im - Kp * lag) / size];
}

const times = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];

/** parameters: of the inner, then of the outer controller; setup holds omega, Ga and Gb. */
export function loopsOf({ omega, blocks }, parameters) {
  const inner = { x: [], y: [] },
    outer = { x: [], y: [] };
  const block = (name, i) => [blocks[`${name}_re`].values[i], blocks[`${name}_im`].values[i]];
  omega.forEach((w, i) => {
    const [re, im] = times(controller(parameters.slice(0, 4), w), block("Gb", i));
    const size = (1 + re) ** 2 + im ** 2;
    const T = [(re * (1 + re) + im * im) / size, im / size];
    const La = times(times(controller(parameters.slice(4), w), block("Ga", i)), T);
    inner.x.push(re);
    inner.y.push(im);
    outer.x.push(La[0]);
    outer.y.push(La[1]);
  });
  return { inner, outer };
}

/** Ms, GM, PM_deg, delay_margin of a stable loop from L on its grid, to 0.1 %; margins.py defines them. */
export function marginsOf(omega, { x: re, y: im }) {
  const { S } = sensitivities(re, im);
  const found = { Ms: peakOf(S), GM: Infinity, PM_deg: Infinity, delay_margin: Infinity };
  for (let i = 0; i + 1 < omega.length; i++) {
    if (im[i] * im[i + 1] < 0) {
      const share = im[i] / (im[i] - im[i + 1]);
      const gain = -(re[i] + share * (re[i + 1] - re[i]));
      if (gain > 0 && gain < 1) found.GM = Math.min(found.GM, 1 / gain);
    }
    const a = Math.log(Math.hypot(re[i], im[i])),
      b = Math.log(Math.hypot(re[i + 1], im[i + 1]));
    if (a * b < 0) {
      const share = a / (a - b);
      const from = Math.atan2(-im[i], -re[i]),
        turn = Math.atan2(-im[i + 1], -re[i + 1]) - from;
      const angle = from + share * (turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI)));
      const phase = angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
      const w = omega[i] * (omega[i + 1] / omega[i]) ** share;
      found.PM_deg = Math.min(found.PM_deg, (Math.abs(phase) * 180) / Math.PI);
      found.delay_margin = Math.min(found.delay_margin, (phase < 0 ? phase + 2 * Math.PI : phase) / w);
    }
  }
  return found;
}

/** The largest of the values, by a parabola through it and its neighbours. */
function peakOf(values) {
  let i = 0;
  for (let j = 1; j < values.length; j++) if (values[j] > values[i]) i = j;
  if (i === 0 || i === values.length - 1) return values[i];
  const [a, b, c] = [values[i - 1], values[i], values[i + 1]],
    bend = a - 2 * b + c;
  return bend < 0 ? b - (a - c) ** 2 / (8 * bend) : b;
}
