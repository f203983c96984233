// The instrument of the tuning page: one slider, four panels, the trade-off, presets, the smallest tau_c for an Ms.

import { button, numbers, text } from "../kit/format.js";
import { Instrument } from "../kit/instrument.js";
import { strip } from "../kit/strip.js";
import { between, mix, stencil } from "../kit/table.js";
import { said } from "../kit/words.js";
import { responsePanels } from "./panels.js";
import { tradeOffPanels } from "./tradeoff.js";

export class Tuning extends Instrument {
  constructor(root) {
    super(root, {
      sliders: [{ name: "tau_c", symbol: "τ<sub>c</sub>", label: said("Closed-loop time constant tau_c") }],
      views: [
        ["responses", said("Responses")],
        ["tradeoff", said("Trade-off")],
      ],
      hint: said("Keys: arrows, Home, End, presets 1, 2, … · space sweep · H hide · R back to begin · L or Esc leave"),
    });
    const wanted = document.createElement("label");
    wanted.title = said("Sets tau_c to the smallest with this Ms");
    wanted.innerHTML = `${said("Fastest τ<sub>c</sub> with Ms up to")} <input class="ms" inputmode="decimal"
      maxlength="100">`;
    const peak = wanted.lastChild;
    peak.setAttribute("aria-label", said("Fastest tau_c with Ms up to"));
    const find = () => peak.value && this.ask({ Ms: peak.value }); // as typed: Python reads it
    peak.addEventListener("keydown", (event) => event.key === "Enter" && find());
    root.querySelector(".extras").append(wanted, button(said("Find"), wanted.title, find));
  }

  take(message) {
    if (message.kind === "table") this.tabulate(message);
    else if (this.nameAxes(message.labels) && this.confirm(message)) {
      this.slider.place(message.tau_c);
      this.show();
    }
  }

  tabulate(table) {
    if (this.table?.id === table.id) return;
    this.table = table;
    const at = table.blocks.metrics;
    table.columns = Object.fromEntries(
      table.metrics.map((name, c) => [name, Array.from({ length: at.rows }, (_, r) => at.values[r * at.columns + c])]),
    );
    this.slider.range(table);
    this.slider.hatch(table.unstable);
    this.root
      .querySelector(".presets")
      .replaceChildren(
        ...table.presets.map(([name], i) =>
          button(`${i + 1} ${name}`, said("Key {n}", { n: i + 1 }), () => this.preset(i + 1)),
        ),
      );
    this.rebuild(table.t.at(-1));
  }

  get furnished() {
    return Boolean(this.table);
  }

  panelSets(scale) {
    return { responses: responsePanels(this.table, scale), tradeoff: tradeOffPanels(this.table, scale) };
  }

  release(slider) {
    this.ask({ tau_c: slider.tau_c });
  }

  /** Take the n-th preset; false where there is none. */
  preset(n) {
    const [, tau_c] = this.table?.presets[n - 1] ?? [];
    if (!tau_c) return false;
    this.stop();
    this.slider.place(tau_c);
    this.moved(this.slider);
    this.release(this.slider);
    return true;
  }

  /** What is to be drawn at the present tau_c: exact where Python has given it, else read from the table. */
  reading() {
    const { table, exact } = this;
    const tau_c = this.slider.tau_c;
    if (exact && exact.table === table.id && Math.abs(tau_c / exact.tau_c - 1) < 1e-9) {
      const row = (name) => mix(exact.blocks[name], { first: 0, weights: [1] });
      return {
        tau_c,
        exact: true,
        stable: exact.stable,
        y: row("y"),
        u: row("u"),
        re: row("re"),
        im: row("im"),
        settings: exact.settings,
        metrics: numbers(exact.metrics),
      };
    }
    const x = Math.log(tau_c),
      at = stencil(x, table.log_tau_c, table.breaks);
    const read = (name) => mix(table.blocks[name], at);
    const stable = !table.unstable.some(([from, to]) => tau_c >= from && tau_c <= to);
    const metrics = Object.fromEntries(
      table.metrics.map((name) => [name, stable ? between(table.columns[name], x, table.log_tau_c) : NaN]),
    );
    const values = read("settings");
    return {
      tau_c,
      exact: false,
      stable,
      y: read("y"),
      u: read("u"),
      re: read("re"),
      im: read("im"),
      settings: Object.fromEntries(table.settings.map((name, i) => [name, values[i]])),
      metrics,
    };
  }

  figures({ exact, stable, settings, metrics }) {
    this.slider.tell(settings, exact, this.table.measures, this.table.action);
    strip(
      this.root.querySelector(".strip"),
      this.table,
      metrics,
      exact,
      stable ? "" : said("Not stable: margins and IAE do not exist"),
    );
  }

  title() {
    return `τc = ${text(this.slider.tau_c)}`;
  }

  words({ tau_c, stable, metrics: m }) {
    if (!stable) return said("tau_c {tau_c}: the loop is not stable", { tau_c: text(tau_c) });
    return said(
      "tau_c {tau_c}: Ms {Ms}, gain margin {GM}, phase margin {PM} degrees, " +
        "IAE set point {IAE_r}, load {IAE_d}, overshoot {overshoot} percent",
      {
        tau_c: text(tau_c),
        Ms: text(m.Ms),
        GM: text(m.GM),
        PM: text(m.PM_deg),
        IAE_r: text(m.IAE_setpoint),
        IAE_d: text(m.IAE_disturbance),
        overshoot: text(100 * m.overshoot, 3),
      },
    );
  }
}
