// The panels of the tuning view and of the trade-off view: what is drawn in each, from one reading of the table.

const Y = "#0072B2", U = "#D55E00", R = "#8A9096", S_LINE = "#C77C00", ALARM = "#C8442E", REDUCED = "#009E73";
const CALM_BAND = "rgba(0, 158, 115, 0.14)", UNSTABLE_BAND = "rgba(200, 68, 46, 0.13)";
const PIN_DASHES = [[8, 4], [2, 3], [8, 3, 2, 3], [14, 4]];
const SHADES = { [Y]: ["#4C9FD0", "#6FB3DB", "#8CC3E3", "#A5D0EA"], [U]: ["#E68A4A", "#ECA06C", "#F0B38A", "#F4C4A4"], [S_LINE]: ["#D99A3A", "#E0AC5C", "#E7BE80", "#EDCEA0"] };
const LETTERS = "ABCD";
const CIRCLES = [[1.4, 0.61], [1.6, 1.4], [2, 2.27]]; // Ms, and where its label sits on the circle

const pinned = (color, pins) => pins.map((_, i) => ({ color: SHADES[color][i], dash: PIN_DASHES[i], width: 1.6 }));
const atTime = (names) => (panel, x) => {
  const { x: t, y } = panel.curves.at(-1);
  if (!t.length) return "";
  const i = nearest(t, x);
  return `t = ${text(t[i])}   ${names} = ${text(y[i])}`;
};
const extent = (panel, from, to, always, cap) => {
  let [low, high] = always;
  for (const { x, y } of panel.curves.slice(panel.spec.aids ?? 0)) // what only helps the eye does not count
    for (let i = 0; i < y.length; i++)
      if (x[i] >= from && x[i] <= to && Number.isFinite(y[i])) {
        low = Math.min(low, y[i]);
        high = Math.max(high, y[i]);
      }
  return round(Math.max(low, cap[0]), Math.min(high, cap[1]));
};

