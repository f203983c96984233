// tau_c or lambda on a logarithmic track: mouse, touch, keyboard. Ranges without a stable loop are hatched.

import { measured } from "./curves.js";
import { STEPS, text } from "./format.js";
import { presses } from "./presses.js";
import { escaped } from "./svg.js";
import { numeral, said } from "./words.js";

export class Slider {
  /**
   * name: for the instrument; symbol: HTML; label: for those who do not see it.
   * moved(slider): while it moves.   released(slider): when it comes to rest.
   */
  constructor({ name, symbol, label }, { moved, released }) {
    Object.assign(this, { name, moved, released, dragging: false, held: false });
    this.pressed = presses(
      (yes) => {
        this.held = yes;
      },
      () => this.released(this),
    );
    this.row = document.createElement("div");
    this.row.className = "top";
    this.row.innerHTML = `<div class="now"><span class="symbol"></span> = <output class="value">–</output></div>
      <div class="track">
        <div class="rail"></div>
        <div class="handle" role="slider" tabindex="0" aria-orientation="horizontal"></div>
        <div class="scale" aria-hidden="true"></div>
      </div>
      <div class="settings"></div>`;
    const find = (selector) => this.row.querySelector(selector);
    [this.value, this.track, this.rail, this.scale, this.handle, this.settings] = [
      ".value",
      ".track",
      ".rail",
      ".scale",
      ".handle",
      ".settings",
    ].map(find);
    this.call(symbol, label);
    this.track.addEventListener("pointerdown", (event) => this.grab(event));
    this.track.addEventListener("pointermove", (event) => this.dragging && this.follow(event));
    for (const end of ["pointerup", "pointercancel"]) this.track.addEventListener(end, () => this.drop());
    this.handle.addEventListener("keydown", (event) => this.key(event));
  }

  /** symbol: HTML; label: for those who do not see it. */
  call(symbol, label) {
    this.row.querySelector(".symbol").innerHTML = symbol;
    this.handle.setAttribute("aria-label", label);
  }

  /**
   * low, high of tau_c; unit: the length of 1 on the scale, and its symbol; fixed: no choice of tau_c.
   * zero: the left end means 0.   what: is set here, see `measured`.
   */
  range({ low, high, unit, symbol, fixed, zero, what = "time" }) {
    Object.assign(this, { low, high, unit, symbol, fixed, zero, what });
    this.handle.setAttribute("aria-valuemin", low);
    this.handle.setAttribute("aria-valuemax", high);
    this.handle.setAttribute("aria-disabled", String(fixed));
    this.scale.replaceChildren(
      ...STEPS.filter((v) => v * unit >= low * 0.999 && v * unit <= high * 1.001).map((v) => {
        const tick = document.createElement("span");
        tick.style.left = `${100 * this.share(v * unit)}%`;
        tick.className = /^1/.test(v.toExponential()) ? "decade" : "";
        tick.textContent = `${text(v)} ${symbol}`;
        return tick;
      }),
    );
  }

  /** unstable: [[low, high]] of tau_c. */
  hatch(unstable) {
    this.rail.replaceChildren(
      ...unstable.map(([from, to]) => {
        const hatch = document.createElement("div");
        hatch.className = "hatch";
        hatch.title = said("not stable from {low} to {high}", { low: text(from, 3), high: text(to, 3) });
        hatch.style.left = `${100 * this.share(from)}%`;
        hatch.style.width = `${100 * (this.share(to) - this.share(from))}%`;
        return hatch;
      }),
    );
  }

  share(tau_c) {
    const s = Math.log(Math.max(tau_c, this.low) / this.low) / Math.log(this.high / this.low);
    return Math.min(1, Math.max(0, s));
  }

  /** Put the handle there without telling anybody. */
  place(tau_c) {
    this.tau_c = tau_c;
    const ratio = text(tau_c / this.unit, 3);
    const size = measured(text(tau_c), this.what);
    this.value.textContent = `${size}${this.symbol ? ` = ${ratio} ${this.symbol}` : ""}`;
    this.handle.style.left = `${100 * this.share(tau_c)}%`;
    this.handle.setAttribute("aria-valuenow", tau_c);
    const spoken = this.symbol ? said("{size}, {ratio} times theta", { size, ratio }) : size;
    this.handle.setAttribute("aria-valuetext", spoken);
  }

  /** The controller's settings there; exact: all digits on hover; measures: what each is of; action: in words. */
  tell(settings, exact, measures, action) {
    const each = Object.entries(settings).map(([name, value]) => {
      const size = escaped(measured(text(value), measures[name]));
      return `<span title="${exact ? numeral(value) : ""}">${typeset(name)} <b>${size}</b></span>`;
    });
    this.settings.innerHTML = [...each, `<span class="action">${action}</span>`].join("");
  }

  move(tau_c) {
    const within = Math.min(this.high, Math.max(this.low, tau_c));
    const ratio = Number((within / this.unit).toPrecision(3));
    this.place(this.zero && within === this.low ? 0 : ratio * this.unit);
    this.moved(this);
  }

  /** Whether it has been moved and not been released: what Python says meanwhile is of a place that was left. */
  get moving() {
    return this.dragging || this.held;
  }

  grab(event) {
    if (this.fixed || event.button > 0) return;
    this.track.setPointerCapture(event.pointerId);
    this.dragging = true;
    this.handle.focus({ preventScroll: true });
    this.follow(event);
  }

  follow(event) {
    const { left, width } = this.track.getBoundingClientRect();
    this.move(this.low * (this.high / this.low) ** ((event.clientX - left) / width));
  }

  drop() {
    if (!this.dragging) return;
    this.dragging = false;
    this.released(this);
  }

  key(event) {
    if (this.fixed) return;
    const step = 10 ** (event.shiftKey ? 1 / 200 : 1 / 40);
    const at = Math.max(this.tau_c, this.low);
    const to = {
      ArrowRight: at * step,
      ArrowUp: at * step,
      ArrowLeft: at / step,
      ArrowDown: at / step,
      PageUp: at * 2,
      PageDown: at / 2,
      Home: this.low,
      End: this.high,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.pressed();
    this.move(to);
  }
}

/** Kc, tau_I, K_I as HTML: the letter, its index below. */
function typeset(name) {
  const [letter, index] = name.includes("_") ? name.split("_") : [name[0], name.slice(1)];
  return `${letter === "tau" ? "τ" : letter}<sub>${index}</sub>`;
}
