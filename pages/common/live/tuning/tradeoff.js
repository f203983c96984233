// The trade-off view: what tau_c buys and what it costs, over tau_c/theta, with the present point on every curve.

import { S_LINE, shadeOf, U, Y } from "../kit/curves.js";
import { nearest, round, text } from "../kit/format.js";
import { Panel } from "../kit/panel.js";
import { said } from "../kit/words.js";

const LETTERS = "ABCD";
const CALM_BAND = "--simc-calm-band";
const UNSTABLE_BAND = "--simc-alarm-band";
// key, title, log, curves [metric, words, colour]
const TRADE_OFFS = [
  [
    "peaks",
    "Ms, Mt",
    true,
    [
      ["Ms", "Ms", S_LINE],
      ["Mt", "Mt", Y],
    ],
  ],
  ["gain", said("Gain margin"), true, [["GM", "GM", Y]]],
  ["phase", said("Phase margin [°]"), false, [["PM_deg", "PM", Y]]],
  ["delay", said("Delay margin [time]"), true, [["delay_margin", said("delay margin"), Y]]],
  [
    "iae",
    "IAE",
    true,
    [
      ["IAE_setpoint", "r", Y],
      ["IAE_disturbance", "d", U],
    ],
  ],
  [
    "tv",
    said("TV of u"),
    true,
    [
      ["TV_setpoint", "r", Y],
      ["TV_disturbance", "d", U],
    ],
  ],
  [
    "overshoot",
    said("Overshoot and noise gain"),
    false,
    [
      ["overshoot", "y", Y],
      ["noise_gain", "|KS|", U],
    ],
  ],
];

const DIRECT = "overshoot"; // no room for a legend beside its title: names stand at the points

export function tradeOffPanels(table, scale) {
  const { unit, symbol } = table;
  const [robust] = table.bands[0];
  const ratios = table.log_tau_c.map((v) => Math.exp(v) / unit);
  const column = (name) => table.columns[name];
  const known = (values) => values.filter((v) => Number.isFinite(v) && v > 0);
  const x = { label: symbol ? "τc/θ" : "τc", log: true, limits: () => [table.low / unit, table.high / unit] };
  const stability = () =>
    table.unstable.map(([from, to]) => ({
      axis: "x",
      from: Math.max(from, table.low) / unit,
      to: to / unit,
      color: UNSTABLE_BAND,
    }));
  const list = TRADE_OFFS.map(([key, title, log, curves]) => {
    const limits = () => {
      const values = curves.flatMap(([name]) => known(column(name)));
      if (!values.length) return [0.1, 10];
      const low = Math.min(...values),
        high = Math.max(...values);
      if (key === "peaks") return [0.9, Math.min(10, Math.max(3, high))];
      return log ? [0.8 * low, Math.max(1.25 * high, 10 * low)] : round(0, high);
    };
    return new Panel(
      {
        key,
        title,
        x,
        y: { label: "", log, limits },
        legend:
          curves.length === 1 || key === DIRECT
            ? []
            : curves.map(([, words, color], i) => ({ text: words, color, dash: i > 0 })),
        styles: curves.map(([, , color], i) => ({ color, width: 2.2, dash: i ? [8, 4] : undefined })),
        bands: () => [
          ...(key === "peaks" ? [{ axis: "y", from: 1, to: robust, color: CALM_BAND }] : []),
          ...stability(),
        ],
        tell: (_panel, at) => {
          const i = nearest(ratios, at);
          return [
            `${x.label} = ${text(ratios[i], 3)}`,
            ...curves.map(([name, words]) => `${words} ${text(column(name)[i])}`),
          ].join("   ");
        },
      },
      scale,
    );
  });
  const price = new Panel(
    {
      key: "price",
      title: said("Speed against robustness"),
      x: { label: "Ms", limits: () => [1, 3] },
      y: {
        label: said("IAE load"),
        log: true,
        limits: () => {
          const v = known(column("IAE_disturbance"));
          return v.length ? [0.8 * Math.min(...v), 1.25 * Math.max(...v)] : [0.1, 10];
        },
      },
      styles: [{ color: Y, width: 2.2 }],
      bands: () => [{ axis: "x", from: 1, to: robust, color: CALM_BAND }],
      tell: (_panel, at) => {
        const Ms = column("Ms");
        let i = 0;
        for (let j = 1; j < Ms.length; j++)
          if (Math.abs(Ms[j] - at) < Math.abs(Ms[i] - at) || Number.isNaN(Ms[i])) i = j;
        return `Ms = ${text(Ms[i])}   IAE ${text(column("IAE_disturbance")[i])}   ${x.label} = ${text(ratios[i], 3)}`;
      },
    },
    scale,
  );
  return {
    panels: [...list, price],
    draw({ tau_c, metrics }) {
      const at = tau_c / unit;
      list.forEach((panel, p) => {
        const [key, , , curves] = TRADE_OFFS[p];
        const lowest = Math.min(...curves.map(([name]) => metrics[name]));
        const marks = curves.map(([name, words, color]) => ({
          x: at,
          y: metrics[name],
          color,
          label: `${key === DIRECT ? `${words} ` : ""}${text(metrics[name], 3)}`,
          below: curves.length > 1 && key !== DIRECT && metrics[name] === lowest,
        }));
        panel.show(
          curves.map(([name]) => ({ x: ratios, y: column(name) })),
          marks,
        );
      });
      const pins = table.pins.map((pin, i) => ({
        x: pin.metrics.Ms,
        y: pin.metrics.IAE_disturbance,
        color: shadeOf(U, i),
        label: LETTERS[i],
      }));
      price.show(
        [{ x: column("Ms"), y: column("IAE_disturbance") }],
        [...pins, { x: metrics.Ms, y: metrics.IAE_disturbance, color: U, label: said("present") }],
      );
    },
  };
}
