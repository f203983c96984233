// One panel: uPlot draws axes, grid, curves and cursor; every curve brings its own x, L(jw) as the rest.

import { button, isDecade, STEPS, text } from "./format.js";
import { namesOf } from "./names.js";
import { ghosts, seen } from "./overlay.js";
import { bounded, pinch, touched } from "./pinch.js";
import { said } from "./words.js";

export const ALARM = "--simc-alarm";

export class Panel {
  /**
   * key, title, legend [{text, color, dash}], x/y: {label, log, limits(panel)},
   * styles [{color, dash, width, alpha, aid, fill, name}], aid: it only helps the eye;
   * square: one unit is as long on both axes.
   * tell(panel, x, y): what to read at the cursor;   along: "t" or "omega", what the curves `names`, the last ones, are
   * drawn over, or along which they go in the order of `omega`.
   */
  constructor(spec, scale) {
    this.spec = spec;
    this.scale = scale; // of type and lines: 1, or more for a lecture
    this.curves = spec.styles.map(() => ({ x: [], y: [] }));
    this.marks = [];
    this.note = "";
    this.zoom = null;
    this.ghost = null; // the curves as they were before the last movement, in a lecture
    this.hides = ""; // see overlay.js
    this.box = document.createElement("figure");
    this.box.dataset.panel = spec.key;
    this.box.innerHTML = `<figcaption><b></b><span class="legend"></span><output></output></figcaption>
      <div class="plot" role="img"></div>`;
    this.box.querySelector("b").textContent = spec.title;
    this.box.querySelector(".legend").replaceChildren(...(spec.legend ?? []).map(swatch));
    this.readout = this.box.querySelector("output");
    this.plot = this.box.querySelector(".plot");
    this.unzoom = button(said("⟲ Reset zoom"), said("Or a double click on the curves"), () => this.reset());
    this.unzoom.className = "unzoom";
    this.unzoom.hidden = true;
    touched(this.unzoom, () => this.reset());
    this.single = button("⤢", said("One panel or all"));
    this.single.setAttribute("aria-label", said("Show {panel} alone or all", { panel: spec.title }));
    this.box.querySelector("figcaption").append(this.unzoom, this.single);
    pinch(this);
  }

  build(theme) {
    const { spec, scale } = this;
    this.theme = theme;
    this.chart?.destroy();
    const options = {
      width: Math.max(60, this.plot.clientWidth),
      height: Math.max(60, this.plot.clientHeight),
      padding: [8 * scale, 14 * scale, 0, 0],
      legend: { show: false },
      scales: {
        x: { time: false, distr: spec.x.log ? 3 : 1, range: (u) => this.limits(u).x },
        y: { distr: spec.y.log ? 3 : 1, range: (u) => this.limits(u).y },
      },
      axes: ["x", "y"].map((side) => axis(side, spec[side], theme, scale)),
      cursor: {
        points: { show: false },
        drag: { x: true, y: true, uni: 8, setScale: false },
        bind: { dblclick: () => () => this.reset() },
      },
      series: [
        {},
        ...spec.styles.map((style, i) => ({
          stroke: theme.ink(style.color),
          width: (style.width ?? 2) * scale,
          dash: style.dash?.map((d) => d * scale),
          alpha: style.alpha ?? 1,
          points: { show: false },
          ...(style.fill && { fill: theme.ink(style.fill) }),
          paths: (u) => {
            const path = trace(u, seen(this.curves[i], style, this.hides, this.until), new Path2D(), true);
            return { stroke: path, fill: style.fill ? path : null };
          },
        })),
      ],
      hooks: {
        drawClear: [(u) => this.under(u)],
        draw: [(u) => this.over(u)],
        setSelect: [(u) => this.select(u)],
        setCursor: [(u) => this.point(u)],
      },
    };
    const dummy = [[1, 2], ...spec.styles.map(() => [1, 2])];
    this.chart = new uPlot(options, dummy, this.plot);
  }

  limits(u) {
    const x = this.zoom?.x ?? this.spec.x.limits(this);
    const y = this.zoom?.y ?? this.spec.y.limits(this);
    return this.spec.square ? square(u, x, y) : { x, y };
  }

