// The lecture view: the instrument as a modal dialog, readable from the last row, with what a class guesses hidden.

import { button } from "./format.js";
import { said } from "./words.js";

const ON_SCREEN = 28; // px of all letters on a screen of 1920 x 1080, about 10 minutes of arc from the last row
const SCREEN = [1920, 1080];
const LEAST = 14; // px, where the screen is small and near
const ROOM = [900, 600]; // px: less has one panel
const HIDDEN = [
  ["numbers", said("numbers"), said("Hide the numbers; H shows them again")],
  ["curves", said("curves"), said("Hide the curves; H shows them again")],
  ["future", said("future"), said("Hide the future; H shows it again")],
];

/** px of letters: they grow with the smaller side. */
export const typeFor = (width, height) => Math.max(LEAST, ON_SCREEN * Math.min(width / SCREEN[0], height / SCREEN[1]));

export const crowded = (width, height) => width < ROOM[0] || height < ROOM[1];

export class Lecture {
  constructor(live) {
    this.live = live;
    this.dialog = null;
    this.hides = ""; // one of HIDDEN while it is hidden
    this.last = "numbers"; // what H hides
    this.bar = document.createElement("div");
    this.bar.className = "lecturing";
    this.hiders = HIDDEN.map(([what, name, title]) =>
      Object.assign(
        button(name, title, () => this.hide(what)),
        { value: what },
      ),
    );
    this.back = button(said("Return"), said("To where the lecture began (R)"), () => this.toBegin());
    this.code = button("QR", said("This view as a link for phones (Q)"), () => this.link());
    this.bar.append(said("Hide"), " ", ...this.hiders, this.back, this.code);
    live.root.querySelector(".bar").append(this.bar);
  }

  get open() {
    return Boolean(this.dialog);
  }

  /** px of the smallest letters on the axes, over those outside a lecture. */
  get scale() {
    return this.open ? typeFor(innerWidth, innerHeight) / 11 : 1;
  }

  enter() {
    const { live } = this;
    this.begun = live.sliders.map((slider) => slider.tau_c);
    this.dialog = document.createElement("dialog");
    this.dialog.className = "hall";
    this.dialog.setAttribute("aria-label", said("Lecture view"));
    this.card = Object.assign(document.createElement("div"), { className: "card", hidden: true });
    live.root.before(this.dialog);
    this.formulas = Object.assign(document.createElement("div"), { className: "told" });
    live.root.prepend(this.formulas);
    this.dialog.append(live.root, this.card);
    this.dialog.addEventListener("cancel", (event) => {
      event.preventDefault();
      this.leave();
    });
    this.resized = () => this.fit();
    addEventListener("resize", this.resized);
    this.dialog.showModal();
    this.fit();
    this.tell();
    live.slider.handle.focus();
  }

  leave() {
    const { live, dialog } = this;
    this.hide("");
    live.stop(true);
    removeEventListener("resize", this.resized);
    this.formulas.remove();
    dialog.before(live.root);
    dialog.remove();
    this.dialog = null;
    live.rebuild();
    live.root.querySelector(".lecture").setAttribute("aria-pressed", "false");
    live.root.querySelector(".lecture").focus();
  }

  fit() {
    const { live } = this;
    this.dialog.style.setProperty("--type", `${typeFor(innerWidth, innerHeight)}px`);
    if (crowded(innerWidth, innerHeight) && !live.only) live.alone(live.views[live.view]?.panels[0]?.spec.key);
    live.root.querySelector(".lecture").setAttribute("aria-pressed", "true");
    live.rebuild();
  }

  /** G(s) and C(s) as the page has them typeset, perhaps later than we come; MathML needs no style of its own. */
  tell(tries = 20) {
    const found = [
      ...document.querySelectorAll(":is(.st-key-line, .st-key-decided, .st-key-lesson_plant) .katex-mathml math"),
    ].filter((math) => /^[GC](_\w+)?\(s\)/.test(math.querySelector("annotation")?.textContent ?? ""));
    this.formulas.replaceChildren(
      ...found.map((math) => Object.assign(math.cloneNode(true), { style: "math-style: normal" })),
    );
    if (!found.length && tries && this.open) setTimeout(() => this.tell(tries - 1), 250);
  }

  /** Hide it, or show it again. */
  hide(what) {
    this.hides = this.hides === what ? "" : what;
    if (what) this.last = what;
    for (const hider of this.hiders) hider.setAttribute("aria-pressed", String(hider.value === this.hides));
    this.live.root.dataset.hides = this.hides;
    this.live.redraw();
  }

  /** The panels know what is hidden: the future from the crosshair on, or from the middle. */
  veil() {
    const { pointer, end, panels } = this.live;
    for (const panel of panels) {
      panel.hides = this.hides === "numbers" ? "" : this.hides;
      // a frequency tells the whole future
      panel.until = panel.spec.along !== "t" ? -Infinity : pointer?.axis === "t" ? pointer.value : end / 2;
    }
  }

  /** The curves as they are stay behind those that come. */
  haunt() {
    if (!this.open || this.live.root.dataset.exact !== "true") return;
    for (const panel of this.live.panels) panel.ghost = panel.curves;
  }

  toggle() {
    if (this.open) this.leave();
    else this.enter();
  }

  toBegin() {
    const { live } = this;
    live.stop();
    live.sliders.forEach((slider, i) => {
      if (this.begun[i] !== undefined && slider.tau_c !== this.begun[i]) {
        slider.place(this.begun[i]);
        live.moved(slider);
        live.release(slider);
      }
    });
  }

  /** Ask for the link of this view, or put the code away. */
  link() {
    this.card.hidden = !this.card.hidden;
    this.card.replaceChildren("…");
    if (!this.card.hidden) this.live.ask({ link: { view: this.live.view, panel: this.live.only ?? "" } });
  }

  /** message: the link, and its code as the address of a picture. */
  show({ link, qr }) {
    if (!this.open || this.card.hidden) return;
    const code = Object.assign(document.createElement("img"), { src: qr, alt: said("QR code of the link below") });
    const words = Object.assign(document.createElement("div"), { textContent: link });
    this.card.replaceChildren(code, words);
  }

  /** A link asks for the lecture view, with this view and panel. */
  asked(place) {
    this.wanted = place;
    this.settle();
  }

  /** What was asked for, as soon as there are panels. */
  settle() {
    const { live, wanted } = this;
    if (!wanted || !live.furnished || live.slider.tau_c === undefined) return; // what R returns to is not known yet
    this.wanted = null;
    const { view, panel } = wanted;
    if (live.views[view]) live.look(view);
    if (!this.open) this.enter();
    if (live.views[live.view]?.panels.some(({ spec }) => spec.key === panel) && live.only !== panel) live.alone(panel);
  }

  /** Whether the key meant something here. */
  key(key) {
    if (!this.open) return false;
    const does = {
      h: () => this.hide(this.hides || this.last),
      r: () => this.toBegin(),
      q: () => this.link(),
    }[key.toLowerCase()];
    does?.();
    return Boolean(does);
  }
}
