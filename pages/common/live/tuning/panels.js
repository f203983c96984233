// The four panels of the tuning view, from one reading of the table; pinned designs behind the present one.

import {
  D,
  extent,
  LABELS,
  magnitudePanel,
  nyquistCurves,
  nyquistPanel,
  pinned,
  R,
  S_LINE,
  shadeOf,
  timePanel,
  U,
  unity,
  Y,
} from "../kit/curves.js";
import { round, text } from "../kit/format.js";
import { mix, sensitivities } from "../kit/table.js";
import { said } from "../kit/words.js";

export function responsePanels(table, scale) {
  const { t, omega, pins, steps } = table;
  const end = t.at(-1),
    window = [0, end];
  const within = ([low, high], cap) => round(Math.max(low, cap[0]), Math.min(high, cap[1]));
  const bounds = [Math.min(0, 1.05 * steps.r), Math.max(0, 1.05 * steps.r)];
  const output = timePanel(
    {
      key: "y",
      title: said("Output y"),
      short: "y",
      aids: 2,
      names: ["y"],
      legend: [
        { text: "y", color: Y },
        { text: "r", color: R, dash: true },
        ...(steps.d ? [{ text: said("load d from {time}", { time: text(steps.load, 3) }), color: D, dash: true }] : []),
        ...pins.map(({ name }, i) => ({ text: name, color: shadeOf(Y, i), dash: true })),
      ],
      y: { label: LABELS.y, limits: (p) => within(extent(p, window, bounds), table.y_cap) },
      styles: [
        { color: R, dash: [5, 4], width: 1.5, aid: true },
        { color: D, dash: [2, 3], width: 1.2, aid: true },
        ...pinned(Y, pins),
        { color: Y, width: 2.2 },
      ],
    },
    end,
    scale,
  );
  const input = timePanel(
    {
      key: "u",
      title: said("Input u"),
      short: "u",
      names: ["u"],
      legend: [{ text: "u", color: U }],
      y: { label: LABELS.u, limits: (p) => within(extent(p, window, [0, 0]), table.u_cap) },
      styles: [...pinned(U, pins), { color: U, width: 2.2 }],
    },
    end,
    scale,
  );
  const nyquist = nyquistPanel(
    {
      title: said("Nyquist L(jω)"),
      loops: [{ name: "L", color: Y, ring: S_LINE }],
      behind: pinned(Y, pins),
      legend: [
        { text: "L", color: Y },
        { text: said("Ms circle"), color: S_LINE },
      ],
    },
    table,
    scale,
  );
  const sensitivity = magnitudePanel(
    {
      key: "sensitivity",
      title: said("|S| and |T|"),
      short: "|S| |T|",
      names: ["|T|", "|S|"],
      legend: [
        { text: "|S|", color: S_LINE },
        { text: "|T|", color: Y, dash: true },
      ],
      styles: [
        ...pinned(S_LINE, pins),
        ...pinned(Y, pins),
        { color: Y, dash: [9, 4], width: 2 },
        { color: S_LINE, width: 2.2 },
      ],
    },
    omega,
    scale,
  );

  const step = { x: [0, steps.r_ramp, Math.max(end, steps.r_ramp)], y: [0, steps.r, steps.r] };
  const load = steps.d ? { x: [steps.load, steps.load], y: [-1e6, 1e6] } : { x: [], y: [] };
  const pinRows = (name) => pins.map((_, i) => mix(table.blocks[name], { first: i, weights: [1] }));
  const [py, pu, pre, pim] = ["pin_y", "pin_u", "pin_re", "pin_im"].map(pinRows);
  const ps = pre.map((re, i) => sensitivities(re, pim[i]));
  const over = (y) => ({ x: t, y }),
    on = (curve) => ({ x: omega, y: curve });

  return {
    panels: [output, input, nyquist, sensitivity],
    draw({ y, u, re, im, metrics, stable, at = t, frequencies = omega }) {
      const note = stable ? "" : said("Loop not stable");
      output.show([step, load, ...py.map(over), { x: at, y }], [], note);
      input.show([...pu.map(over), { x: at, y: u }], [], note);
      nyquist.show(
        ...nyquistCurves(
          table.circles,
          [stable ? metrics.Ms : NaN],
          pre.map((x, i) => ({ x, y: pim[i] })),
          [{ x: re, y: im }],
        ),
        note,
      );
      const { S, T } = sensitivities(re, im);
      const now = [T, S].map((curve) => ({ x: frequencies, y: curve }));
      sensitivity.show([unity(omega), ...ps.map((p) => on(p.S)), ...ps.map((p) => on(p.T)), ...now], [], note);
    },
  };
}