  /** curves in the order of the styles, marks [{x, y, color, label, cross, align, below}], note: a warning. */
  show(curves, marks = [], note = "") {
    this.curves = curves;
    this.marks = marks;
    this.note = note;
    this.redraw();
  }

  redraw() {
    this.unzoom.hidden = !this.zoom;
    this.stale = !this.plot.clientWidth; // what is out of sight is drawn when it comes back, see resize
    if (this.chart && !this.stale) this.chart.setData(this.chart.data, true);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.plot;
    if (!this.chart || !width || !height) return;
    const other = width !== this.chart.width || height !== this.chart.height;
    if (other) this.chart.setSize({ width, height });
    if (other || this.stale) this.redraw(); // the limits of a square panel follow its shape
  }

  /** Coloured ranges behind the curves: [x, y, width, height, colour] in pixels of the canvas, or of the page. */
  shades(u, canvas) {
    const from = canvas ? u.bbox : { left: 0, top: 0, width: u.over.clientWidth, height: u.over.clientHeight };
    return (this.spec.bands?.(this) ?? []).map(({ axis: side, from: low, to: high, color }) => {
      const [a, b] = [low, high].map((v) => u.valToPos(v, side, canvas));
      const [at, span] = [Math.min(a, b), Math.abs(b - a)];
      return side === "y"
        ? [from.left, at, from.width, span, this.theme.ink(color)]
        : [at, from.top, span, from.height, this.theme.ink(color)];
    });
  }

  under(u) {
    const { left, top, width, height } = u.bbox;
    u.ctx.save();
    u.ctx.beginPath();
    u.ctx.rect(left, top, width, height);
    u.ctx.clip();
    for (const [x, y, w, h, color] of this.shades(u, true)) {
      u.ctx.fillStyle = color;
      u.ctx.fillRect(x, y, w, h);
    }
    ghosts(this, u, trace);
    u.ctx.restore();
  }

  over(u) {
    const { ctx, bbox } = u;
    const { theme } = this;
    const ratio = devicePixelRatio * this.scale;
    ctx.save();
    ctx.font = `${11 * ratio}px ${theme.font}`;
    for (const { x, y, color, label, cross, align, below } of [...this.marks, ...namesOf(this, u)]) {
      if (this.hides && color && !cross) continue;
      const a = u.valToPos(x, "x", true),
        b = u.valToPos(y, "y", true);
      const inside = a >= bbox.left && a <= bbox.left + bbox.width && b >= bbox.top && b <= bbox.top + bbox.height;
      if (!inside) continue;
      ctx.strokeStyle = ctx.fillStyle = color ? theme.ink(color) : theme.text;
      ctx.lineWidth = 2 * ratio;
      ctx.beginPath();
      if (cross) {
        const r = 5 * ratio;
        ctx.moveTo(a - r, b);
        ctx.lineTo(a + r, b);
        ctx.moveTo(a, b - r);
        ctx.lineTo(a, b + r);
        ctx.stroke();
      } else if (color) {
        ctx.arc(a, b, 4.5 * ratio, 0, 7);
        ctx.fill();
      }
      if (!label) continue;
      const right =
        align === "right" || (!align && a + ctx.measureText(label).width + 8 * ratio > bbox.left + bbox.width);
      ctx.fillStyle = theme.text;
      ctx.textAlign = right ? "right" : "left";
      const from = a + (right ? -6 : 6) * ratio;
      const line = below
        ? Math.min(b + 15 * ratio, bbox.top + bbox.height - 2 * ratio)
        : Math.max(b - 5 * ratio, bbox.top + 10 * ratio);
      ctx.strokeStyle = theme.page; // curves leave the letters free
      ctx.lineWidth = 3 * ratio;
      ctx.strokeText(label, from, line);
      ctx.fillText(label, from, line);
    }
    if (this.note && !this.hides) {
      ctx.font = `600 ${13 * ratio}px ${theme.font}`;
      ctx.textAlign = "center";
      const width = ctx.measureText(this.note).width + 16 * ratio;
      ctx.fillStyle = theme.page;
      ctx.fillRect(bbox.left + (bbox.width - width) / 2, bbox.top + 4 * ratio, width, 19 * ratio);
      ctx.fillStyle = theme.ink(ALARM);
      ctx.fillText(this.note, bbox.left + bbox.width / 2, bbox.top + 18 * ratio);
    }
    ctx.restore();
  }

