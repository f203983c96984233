// The instrument: slider, figures and panels. Python sends a table over tau_c and, after each release, exact numbers.

const FIGURES = [
  ["Ms", "Ms, peak of |S|"], ["GM", "Gain margin"], ["PM_deg", "Phase margin °"], ["delay_margin", "Delay margin"],
  ["IAE_setpoint", "IAE set point"], ["IAE_load", "IAE load"], ["Mt", "Mt, peak of |T|"], ["TV_setpoint", "TV set point"],
  ["TV_load", "TV load"], ["overshoot", "Overshoot %"], ["noise_gain", "Noise gain"],
];
const BANDS = [[1.6, "calm", "calm: robust (≤ 1.6)"], [2, "attention", "attention: little to spare (≤ 2.0)"], [Infinity, "alarm", "alarm: too close to −1 (> 2.0)"]];
const PERIOD = 8000; // ms for tau_c to go up and down once
const PATIENCE = 3000; // ms after which an answer that did not come is not waited for any more

class Live {
  constructor(root) {
    this.root = root;
    this.waiting = 0;
    this.views = {};
    const find = (selector) => root.querySelector(selector);
    this.value = find(".value");
    this.slider = new Slider(root, {
      moved: (tau_c) => this.stop() || this.move(tau_c),
      released: (tau_c) => this.release({ tau_c }),
      say: (tau_c) => this.say(tau_c),
    });
    root.querySelectorAll("[data-view]").forEach((button) => (button.onclick = () => this.look(button.dataset.view)));
    root.querySelectorAll("[data-one]").forEach((button) => (button.onclick = () => this.alone(button.dataset.one)));
    find(".ms").addEventListener("change", (event) => event.target.value && this.release({ Ms: Number(event.target.value) }));
    find(".play").onclick = () => (this.playing ? this.stop(true) : this.play());
    find(".lecture").onclick = () => this.lecture();
    find(".png").onclick = () => savePicture(this);
    root.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => requestAnimationFrame(() => this.fit())).observe(root);
    find(".probe").addEventListener("transitionend", () => this.rebuild()); // the theme's colours changed
    this.look("responses");
  }

  take(data) {
    const message = unpack(data);
    if (message.kind === "table") this.tabulate(message);
    else this.confirm(message);
  }

  tabulate(table) {
    this.table = table;
    const at = table.blocks.metrics;
    table.columns = Object.fromEntries(table.metrics.map((name, c) => [name, Array.from({ length: at.rows }, (_, r) => at.values[r * at.columns + c])]));
    this.slider.range(table);
    this.root.querySelector(".presets").replaceChildren(
      ...table.presets.map(([name, tau_c], i) => {
        const button = document.createElement("button");
        button.type = "button";
        button.textContent = `${i + 1} ${name}`;
        button.onclick = () => this.jump(tau_c);
        return button;
      }),
    );
    this.rebuild();
  }

  /** Exact numbers; those of a tau_c that has been left again are not shown. */
  confirm(exact) {
    const expected = this.waiting && performance.now() - this.sent < PATIENCE;
    if (expected && exact.answers !== this.waiting) return;
    if (this.slider.dragging || this.playing) return;
    this.waiting = 0;
    this.exact = exact;
    this.slider.place(exact.tau_c);
    this.show();
  }

  move(tau_c) {
    this.slider.place(tau_c);
    this.frame ??= requestAnimationFrame(() => {
      this.frame = null;
      this.show();
    });
  }

  jump(tau_c) {
    this.stop();
    this.move(tau_c);
    this.release({ tau_c });
  }

  release(what) {
    this.waiting = Date.now();
    this.sent = performance.now();
    this.send({ ...what, n: this.waiting });
  }

  /** What is to be drawn at the present tau_c: exact where Python has given it, else read from the table. */
  reading() {
    const { table, exact } = this;
    const tau_c = this.slider.tau_c;
    if (exact && exact.table === table.id && Math.abs(tau_c / exact.tau_c - 1) < 1e-9) {
      const row = (name) => mix(exact.blocks[name], { first: 0, weights: [1] });
      return { tau_c, exact: true, stable: exact.stable, y: row("y"), u: row("u"), re: row("re"), im: row("im"),
        settings: exact.settings, metrics: numbers(exact.metrics) };
    }
    const x = Math.log(tau_c), at = stencil(x, table.log_tau_c, table.breaks);
    const read = (name) => mix(table.blocks[name], at);
    const stable = !table.unstable.some(([from, to]) => tau_c >= from && tau_c <= to);
    const metrics = Object.fromEntries(table.metrics.map((name) => [name, stable ? between(table.columns[name], x, table.log_tau_c) : NaN]));
    const values = read("settings");
    return { tau_c, exact: false, stable, y: read("y"), u: read("u"), re: read("re"), im: read("im"),
      settings: Object.fromEntries(table.settings.map((name, i) => [name, values[i]])), metrics };
  }

  show() {
    if (!this.table || !this.slider.tau_c) return;
    const now = (this.now = this.reading());
    this.views[this.view]?.draw(now);
    this.figures(now);
    this.root.dataset.exact = now.exact;
    this.root.dataset.drawn = now.tau_c;
  }

  figures({ tau_c, exact, stable, settings, metrics }) {
    const { unit, symbol } = this.table;
    const ratio = symbol ? ` = ${text(tau_c / unit, 3)} ${symbol}` : "";
    this.value.textContent = `${text(tau_c)}${ratio}`;
    this.root.querySelector(".settings").innerHTML = Object.entries(settings)
      .map(([name, value]) => `<span title="${exact ? value : ""}">${LABELS[name] ?? name} <b>${text(value)}</b></span>`).join("");
    const strip = this.root.querySelector(".strip");
    const [, band, words] = BANDS.find(([limit]) => metrics.Ms <= limit) ?? BANDS[2];
    strip.className = `strip ${stable ? band : "alarm"}`;
    strip.innerHTML = FIGURES.map(([name, label], i) => {
      const value = name === "overshoot" ? 100 * metrics[name] : metrics[name];
      const more = i ? "" : `<span>${stable ? words : "loop not stable: no margins"}</span>`;
      return `<div data-figure="${name}" title="${exact ? value : "read from the table; exact when released"}"><small>${label}</small><b>${text(value, exact ? 4 : 3)}</b>${more}</div>`;
    }).join("");
    if (exact) this.describe(stable, metrics);
  }

  /** The panels in words, for those who do not see them; only when at rest. */
  describe(stable, m) {
    const words = stable
      ? `tau_c ${text(this.slider.tau_c)}: Ms ${text(m.Ms)}, gain margin ${text(m.GM)}, phase margin ${text(m.PM_deg)} degrees, IAE set point ${text(m.IAE_setpoint)}, load ${text(m.IAE_load)}, overshoot ${text(100 * m.overshoot, 3)} percent`
      : `tau_c ${text(this.slider.tau_c)}: the loop is not stable`;
    for (const panel of this.views[this.view].panels) panel.plot.setAttribute("aria-label", `${panel.spec.title}. ${words}`);
    this.root.querySelector(".spoken").textContent = words;
  }

  say(tau_c) {
    const { unit, symbol } = this.table;
    return `${text(tau_c)}${symbol ? `, ${text(tau_c / unit, 3)} times theta` : ""}`;
  }

  /** Panels anew: another table, theme, or size of type. */
  rebuild() {
    if (!this.table) return;
    const scale = this.root.matches(":popover-open") ? 1.7 : 1;
    const style = getComputedStyle(this.root);
    const color = style.getPropertyValue("--st-text-color").trim() || style.color;
    this.theme = { text: color, grid: "rgba(138,144,150,0.22)", font: style.fontFamily,
      page: style.getPropertyValue("--st-background-color").trim() || "#fff" };
    const zooms = Object.fromEntries(Object.values(this.views).flatMap((v) => v.panels).map((p) => [p.spec.key, p.zoom]));
    this.views = { responses: responsePanels(this.table, scale), tradeoff: tradeOffPanels(this.table, scale) };
    for (const [name, { panels }] of Object.entries(this.views)) {
      this.root.querySelector(`.field.${name}`).replaceChildren(...panels.map((panel) => panel.box));
      for (const panel of panels) {
        panel.zoom = panel.spec.x.label.startsWith("t ") && this.end !== this.table.t.at(-1) ? null : zooms[panel.spec.key] ?? null;
        panel.box.querySelector("button").onclick = () => this.alone(panel.spec.key);
        panel.box.classList.toggle("shown", panel.spec.key === this.only);
      }
    }
    this.end = this.table.t.at(-1);
    this.look(this.view);
  }

  fit() {
    for (const panel of this.views[this.view]?.panels ?? []) panel.chart ? panel.resize() : panel.plot.clientWidth && panel.build(this.theme);
  }

  look(view) {
    this.view = view;
    this.root.dataset.view = view;
    this.root.querySelectorAll("[data-view]").forEach((b) => b.setAttribute("aria-pressed", b.dataset.view === view));
    this.fit();
    this.show();
  }

  /** One panel alone, or all again. */
  alone(key) {
    this.only = this.only === key ? undefined : key;
    this.root.classList.toggle("alone", Boolean(this.only));
    this.root.querySelectorAll("figure").forEach((box) => box.classList.toggle("shown", box.dataset.panel === this.only));
    this.root.querySelectorAll("[data-one]").forEach((b) => b.setAttribute("aria-pressed", b.dataset.one === (this.only ?? "y")));
    requestAnimationFrame(() => {
      this.fit();
      this.show();
    });
  }

  /** What happens if: tau_c up and down, from a third to three times where it is. */
  play() {
    const { low, high } = this.slider;
    if (this.slider.fixed) return;
    const middle = this.slider.tau_c, begin = performance.now();
    this.root.querySelector(".play").setAttribute("aria-pressed", "true");
    const step = (now) => {
      const swing = 3 ** Math.sin((2 * Math.PI * (now - begin)) / PERIOD);
      this.slider.place(Math.min(high, Math.max(low, middle * swing)));
      this.show();
      this.playing = requestAnimationFrame(step);
    };
    this.playing = requestAnimationFrame(step);
  }

  stop(release = false) {
    if (!this.playing) return;
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    this.root.querySelector(".play").setAttribute("aria-pressed", "false");
    if (release) this.release({ tau_c: this.slider.tau_c });
  }

  lecture() {
    const open = this.root.matches(":popover-open");
    if (open) {
      this.root.hidePopover();
      this.root.removeAttribute("popover");
    } else {
      this.root.popover = "manual"; // the top layer: above Streamlit's header, and no request for full screen needed
      this.root.showPopover();
    }
    this.root.querySelector(".lecture").setAttribute("aria-pressed", !open);
    this.rebuild();
    this.root.querySelector("[role=slider]").focus();
  }

  key(event) {
    if (event.target.matches("input") || event.ctrlKey || event.metaKey || event.altKey) return;
    const preset = this.table?.presets[Number(event.key) - 1];
    if (preset) this.jump(preset[1]);
    else if (event.key === " " && !event.target.matches("button")) this.playing ? this.stop(true) : this.play();
    else if (event.key === "l") this.lecture();
    else if (event.key === "Escape" && this.root.matches(":popover-open")) this.lecture();
    else return;
    event.preventDefault();
  }
}