function responsePanels(table, scale) {
  const { t, omega, pins } = table;
  const over = (y) => ({ x: table.t, y });
  const end = t[t.length - 1];
  const time = { label: "t  [time unit]", limits: () => [0, end] };
  const output = new Panel({
    key: "y", title: "Output y", aids: 2, x: time, tell: atTime("y"),
    legend: [{ text: "y", color: Y }, { text: "r", color: R, dash: true }, { text: `load d at ${text(table.load, 3)}`, color: "#CC79A7", dash: true }],
    y: { label: "y", limits: (p) => extent(p, 0, end, [0, 1.05], table.y_cap) },
    styles: [{ color: R, dash: [5, 4], width: 1.5 }, { color: "#CC79A7", dash: [2, 3], width: 1.2 }, ...pinned(Y, pins), { color: Y, width: 2.2 }],
  }, scale);
  const input = new Panel({
    key: "u", title: "Input u", x: time, tell: atTime("u"), legend: [{ text: "u", color: U }],
    y: { label: "u", limits: (p) => extent(p, 0, end, [0, 0], table.u_cap) },
    styles: [...pinned(U, pins), { color: U, width: 2.2 }],
  }, scale);
  const nyquist = new Panel({
    key: "nyquist", title: "Nyquist L(jω)", square: true,
    legend: [{ text: "L", color: Y }, { text: "Ms circle", color: S_LINE }, { text: "Ms 1.4 1.6 2.0", color: R, dash: true }],
    x: { label: "Re L", limits: () => [-2.4, 0.9] }, y: { label: "Im L", limits: () => [-1.75, 0.8] },
    styles: [{ color: R, width: 1 }, { color: R, width: 1 }, ...CIRCLES.map(() => ({ color: R, dash: [2, 3], width: 1 })),
      { color: S_LINE, width: 1.6 }, ...pinned(Y, pins), { color: Y, width: 2.2 }],
    tell: (panel, x, y) => {
      const { x: re, y: im } = panel.curves.at(-1);
      let best = 0;
      for (let i = 1; i < re.length; i++) if (Math.hypot(re[i] - x, im[i] - y) < Math.hypot(re[best] - x, im[best] - y)) best = i;
      return `ω = ${text(omega[best])}   L = ${text(re[best], 3)} ${im[best] < 0 ? "−" : "+"} ${text(Math.abs(im[best]), 3)} j`;
    },
  }, scale);
  const sensitivity = new Panel({
    key: "sensitivity", title: "|S| and |T|", legend: [{ text: "|S|", color: S_LINE }, { text: "|T|", color: Y, dash: true }],
    x: { label: "ω  [rad/time unit]", log: true, limits: () => [omega[0], omega[omega.length - 1]] },
    y: { label: "", log: true, limits: (p) => [0.01, p.curves.some(({ y }) => y.some((v) => v > 3.2)) ? 100 : 4] },
    styles: [{ color: R, width: 1 }, ...pinned(S_LINE, pins), ...pinned(Y, pins), { color: Y, dash: [9, 4], width: 2 }, { color: S_LINE, width: 2.2 }],
    tell: (panel, x) => {
      const [T, S] = panel.curves.slice(-2), i = nearest(omega, x);
      return `ω = ${text(omega[i])}   |S| = ${text(S.y[i])}   |T| = ${text(T.y[i])}`;
    },
  }, scale);

  const step = { x: [0, 0, end], y: [0, 1, 1] };
  const load = { x: [table.load, table.load], y: [-1e6, 1e6] };
  const pinRows = (name) => pins.map((_, i) => mix(table.blocks[name], { first: i, weights: [1] }));
  const [py, pu, pre, pim] = ["pin_y", "pin_u", "pin_re", "pin_im"].map(pinRows);
  const ps = pre.map((re, i) => sensitivities(re, pim[i]));
  const axes = [{ x: [-1e3, 1e3], y: [0, 0] }, { x: [0, 0], y: [-1e3, 1e3] }];
  const circles = CIRCLES.map(([Ms]) => circle(Ms));
  const labels = CIRCLES.map(([Ms, at]) => ({ x: -1 + Math.cos(at) / Ms, y: Math.sin(at) / Ms, label: Ms.toFixed(1), align: at > 1.5 ? "right" : "left" }));

  return {
    panels: [output, input, nyquist, sensitivity],
    draw({ y, u, re, im, metrics, stable }) {
      const note = stable ? "" : "Loop not stable";
      output.show([step, load, ...py.map(over), over(y)], [], note);
      input.show([...pu.map(over), over(u)], [], note);
      const ring = stable && Number.isFinite(metrics.Ms) ? circle(metrics.Ms) : { x: [], y: [] };
      nyquist.show(
        [...axes, ...circles, ring, ...pre.map((x, i) => ({ x, y: pim[i] })), { x: re, y: im }],
        [...labels, { x: -1, y: 0, color: ALARM, label: "−1", cross: true, align: "right" }], note);
      const { S, T } = sensitivities(re, im);
      const on = (curve) => ({ x: omega, y: curve });
      sensitivity.show([{ x: [omega[0], omega.at(-1)], y: [1, 1] }, ...ps.map((p) => on(p.S)), ...ps.map((p) => on(p.T)), on(T), on(S)], [], note);
    },
  };
}

function circle(Ms) {
  const x = [], y = [];
  for (let i = 0; i <= 120; i++) {
    x.push(-1 + Math.cos((i * Math.PI) / 60) / Ms);
    y.push(Math.sin((i * Math.PI) / 60) / Ms);
  }
  return { x, y };
}

// key, title, log, curves [metric, words, colour], bands over y
const TRADE_OFFS = [
  ["peaks", "Ms, Mt", true, [["Ms", "Ms", S_LINE], ["Mt", "Mt", Y]], [[1.4, 1.7]]],
  ["gain", "Gain margin", true, [["GM", "GM", Y]]],
  ["phase", "Phase margin [°]", false, [["PM_deg", "PM", Y]]],
  ["delay", "Delay margin [time]", true, [["delay_margin", "DM", Y]]],
  ["iae", "IAE", true, [["IAE_setpoint", "r step", Y], ["IAE_load", "d step", U]]],
  ["tv", "TV of u", true, [["TV_setpoint", "r step", Y], ["TV_load", "d step", U]]],
  ["overshoot", "Overshoot, noise", false, [["overshoot", "overshoot", Y], ["noise_gain", "max |KS|", U]]],
];

