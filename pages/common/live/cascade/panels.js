// The four panels of the cascade: both outputs, the input, Nyquist and |S| of both loops.

import {
  D,
  EMPTY,
  extent,
  magnitudePanel,
  nyquistCurves,
  nyquistPanel,
  R,
  S_LINE,
  timePanel,
  U,
  unity,
  Y,
} from "../kit/curves.js";
import { round, text } from "../kit/format.js";
import { sensitivities } from "../kit/table.js";
import { said } from "../kit/words.js";

const INNER = "--simc-inner";
const INNER_DASH = [8, 4];
const LEAVES = 100; // what grows is drawn until it is this large, in steps of r

export function cascadePanels(setup, scale) {
  const { t, omega, starts } = setup;
  const end = t.at(-1),
    window = [0, end];
  const [atD1, atD2] = starts.map((start) => text(start, 3));
  /** Limits of y as long as the cascade is sound, and after that those it had last: growing curves leave the panel. */
  const keeping = (always) => {
    let range = [-1, 2];
    return (panel) => {
      if (!panel.note && panel.curves.at(-1).y.length) range = extent(panel, window, always);
      return round(...range);
    };
  };
  const output = timePanel(
    {
      key: "y",
      title: said("Outputs y1, y2"),
      short: "y1, y2",
      aids: 3,
      names: ["y2", "y1"],
      legend: [
        { text: "y1", color: Y },
        { text: "y2", color: INNER, dash: true },
        { text: said("d1 at {d1}, d2 at {d2}", { d1: atD1, d2: atD2 }), color: D, dash: true },
      ],
      y: { label: "y1, y2", limits: keeping([0, 1.05]) },
      styles: [
        { color: R, dash: [5, 4], width: 1.5, aid: true },
        ...starts.map(() => ({ color: D, dash: [2, 3], width: 1.2, aid: true })),
        { color: INNER, dash: INNER_DASH, width: 1.8 },
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
      aids: 2,
      names: ["u"],
      legend: [{ text: "u", color: U }],
      y: { label: "u", limits: keeping([0, 0]) },
      styles: [...starts.map(() => ({ color: D, dash: [2, 3], width: 1.2, aid: true })), { color: U, width: 2.2 }],
    },
    end,
    scale,
  );
  const nyquist = nyquistPanel(
    {
      title: said("Nyquist"),
      legend: [
        { text: "La", color: Y },
        { text: "Lb", color: INNER, dash: true },
        { text: said("their Ms"), color: S_LINE },
      ],
      loops: [
        { name: "Lb", color: INNER, dash: INNER_DASH, ring: S_LINE },
        { name: "La", color: Y, ring: S_LINE },
      ],
    },
    setup,
    scale,
  );
  const sensitivity = magnitudePanel(
    {
      key: "sensitivity",
      title: said("|S| of both loops"),
      short: "|S|",
      names: ["|Sb|", "|Sa|"],
      legend: [
        { text: "|Sa|", color: Y },
        { text: "|Sb|", color: INNER, dash: true },
      ],
      styles: [
        { color: INNER, dash: INNER_DASH, width: 1.8 },
        { color: Y, width: 2.2 },
      ],
    },
    omega,
    scale,
  );

  const step = { x: [0, 0, end], y: [0, 1, 1] };
  const loads = starts.map((start) => ({ x: [start, start], y: [-1e6, 1e6] }));
  const over = (y, why) => {
    if (!y) return EMPTY;
    const count = why ? y.findIndex((v) => Math.abs(v) > LEAVES) : -1;
    return count < 0 ? { x: t, y } : { x: t.slice(0, count + 1), y: y.slice(0, count + 1) };
  };
  return {
    panels: [output, input, nyquist, sensitivity],
    draw({ y1, y2, u, loops, metrics, why }) {
      output.show([step, ...loads, over(y2, why), over(y1, why)], [], why);
      input.show([...loads, over(u, why)], [], why);
      const { inner, outer } = loops ?? { inner: EMPTY, outer: EMPTY };
      nyquist.show(...nyquistCurves(setup.circles, [metrics.Ms_inner, metrics.Ms_outer], [], [inner, outer]), why);
      const S = ({ x, y }) => ({ x: x.length ? omega : [], y: sensitivities(x, y).S });
      sensitivity.show([unity(omega), S(inner), S(outer)], [], why);
    },
  };
}
