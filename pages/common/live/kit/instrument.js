// What every instrument does: sliders, figures and panels that follow the hand, lecture, what-if, pictures.
// Python sends tables and, after each release, exact numbers; a subclass knows what they mean:
//   furnished, take(message), panelSets(scale), reading(), figures(now), title(), words(now), release(slider),
//   preset(n)

import { LABELS } from "./curves.js";
import { button } from "./format.js";
import { Lecture } from "./lecture.js";
import { cross } from "./overlay.js";
import { savePng, saveSvg } from "./picture.js";
import { Slider } from "./slider.js";
import { said } from "./words.js";

const PERIOD = 8000; // ms for tau_c to go up and down once
const STEP = 500; // ms from one place to the next where the user asked for less motion
const PATIENCE = 3000; // ms after which an answer that did not come is not waited for any more

export class Instrument {
  constructor(root, { sliders, views, hint }) {
    this.root = root;
    this.waiting = 0;
    this.views = {};
    const find = (selector) => root.querySelector(selector);
    this.name(find);
    const hand = { moved: (slider) => this.moved(slider), released: (slider) => this.release(slider) };
    this.sliders = sliders.map((each) => new Slider(each, hand));
    this.slider = this.sliders.at(-1); // the one that was touched last
    find(".sliders").append(...this.sliders.map((each) => each.row));
    this.tabs = views.map(([view, words]) =>
      Object.assign(
        button(words, "", () => this.look(view)),
        { value: view },
      ),
    );
    find(".views").append(...(views.length > 1 ? this.tabs : []));
    find(".keys").textContent = hint;
    this.lecture = new Lecture(this);
    find(".play").onclick = () => this.sweep();
    find(".lecture").onclick = () => this.lecture.toggle();
    find(".more").onclick = ({ target }) =>
      target.setAttribute("aria-expanded", String(root.classList.toggle("all_numbers")));
    find(".png").onclick = () => savePng(this);
    find(".svg").onclick = () => saveSvg(this);
    root.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => requestAnimationFrame(() => this.fit())).observe(root);
    find(".probe").addEventListener("transitionend", () => this.rebuild()); // the theme's colours changed
    this.look(views[0][0]);
  }

  /** The words of what live.html has. */
  name(find) {
    find(".more").textContent = said("All numbers");
    find(".play").textContent = said("▶ Sweep");
    find(".play").title = said("Move it slowly up and down, then back (space)");
    find(".lecture").textContent = said("Lecture");
    find(".lecture").title = said("Lecture view: large type (L); back with Esc");
    find(".png").title = said("Save the figures as PNG");
    find(".svg").title = said("Save the figures as SVG");
  }

  /** Exact numbers; those of a tau_c that has been left again are not shown. Whether they were taken. */
  confirm(exact) {
    const expected = this.waiting && performance.now() - this.sent < PATIENCE;
    if (expected && exact.answers !== this.waiting) return false;
    if (this.playing || this.sliders.some((slider) => slider.moving)) return false;
    this.waiting = 0;
    this.exact = exact;
    return true;
  }

  /** The user's units on the axes; panels are made anew where they are others. */
  nameAxes(labels) {
    const changed = Object.entries(labels).some(([axis, words]) => LABELS[axis] !== words);
    Object.assign(LABELS, labels);
    if (changed) this.rebuild();
    return true;
  }

  moved(slider) {
    this.slider = slider;
    this.paused = null;
    this.stop();
    this.lecture.haunt();
    this.frame ??= requestAnimationFrame(() => {
      this.frame = null;
      this.show();
    });
  }

  /** Tell Python; its answer carries the same number. */
  ask(what) {
    this.waiting = Date.now();
    this.sent = performance.now();
    this.send({ ...what, n: this.waiting });
  }

  show() {
    if (!this.furnished || this.slider.tau_c === undefined) return;
    const now = this.reading();
    for (const panel of this.views[this.view]?.panels ?? []) panel.moving = !now.exact;
    if (now.curves !== false) this.views[this.view]?.draw(now);
    this.figures(now);
    this.veil();
    this.root.dataset.exact = now.exact;
    this.around(!now.exact && this.movesSettings);
    this.root.dataset.drawn = this.slider.tau_c;
    if (now.exact) this.describe(now);
    this.lecture.settle();
  }

  /** A lesson shows some panels, and some figures or none. panels, figures: names; none of panels: all. */
  stage({ panels, figures, view }) {
    this.staged = { panels, figures };
    this.root.classList.add("staged");
    this.root.style.setProperty("--rows", panels.length === 4 || !panels.length ? 2 : panels.length);
    if (this.view === view) this.veil();
    else this.look(view);
    requestAnimationFrame(() => this.fit());
  }

  veil() {
    if (!this.staged) return;
    const { panels, figures } = this.staged;
    const veiled = (element, yes) => element.style.setProperty("display", yes ? "none" : "");
    for (const cell of this.root.querySelectorAll("[data-figure]"))
      veiled(cell, !figures.includes(cell.dataset.figure));
    veiled(this.root.querySelector(".strip"), !figures.length);
    for (const box of this.root.querySelectorAll("figure"))
      veiled(box, panels.length > 0 && !panels.includes(box.dataset.panel));
    this.root.classList.toggle("few", panels.length > 0 && panels.length < 4);
    this.root.classList.toggle("told", figures.length > 0);
  }

  /** The rest of the page: what it says of the settings waits until they come to rest (parts/style.css). */
  around(moving) {
    document.querySelector("[data-testid=stMain]")?.toggleAttribute("data-moving", moving);
  }

  /** Whether the settings of the controller change under the hand. */
  get movesSettings() {
    return true;
  }

  /** It leaves the page. */
  leave() {
    this.stop();
    if (this.lecture.open) this.lecture.leave();
    this.around(false);
  }

  /** The panels in words, for those who do not see them; only when at rest. */
  describe(now) {
    const veiled = this.lecture.hides || (this.staged && !this.staged.figures.length);
    const words = veiled ? this.title() : this.words(now);
    for (const panel of this.views[this.view].panels)
      panel.plot.setAttribute("aria-label", `${panel.spec.title}. ${words}`);
    this.root.querySelector(".spoken").textContent = words;
  }

  /** Panels anew: another table, theme, or size of type. end: of the time axis; another one ends a zoom there. */
  rebuild(end = this.end) {
    if (!this.furnished) return;
    const { scale } = this.lecture;
    const style = getComputedStyle(this.root);
    const color = style.getPropertyValue("--st-text-color").trim() || style.color;
    this.theme = {
      text: color,
      grid: style.getPropertyValue("--simc-grid"),
      font: style.fontFamily,
      ink: (name) => style.getPropertyValue(name).trim(),
      page: style.getPropertyValue("--st-background-color").trim() || "white",
    };
    const former = Object.fromEntries(this.panels.map((panel) => [panel.spec.key, panel]));
    this.views = this.panelSets(scale);
    for (const [name, { panels }] of Object.entries(this.views)) {
      this.root.querySelector(`.field.${name}`).replaceChildren(...panels.map((panel) => panel.box));
      for (const panel of panels) {
        const { zoom = null, ghost = null } = former[panel.spec.key] ?? {};
        panel.zoom = panel.spec.along === "t" && end !== this.end ? null : zoom;
        panel.ghost = this.lecture.open && ghost?.length === panel.spec.styles.length ? ghost : null;
        panel.pointed = (axis, value) => this.point(axis, value);
        panel.single.onclick = () => this.alone(panel.spec.key);
        panel.box.classList.toggle("shown", panel.spec.key === this.only);
      }
    }
    this.end = end;
    this.lecture.veil();
    this.look(this.view);
    this.lecture.settle();
  }

  /** All panels of all views. */
  get panels() {
    return Object.values(this.views).flatMap(({ panels }) => panels);
  }

  /** As it was, with something hidden or shown. */
  redraw() {
    this.lecture.veil();
    for (const panel of this.panels) panel.redraw();
    this.show();
  }

  /** One crosshair through all panels; value undefined: none. */
  point(axis, value) {
    this.pointer = value === undefined ? null : { axis, value };
    for (const panel of this.views[this.view].panels) cross(panel, axis, value);
  }

  fit() {
    for (const panel of this.views[this.view]?.panels ?? [])
      panel.chart ? panel.resize() : panel.plot.clientWidth && panel.build(this.theme);
  }

  look(view) {
    this.view = view;
    this.root.dataset.view = view;
    for (const tab of this.tabs) tab.setAttribute("aria-pressed", tab.value === view);
    if (!this.views[view]?.panels.some((panel) => panel.spec.key === this.only)) this.only = undefined;
    this.root.classList.toggle("alone", Boolean(this.only));
    this.choose();
    this.fit();
    this.show();
  }

  /** On a narrow screen: a button for each panel of this view. */
  choose() {
    const panels = this.views[this.view]?.panels ?? [];
    const shown = panels.some((panel) => panel.spec.key === this.only) ? this.only : panels[0]?.spec.key;
    this.root.querySelector(".chooser").replaceChildren(
      ...panels.map(({ spec }) => {
        const made = button(spec.short ?? spec.title, "", () => this.alone(spec.key));
        made.setAttribute("aria-pressed", spec.key === shown);
        return made;
      }),
    );
  }

  /** One panel alone, or all again. */
  alone(key) {
    this.only = this.only === key ? undefined : key;
    this.root.classList.toggle("alone", Boolean(this.only));
    for (const box of this.root.querySelectorAll("figure"))
      box.classList.toggle("shown", box.dataset.panel === this.only);
    this.choose();
    requestAnimationFrame(() => {
      this.fit();
      this.show();
    });
  }

  /** The sweep begins, or ends where it began; in a lecture it pauses where it is, and goes on from there. */
  sweep() {
    if (!this.playing) this.play();
    else if (this.lecture.open) this.pause();
    else this.stop(true);
  }

  /** tau_c up and down, from a third to three times where it is; then it goes back, and nothing has changed. */
  play() {
    const slider = this.slider;
    if (slider.fixed) return;
    this.lecture.haunt();
    const { middle, gone } = this.paused ?? { middle: slider.tau_c, gone: 0 };
    const begin = performance.now() - gone;
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.putBack = () => slider.place(middle);
    this.root.querySelector(".play").setAttribute("aria-pressed", "true");
    const step = (now) => {
      const since = calm ? Math.ceil((now - begin) / STEP) * STEP : now - begin;
      this.paused = { middle, gone: since };
      const swing = 3 ** Math.sin((2 * Math.PI * since) / PERIOD);
      const tau_c = Math.min(slider.high, Math.max(slider.low, middle * swing));
      if (tau_c !== slider.tau_c) {
        slider.place(tau_c);
        this.show();
      }
      this.playing = requestAnimationFrame(step);
    };
    this.playing = requestAnimationFrame(step);
  }

  /** The sweep stays where it is, with exact numbers. */
  pause() {
    this.stop();
    this.release(this.slider);
  }

  /** The sweep ends; back: where it began. A hand on the slider takes it from where it is. */
  stop(back = false) {
    if (!this.playing) return;
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    this.root.querySelector(".play").setAttribute("aria-pressed", "false");
    if (!back) return;
    this.paused = null;
    this.putBack();
    this.show();
  }

  key(event) {
    if (event.target.matches("input") || event.ctrlKey || event.metaKey || event.altKey) return;
    const panel = this.views[this.view]?.panels.find((each) => each.box.contains(event.target));
    if (this.preset(Number(event.key))) event.preventDefault();
    else if (event.key === " " && !event.target.matches("button")) this.sweep();
    else if (event.key === "l" || event.key === "L") this.lecture.toggle();
    else if (this.lecture.key(event.key)) event.preventDefault();
    else if (event.key === "Escape" && panel?.zoom) panel.reset();
    else return;
    event.preventDefault();
  }
}
