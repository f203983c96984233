// tau_c on a logarithmic track: mouse, touch, keyboard. Ranges in which the loop is not stable are hatched.

class Slider {
  /** moved(tau_c): while it moves.   released(tau_c): when it comes to rest.   say(tau_c): its value in words. */
  constructor(root, { moved, released, say }) {
    Object.assign(this, { moved, released, say, dragging: false, timer: 0 });
    this.track = root.querySelector(".track");
    this.rail = root.querySelector(".rail");
    this.scale = root.querySelector(".scale");
    this.handle = root.querySelector("[role=slider]");
    this.track.addEventListener("pointerdown", (event) => this.grab(event));
    this.track.addEventListener("pointermove", (event) => this.dragging && this.follow(event));
    for (const end of ["pointerup", "pointercancel"]) this.track.addEventListener(end, () => this.drop());
    this.handle.addEventListener("keydown", (event) => this.key(event));
  }

  /** low, high of tau_c; unit: the length of 1 on the scale; unstable [[low, high]]; fixed: no choice of tau_c. */
  range({ low, high, unit, symbol, unstable, fixed }) {
    Object.assign(this, { low, high, unit, fixed });
    this.handle.setAttribute("aria-valuemin", low);
    this.handle.setAttribute("aria-valuemax", high);
    this.handle.setAttribute("aria-disabled", String(fixed));
    this.rail.replaceChildren(
      ...unstable.map(([from, to]) => {
        const hatch = document.createElement("div");
        hatch.className = "hatch";
        hatch.title = `not stable for tau_c from ${text(from, 3)} to ${text(to, 3)}`;
        hatch.style.left = `${100 * this.share(from)}%`;
        hatch.style.width = `${100 * (this.share(to) - this.share(from))}%`;
        return hatch;
      }),
    );
    this.scale.replaceChildren(
      ...STEPS.filter((v) => v * unit >= low * 0.999 && v * unit <= high * 1.001).map((v) => {
        const tick = document.createElement("span");
        tick.style.left = `${100 * this.share(v * unit)}%`;
        tick.textContent = `${text(v)} ${symbol}`;
        return tick;
      }),
    );
  }

  share(tau_c) {
    const s = Math.log(tau_c / this.low) / Math.log(this.high / this.low);
    return Math.min(1, Math.max(0, s));
  }

  /** Put the handle there without telling anybody. */
  place(tau_c) {
    this.tau_c = tau_c;
    this.handle.style.left = `${100 * this.share(tau_c)}%`;
    this.handle.setAttribute("aria-valuenow", tau_c);
    this.handle.setAttribute("aria-valuetext", this.say(tau_c));
  }

  move(tau_c) {
    const ratio = Number((Math.min(this.high, Math.max(this.low, tau_c)) / this.unit).toPrecision(3));
    this.place(ratio * this.unit);
    this.moved(this.tau_c);
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
    this.released(this.tau_c);
  }

  key(event) {
    if (this.fixed) return;
    const step = 10 ** (event.shiftKey ? 1 / 200 : 1 / 40);
    const to = {
      ArrowRight: this.tau_c * step, ArrowUp: this.tau_c * step,
      ArrowLeft: this.tau_c / step, ArrowDown: this.tau_c / step,
      PageUp: this.tau_c * 2, PageDown: this.tau_c / 2,
      Home: this.low, End: this.high,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.move(to);
    clearTimeout(this.timer); // a key held down is one release
    this.timer = setTimeout(() => this.released(this.tau_c), 150);
  }
}
