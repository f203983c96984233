// The instrument of what is dragged by hand: settings of the controller, or the plant with the controller kept.
// While a knob moves, the engine computes the whole picture here; on release Python's exact one takes its place.

import { picture } from "../engine/picture.js";
import { numbers, text } from "../kit/format.js";
import { Instrument } from "../kit/instrument.js";
import { strip } from "../kit/strip.js";
import { mix } from "../kit/table.js";
import { listed, said } from "../kit/words.js";
import { responsePanels } from "../tuning/panels.js";
import { turned } from "./knobs.js";

const KNOBS = 3; // settings, or k, theta and tau1; fewer where the plant or the controller has no more
const WARM_UP = 10; // pictures that are drawn for nobody, so that the first drag is as quick as the others

export class Hand extends Instrument {
  constructor(root) {
    super(root, {
      sliders: Array.from({ length: KNOBS }, (_, i) => ({ name: i, symbol: "", label: "" })),
      views: [["responses", said("Responses")]],
      hint: said("Keys: arrows, Page up and down, Home, End move a knob · H hide · R return · L or Esc back"),
    });
    root.classList.add("hand");
    root.querySelector(".play").hidden = true;
  }

  take(message) {
    if (message.kind === "setup") this.furnish(message);
    else if (this.nameAxes(message.labels) && this.confirm(message)) {
      for (const slider of this.used) slider.place(message.values[slider.name]);
      this.show();
    }
  }

  furnish(setup) {
    if (this.setup?.id === setup.id) return;
    this.setup = setup;
    this.used = setup.knobs.map((knob, i) => {
      const slider = this.sliders[i];
      slider.name = knob.name;
      slider.call(knob.symbol, knob.label);
      slider.range({ ...knob, unit: 1, symbol: "", fixed: false });
      slider.place(knob.value);
      return slider;
    });
    this.sliders.forEach((slider, i) => {
      slider.row.hidden = i >= setup.knobs.length;
    });
    this.slider = this.used[0];
    this.rebuild(setup.t.at(-1));
    (globalThis.requestIdleCallback ?? setTimeout)(() => {
      for (let i = 0; i < WARM_UP; i++) this.drawn();
    });
  }

  get furnished() {
    return Boolean(this.setup);
  }

  panelSets(scale) {
    return { responses: responsePanels(this.setup, scale) };
  }

  get movesSettings() {
    return this.setup.moves_settings;
  }

  get values() {
    return Object.fromEntries(this.used.map(({ name, tau_c }) => [name, tau_c]));
  }

  release() {
    this.ask({ values: this.values });
  }

  preset() {
    return false;
  }

  /** The picture at the knobs; null where the engine has none, and the last one stays until it is released. */
  drawn() {
    const { plant, controller } = turned(this.setup, this.values);
    return picture(plant, controller, this.setup.steps, this.setup.t.at(-1));
  }

  reading() {
    const { exact, values } = this;
    const same = exact?.setup === this.setup.id && Object.entries(values).every(([k, v]) => near(v, exact.values[k]));
    if (same) {
      const row = (name) => mix(exact.blocks[name], { first: 0, weights: [1] });
      const [y, u, re, im] = ["y", "u", "re", "im"].map(row);
      return { exact: true, stable: exact.stable, y, u, re, im, metrics: numbers(exact.metrics) };
    }
    const now = this.drawn();
    if (!now) return { curves: false, exact: false, stable: true, metrics: {} };
    const { t: at, omega: frequencies, y, u, re, im, stable, figures } = now;
    return { exact: false, stable, y, u, re, im, at, frequencies, metrics: figures ?? {} };
  }

  figures({ exact, stable, metrics }) {
    strip(this.root.querySelector(".strip"), this.setup, metrics, exact, stable ? "" : said("not stable"));
  }

  title() {
    return listed(this.used.map((slider) => `${slider.name} = ${text(slider.tau_c)}`));
  }

  words({ stable, metrics: m }) {
    const at = this.title();
    if (!stable) return said("{settings}: the loop is not stable", { settings: at });
    return said("{settings}: Ms {Ms}, gain margin {GM}, phase margin {PM} degrees", {
      settings: at,
      Ms: text(m.Ms),
      GM: text(m.GM),
      PM: text(m.PM_deg),
    });
  }
}

const near = (a, b) => a === b || Math.abs(a / b - 1) < 1e-9;
