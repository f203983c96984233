// The panel: limit of stability, contours of Mst, the best, every rule a point; and the point that is dragged.

import { LABELS, S_LINE, U, Y } from "../kit/curves.js";
import { text } from "../kit/format.js";
import { ALARM, Panel } from "../kit/panel.js";
import { presses } from "../kit/presses.js";
import { said } from "../kit/words.js";

const UNSTABLE = "--simc-alarm-band";
const NEAR = 14; // px, from a rule's point to the pointer that means it
const STEP = 10 ** (1 / 40); // of an arrow key; a fifth of it with Shift

export class PlanePanel extends Panel {
  /**
   * plane: {x, y: limits, region, limit, contours, best, path: {x, y}, points [{key, name, x, y}], chosen: a key,
   * name: of the point that is dragged}.
   * hand: moved(Kc, tau_I), held(yes), released(), picked(key), words().
   */
  constructor(plane, scale, hand) {
    const contour = { color: S_LINE, width: 1.2, dash: [6, 4] };
    const unit = (what) => (LABELS[what] ? `  [${LABELS[what]}]` : "");
    super(
      {
        key: "plane",
        title: said("Kc and τI"),
        x: { label: `Kc${unit("OP/PV")}`, log: true, limits: () => plane.x },
        y: { label: `τI${unit("time")}`, log: true, limits: () => plane.y },
        legend: [
          { text: said("PI rules"), color: Y },
          { text: said("best PI"), color: Y },
          { text: said("SIMC over τc"), color: U, dash: true },
          { text: "Mst", color: S_LINE, dash: true },
          { text: said("limit of stability"), color: ALARM },
        ],
        styles: [
          { color: UNSTABLE, width: 0, fill: UNSTABLE },
          { color: ALARM, width: 1.6 },
          ...plane.contours.map(() => contour),
          { color: Y, width: 2.4 },
          { color: U, width: 2, dash: [2, 3] },
        ],
        tell: (panel, x, y) => panel.tell(x, y),
      },
      scale,
    );
    Object.assign(this, { plane, hand, pressed: presses(hand.held, hand.released) });
    this.curves = [plane.region, plane.limit, ...plane.contours, plane.best, plane.path];
    this.plot.setAttribute("role", "group"); // not an image: there is something in it that one can move
    this.handle = document.createElement("div");
    this.handle.className = "point";
    this.handle.tabIndex = 0;
    this.handle.title = said("{point}: drag, or move by the arrow keys", { point: plane.name });
    this.handle.setAttribute("role", "slider");
    this.handle.setAttribute("aria-roledescription", said("point in the plane of Kc and tau_I"));
    this.handle.setAttribute("aria-label", plane.name);
    this.handle.setAttribute("aria-valuenow", "0");
    this.handle.addEventListener("pointerdown", (event) => this.grab(event));
    this.handle.addEventListener("pointermove", (event) => this.dragging && this.drag(event));
    for (const end of ["pointerup", "pointercancel"]) this.handle.addEventListener(end, () => this.drop());
    this.handle.addEventListener("keydown", (event) => this.key(event));
  }

  build(theme) {
    super.build(theme);
    const { over } = this.chart;
    over.append(this.handle);
    for (const kind of ["mousedown", "mouseup", "click", "dblclick"])
      this.handle.addEventListener(kind, (event) => event.stopPropagation()); // no zoom from here
    over.addEventListener("click", (event) => {
      const { left, top } = over.getBoundingClientRect();
      const rule = this.nearest(event.clientX - left, event.clientY - top);
      if (rule) this.hand.picked(rule.key);
    });
    this.stand();
  }

  /** The point is there. */
  follow([Kc, tau_I]) {
    this.at = { x: Kc, y: tau_I };
    const { points, chosen, contours } = this.plane;
    const own = points.find(({ key }) => key === chosen);
    this.marks = [
      ...points.map(({ x, y }) => ({ x, y, color: Y })),
      ...contours.filter(({ level }) => level).map(({ level, x, y }) => ({ x: x.at(-1), y: y.at(-1), label: level })),
      ...(own ? [{ x: own.x, y: own.y, color: ALARM, cross: true, label: own.name }] : []),
      { ...this.at, color: U, label: this.plane.name, below: true },
    ];
    this.handle.setAttribute("aria-valuetext", this.hand.words());
    this.redraw();
  }

  over(u) {
    super.over(u);
    this.stand();
  }

  /** The handle over its mark; hidden outside of a zoom. */
  stand() {
    if (!this.at || !this.chart) return;
    const { clientWidth: width, clientHeight: height } = this.chart.over;
    const [left, top] = [this.chart.valToPos(this.at.x, "x"), this.chart.valToPos(this.at.y, "y")];
    this.handle.hidden = !(left >= -1 && top >= -1 && left <= width + 1 && top <= height + 1);
    Object.assign(this.handle.style, { left: `${left}px`, top: `${top}px` });
  }

  nearest(left, top) {
    const away = ({ x, y }) => Math.hypot(this.chart.valToPos(x, "x") - left, this.chart.valToPos(y, "y") - top);
    const best = this.plane.points.reduce((one, other) => (one && away(one) <= away(other) ? one : other), null);
    return best && away(best) <= NEAR ? best : null;
  }

  tell(x, y) {
    const rule = this.nearest(this.chart.valToPos(x, "x"), this.chart.valToPos(y, "y"));
    const at = rule ?? { x, y };
    return `${rule ? `${rule.name}:  ` : ""}Kc ${text(at.x, 3)}   τI ${text(at.y, 3)}`;
  }

  grab(event) {
    if (event.button > 0) return;
    event.stopPropagation();
    this.handle.setPointerCapture(event.pointerId);
    this.handle.focus({ preventScroll: true });
    this.dragging = true;
    this.hand.held(true);
  }

  drag(event) {
    const { left, top } = this.chart.over.getBoundingClientRect();
    this.hand.moved(this.chart.posToVal(event.clientX - left, "x"), this.chart.posToVal(event.clientY - top, "y"));
  }

  drop() {
    if (!this.dragging) return;
    this.dragging = false;
    this.hand.held(false);
    this.hand.released();
  }

  key(event) {
    const step = event.shiftKey ? STEP ** 0.2 : STEP;
    const { x, y } = this.at;
    const to = {
      ArrowRight: [x * step],
      ArrowLeft: [x / step],
      ArrowUp: [undefined, y * step],
      ArrowDown: [undefined, y / step],
    }[event.key];
    if (!to) return;
    event.preventDefault();
    this.pressed();
    this.hand.moved(...to);
  }
}