const LABELS = { tau_I: "τI", tau_D: "τD", tau_F: "τF", K_I: "KI" };

/** Figures from JSON, which has neither infinity nor nan. */
function numbers(given) {
  return Object.fromEntries(Object.entries(given).map(([name, v]) => [name, v === null ? NaN : v === "inf" ? Infinity : v]));
}

/** All panels in sight as one PNG with their titles. */
function savePicture(live) {
  const shown = live.views[live.view].panels.filter((panel) => panel.box.offsetParent);
  const ratio = devicePixelRatio, origin = live.root.querySelector(`.field.${live.view}`).getBoundingClientRect();
  const sheet = document.createElement("canvas");
  sheet.width = origin.width * ratio;
  sheet.height = origin.height * ratio;
  const ctx = sheet.getContext("2d");
  ctx.fillStyle = live.theme.page;
  ctx.fillRect(0, 0, sheet.width, sheet.height);
  ctx.fillStyle = live.theme.text;
  ctx.font = `600 ${13 * ratio}px ${live.theme.font}`;
  for (const { box, plot, chart, spec } of shown) {
    const head = box.getBoundingClientRect(), at = plot.getBoundingClientRect();
    ctx.fillText(`${spec.title}   τc = ${live.value.textContent}`, (head.left - origin.left + 4) * ratio, (head.top - origin.top + 16) * ratio);
    ctx.drawImage(chart.ctx.canvas, (at.left - origin.left) * ratio, (at.top - origin.top) * ratio);
  }
  const link = document.createElement("a");
  link.href = sheet.toDataURL("image/png");
  link.download = `simc-tau_c-${text(live.now.tau_c).replace(/[^\d.e-]/g, "")}.png`;
  link.click();
}

const lives = (globalThis.simcLives ??= new Map()); // the instrument on the page; the exact numbers find it here

export default function ({ parentElement, data, setStateValue, key }) {
  let live = lives.get(parentElement);
  if (!live) {
    live = new Live(parentElement.querySelector(".live"));
    lives.set(parentElement, live);
    globalThis.simcLive = live;
    globalThis.simcExact = (bytes) => live.take(bytes);
  }
  live.send = (what) => setStateValue("release", what);
  live.take(data);
  if (globalThis.simcPending) {
    live.take(globalThis.simcPending);
    globalThis.simcPending = undefined;
  }
  return () => {
    live.stop();
    lives.delete(parentElement);
    if (globalThis.simcLive === live) globalThis.simcLive = globalThis.simcExact = undefined;
  };
}