  select(u) {
    const { left, top, width, height } = u.select;
    if (width < 6 && height < 6) return;
    const { x, y } = this.limits(u);
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.zoomTo({
      x: width < 6 ? x : [u.posToVal(left, "x"), u.posToVal(left + width, "x")],
      y: height < 6 ? y : [u.posToVal(top + height, "y"), u.posToVal(top, "y")],
    });
  }

  /** Limits of both axes, unless they are beyond what can be drawn. */
  zoomTo(limits) {
    if (!["x", "y"].every((side) => bounded(limits[side], this.spec[side].limits(this), this.spec[side].log))) return;
    this.zoom = limits;
    this.redraw();
  }

  reset() {
    this.zoom = null;
    this.redraw();
  }

  point(u) {
    const { left, top } = u.cursor;
    const [x, y] = left < 0 ? [] : [u.posToVal(left, "x"), u.posToVal(top, "y")];
    this.readout.textContent = left < 0 ? "" : this.spec.tell(this, x, y);
    this.pointed?.(this.spec.along, left < 0 || !this.spec.along ? undefined : (this.spec.where?.(this, x, y) ?? x));
  }
}

/** How uPlot is to draw one axis: round ticks; of a logarithmic one the decades. */
function axis(side, { label, log }, theme, scale) {
  return {
    scale: side,
    stroke: theme.text,
    font: `${Math.round(11 * scale)}px ${theme.font}`,
    labelFont: `${Math.round(11.5 * scale)}px ${theme.font}`,
    ...(label && { label, labelSize: 17 * scale }),
    labelGap: 0,
    size: (side === "x" ? 22 : 44) * scale,
    gap: 3,
    grid: {
      stroke: theme.grid,
      width: 1,
      ...(log && { filter: (u, ticks) => ticks.map((v) => (v !== null && isDecade(v, u.scales[side]) ? v : null)) }),
    },
    ticks: { stroke: theme.grid, width: 1, size: 4 },
    ...(log
      ? {
          splits: (_u, _index, low, high) => logTicks(low, high),
          filter: (_u, ticks) => ticks,
          values: (u, ticks) => ticks.map((v) => (v === null || !isDecade(v, u.scales[side]) ? "" : text(v))),
        }
      : { incrs: STEPS, space: (side === "x" ? 50 : 28) * scale, values: (_u, ticks) => ticks.map((v) => text(v)) }),
  };
}

/** 1 to 9 of every decade within the limits; uPlot counts on from the lower one, round or not. */
export function logTicks(low, high) {
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); e++)
    for (let m = 1; m < 10; m++) ticks.push(Number(`${m}e${e}`));
  return ticks.filter((v) => v >= low && v <= high);
}

/** The curve on a pen that knows moveTo and lineTo, in pixels of the canvas, or of the page. */
export function trace(u, { x, y }, pen, canvas) {
  let down = false;
  for (let i = 0; i < x.length; i++) {
    const a = u.valToPos(x[i], "x", canvas),
      b = u.valToPos(y[i], "y", canvas);
    if (!Number.isFinite(a) || !Number.isFinite(b)) {
      down = false;
      continue;
    }
    const c = Math.max(-1e5, Math.min(1e5, b));
    if (down) pen.lineTo(a, c);
    else pen.moveTo(a, c);
    down = true;
  }
  return pen;
}

function swatch({ text: label, color, dash }) {
  const item = document.createElement("i");
  item.style.setProperty("--line", `var(${color})`);
  item.className = dash ? "dashed" : "";
  item.textContent = label;
  return item;
}

/** One unit as long across as up: the axis with room to spare shows more. */
export function square(u, x, y) {
  const { width, height } = u.bbox ?? {};
  if (!width || !height) return { x, y };
  const unit = Math.max((x[1] - x[0]) / width, (y[1] - y[0]) / height);
  const about = ([low, high], pixels) => [(low + high - unit * pixels) / 2, (low + high + unit * pixels) / 2];
  return { x: about(x, width), y: about(y, height) };
}