function tradeOffPanels(table, scale) {
  const { unit, symbol } = table;
  const ratios = table.log_tau_c.map((v) => Math.exp(v) / unit);
  const column = (name) => table.columns[name];
  const known = (values) => values.filter((v) => Number.isFinite(v) && v > 0);
  const x = { label: symbol ? "τc/θ" : "τc", log: true, limits: () => [table.low / unit, table.high / unit] };
  const stability = () => table.unstable.map(([from, to]) => ({ axis: "x", from: Math.max(from, table.low) / unit, to: to / unit, color: UNSTABLE_BAND }));
  const list = TRADE_OFFS.map(([key, title, log, curves, bands = []]) => {
    const limits = () => {
      const values = curves.flatMap(([name]) => known(column(name)));
      if (!values.length) return [0.1, 10];
      const low = Math.min(...values), high = Math.max(...values);
      if (key === "peaks") return [0.9, Math.min(10, Math.max(3, high))];
      return log ? [0.8 * low, Math.max(1.25 * high, 10 * low)] : round(0, high);
    };
    return new Panel({
      key, title, x, y: { label: "", log, limits },
      legend: curves.map(([, words, color], i) => ({ text: words, color, dash: i > 0 })),
      styles: curves.map(([, , color], i) => ({ color, width: 2.2, dash: i ? [8, 4] : undefined })),
      bands: () => [...bands.map(([from, to]) => ({ axis: "y", from, to, color: CALM_BAND })), ...stability()],
      tell: (panel, at) => {
        const i = nearest(ratios, at);
        return [`${x.label} = ${text(ratios[i], 3)}`, ...curves.map(([name, words]) => `${words} ${text(column(name)[i])}`)].join("   ");
      },
    }, scale);
  });
  const price = new Panel({
    key: "price", title: "Speed against robustness", legend: [{ text: "IAE load over Ms", color: Y }],
    x: { label: "Ms", limits: () => [1, 3] },
    y: { label: "IAE load", log: true, limits: () => { const v = known(column("IAE_load")); return v.length ? [0.8 * Math.min(...v), 1.25 * Math.max(...v)] : [0.1, 10]; } },
    styles: [{ color: Y, width: 2.2 }], bands: () => [{ axis: "x", from: 1.4, to: 1.7, color: CALM_BAND }],
    tell: (panel, at) => {
      const Ms = column("Ms");
      let i = 0;
      for (let j = 1; j < Ms.length; j++) if (Math.abs(Ms[j] - at) < Math.abs(Ms[i] - at) || Number.isNaN(Ms[i])) i = j;
      return `Ms = ${text(Ms[i])}   IAE ${text(column("IAE_load")[i])}   ${x.label} = ${text(ratios[i], 3)}`;
    },
  }, scale);
  return {
    panels: [...list, price],
    draw({ tau_c, metrics }) {
      const at = tau_c / unit;
      list.forEach((panel, p) => {
        const curves = TRADE_OFFS[p][3];
        const marks = curves.map(([name, , color]) => ({ x: at, y: metrics[name], color, label: text(metrics[name], 3) }));
        panel.show(curves.map(([name]) => ({ x: ratios, y: column(name) })), marks);
      });
      const pins = table.pins.map((pin, i) => ({ x: pin.metrics.Ms, y: pin.metrics.IAE_load, color: SHADES[U][i], label: LETTERS[i] }));
      price.show([{ x: column("Ms"), y: column("IAE_load") }], [...pins, { x: metrics.Ms, y: metrics.IAE_load, color: U, label: "present" }]);
    },
  };
}
