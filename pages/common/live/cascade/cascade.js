// The instrument of the cascade page: two sliders, one for each loop; each has a table in which the other loop is held.

import { numbers, text } from "../kit/format.js";
import { Instrument } from "../kit/instrument.js";
import { strip } from "../kit/strip.js";
import { between, mix, stencil } from "../kit/table.js";
import { said } from "../kit/words.js";
import { loopsOf, marginsOf } from "./loops.js";
import { cascadePanels } from "./panels.js";

const nothing = ({ cells }) => Object.fromEntries(cells.map(({ name }) => [name, NaN]));
const alike = (a, b) => (a === null || b === null ? a === b : Math.abs(a / b - 1) < 1e-9);

export class Cascade extends Instrument {
  constructor(root) {
    super(root, {
      sliders: ["inner", "outer"].map((name) => ({ name, symbol: name, label: name })),
      views: [["responses", said("Responses")]],
      hint: said("Keys: arrows, Home, End, Tab · space sweep · H hide · R back to begin · L or Esc leave"),
    });
    root.classList.add("two");
    this.tables = {};
    this.decided = {}; // the speed of each loop as last decided, null where it follows
  }

  take(message) {
    if (message.kind === "setup") this.furnish(message);
    else if (message.kind === "table") this.tabulate(message);
    else if (this.nameAxes(message.labels) && this.confirm(message)) {
      this.decided = { inner: message.inner, outer: message.follows ? null : message.outer };
      for (const slider of this.sliders) slider.place(message[slider.name]);
      this.hatches();
      this.show();
    }
  }

  furnish(setup) {
    if (this.setup?.id === setup.id) return;
    this.setup = setup;
    for (const slider of this.sliders) {
      const { symbol, label, ...range } = setup.sliders[slider.name];
      slider.call(symbol, label);
      slider.range({ ...range, unit: 1, symbol: "", fixed: false });
      if (slider.tau_c) slider.place(slider.tau_c);
    }
    this.rebuild(setup.t.at(-1));
  }

  tabulate(table) {
    this.tables[table.loop] = table;
    table.columns = {};
    table.metrics.forEach((name, c) => {
      const at = table.blocks.metrics;
      table.columns[name] = at ? Array.from({ length: at.rows }, (_, r) => at.values[r * at.columns + c]) : [];
    });
    this.hatches();
  }

  hatches() {
    for (const slider of this.sliders) slider.hatch(this.tableOf(slider)?.unstable ?? []);
  }

  /** The table for a slider, if it belongs to what is decided for the other loop. */
  tableOf({ name }) {
    const table = this.tables[name],
      other = name === "inner" ? "outer" : "inner";
    return table && table.setup === this.setup?.id && alike(table.held, this.decided[other]) ? table : undefined;
  }

  get furnished() {
    return Boolean(this.setup);
  }

  panelSets(scale) {
    return { responses: cascadePanels(this.setup, scale) };
  }

  moved(slider) {
    this.decided[slider.name] = slider.tau_c;
    super.moved(slider);
  }

  release(slider) {
    this.decided[slider.name] = slider.tau_c;
    this.ask({ [slider.name]: slider.tau_c });
  }

  preset() {
    return false;
  }

  reading() {
    const { exact, setup } = this;
    if (exact?.setup === setup.id && this.sliders.every((slider) => alike(slider.tau_c, exact[slider.name])))
      return this.readExact(exact);
    const table = this.tableOf(this.slider);
    if (!table) return { exact: false, curves: false, settings: {}, metrics: nothing(setup), why: "" };
    const tau_c = this.slider.tau_c;
    if (table.unstable.some(([from, to]) => tau_c >= from && tau_c <= to))
      return {
        exact: false,
        settings: {},
        metrics: nothing(setup),
        why: table.inner_stable ? said("Cascade not stable") : said("Not stable: one of the loops"),
      };
    const x = Math.log(tau_c),
      at = stencil(x, table.log_tau_c, table.breaks);
    const read = (name) => mix(table.blocks[name], at);
    const metrics = Object.fromEntries(
      table.metrics.map((name) => [name, between(table.columns[name], x, table.log_tau_c)]),
    );
    const named = (loop) => {
      const values = read(`settings_${loop}`);
      return Object.fromEntries(table.settings[loop].map((name, i) => [name, values[i]]));
    };
    if (table.held === null) this.sliders[1].place(read("outer_speed")[0]);
    const loops = loopsOf(setup, read("parameters"));
    const { Ms: Ms_outer, ...margins } = marginsOf(setup.omega, loops.outer);
    return {
      exact: false,
      y1: read("y1"),
      y2: read("y2"),
      u: read("u"),
      loops,
      why: "",
      settings: { inner: named("inner"), outer: named("outer") },
      metrics: { ...margins, Ms_outer, Ms_inner: marginsOf(setup.omega, loops.inner).Ms, ...metrics },
    };
  }

  readExact(exact) {
    const row = (name) => exact.blocks[name] && mix(exact.blocks[name], { first: 0, weights: [1] });
    const why = exact.inner_stable ? said("Cascade not stable") : said("Inner loop not stable on its own");
    return {
      exact: true,
      y1: row("y1"),
      y2: row("y2"),
      u: row("u"),
      loops: loopsOf(this.setup, row("parameters")),
      why: exact.sound ? "" : why,
      settings: exact.settings,
      metrics: numbers(exact.metrics),
    };
  }

  figures({ exact, settings, metrics, why, curves }) {
    const actions = this.exact?.actions ?? {};
    for (const slider of this.sliders)
      slider.tell(settings[slider.name] ?? {}, exact, this.setup.measures, actions[slider.name] ?? "");
    strip(
      this.root.querySelector(".strip"),
      this.setup,
      metrics,
      exact,
      why && said("Not stable: margins and IAE do not exist"),
    );
    this.root.classList.toggle("waits", curves === false);
  }

  title() {
    const [inner, outer] = this.sliders.map(({ tau_c }) => text(tau_c));
    return said("inner {inner}, outer {outer}", { inner, outer });
  }

  words({ why, metrics: m }) {
    const speeds = this.title();
    if (why) return `${speeds}: ${why}`;
    return said(
      "{speeds}: Ms of the outer loop {Ms_outer}, of the inner one {Ms_inner}, " +
        "gain margin {GM}, phase margin {PM} degrees, IAE set point {IAE_r}, d1 {IAE_d1}, d2 {IAE_d2}",
      {
        speeds,
        Ms_outer: text(m.Ms_outer),
        Ms_inner: text(m.Ms_inner),
        GM: text(m.GM),
        PM: text(m.PM_deg),
        IAE_r: text(m.IAE_setpoint),
        IAE_d1: text(m.IAE_d1),
        IAE_d2: text(m.IAE_d2),
      },
    );
  }
}
