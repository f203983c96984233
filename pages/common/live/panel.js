// One panel: uPlot draws axes, grid, curves and cursor; every curve brings its own x, so that L(jw) is one like the rest.

const STEPS = [];
for (let e = -12; e <= 12; e++) for (const m of [1, 2, 5]) STEPS.push(Number(`${m}e${e}`));

/** Four significant digits at most, no trailing zeros; infinity as the sign. */
function text(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e5 || size < 1e-3)) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${Number(mantissa)}e${Number(exponent)}`.replace(/-/g, "−");
  }
  return String(Number(value.toPrecision(digits))).replace("-", "−");
}

/** Limits that hold [low, high] and end on round numbers. */
function round(low, high) {
  const span = high - low || Math.abs(high) || 1;
  const step = STEPS.find((s) => span / s <= 6) ?? span;
  return [step * Math.floor(low / step + 1e-9), step * Math.ceil(high / step - 1e-9)];
}

class Panel {
  /**
   * key, title, legend [{text, color, dash}], x/y: {label, log, limits(panel)}, styles [{color, dash, width, alpha}],
   * square: one unit is as long on both axes.   tell(panel, x, y): what to read at the cursor.
   */
  constructor(spec, scale) {
    this.spec = spec;
    this.scale = scale; // of type and lines: 1, or more for a lecture
    this.curves = spec.styles.map(() => ({ x: [], y: [] }));
    this.marks = [];
    this.note = "";
    this.zoom = null;
    this.box = document.createElement("figure");
    this.box.dataset.panel = spec.key;
    this.box.innerHTML = `<figcaption><b></b><span class="legend"></span><output></output>
      <button type="button" title="One panel or all (Enter)" aria-label="Show ${spec.title} alone or all">⤢</button></figcaption>
      <div class="plot" role="img"></div>`;
    this.box.querySelector("b").textContent = spec.title;
    this.box.querySelector(".legend").replaceChildren(...(spec.legend ?? []).map(swatch));
    this.readout = this.box.querySelector("output");
    this.plot = this.box.querySelector(".plot");
  }

  build(theme) {
    const { spec, scale } = this;
    this.chart?.destroy();
    const axis = (side, log) => ({
      scale: side,
      stroke: theme.text,
      font: `${Math.round(11 * scale)}px ${theme.font}`,
      labelFont: `${Math.round(11.5 * scale)}px ${theme.font}`,
      ...(spec[side].label && { label: spec[side].label, labelSize: 17 * scale }),
      labelGap: 0,
      size: (side === "x" ? 22 : 44) * scale,
      gap: 3,
      grid: { stroke: theme.grid, width: 1, ...(log && { filter: (u, ticks) => ticks.map((v) => (v !== null && isDecade(v, u.scales[side]) ? v : null)) }) },
      ticks: { stroke: theme.grid, width: 1, size: 4 },
      ...(log
        ? { values: (u, ticks) => ticks.map((v) => (v === null || !isDecade(v, u.scales[side]) ? "" : text(v))) }
        : { incrs: STEPS, space: (side === "x" ? 50 : 28) * scale, values: (u, ticks) => ticks.map((v) => text(v)) }),
    });
    const options = {
      width: Math.max(60, this.plot.clientWidth),
      height: Math.max(60, this.plot.clientHeight),
      padding: [8 * scale, 14 * scale, 0, 0],
      legend: { show: false },
      scales: {
        x: { time: false, distr: spec.x.log ? 3 : 1, range: (u) => this.limits(u).x },
        y: { distr: spec.y.log ? 3 : 1, range: (u) => this.limits(u).y },
      },
      axes: [axis("x", spec.x.log), axis("y", spec.y.log)],
      cursor: { points: { show: false }, drag: { x: true, y: true, uni: 8, setScale: false }, bind: { dblclick: () => () => this.reset() } },
      series: [
        {},
        ...spec.styles.map((style, i) => ({
          stroke: style.color,
          width: (style.width ?? 2) * scale,
          dash: style.dash?.map((d) => d * scale),
          alpha: style.alpha ?? 1,
          points: { show: false },
          paths: (u) => ({ stroke: this.path(u, this.curves[i]) }),
        })),
      ],
      hooks: {
        drawClear: [(u) => this.under(u)],
        draw: [(u) => this.over(u, theme)],
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

  /** curves in the order of the styles, marks [{x, y, color, label}]; alt: the numbers in words. */
  show(curves, marks = [], note = "") {
    this.curves = curves;
    this.marks = marks;
    this.note = note;
    this.redraw();
  }

  redraw() {
    if (this.chart && this.plot.clientWidth) this.chart.setData(this.chart.data, true);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.plot;
    if (this.chart && width > 0 && height > 0 && (width !== this.chart.width || height !== this.chart.height))
      this.chart.setSize({ width, height });
  }

  path(u, { x, y }) {
    const path = new Path2D();
    let down = false;
    for (let i = 0; i < x.length; i++) {
      const a = u.valToPos(x[i], "x", true), b = u.valToPos(y[i], "y", true);
      if (!Number.isFinite(a) || !Number.isFinite(b)) {
        down = false;
        continue;
      }
      const c = Math.max(-1e5, Math.min(1e5, b));
      if (down) path.lineTo(a, c);
      else path.moveTo(a, c);
      down = true;
    }
    return path;
  }

  under(u) {
    const { left, top, width, height } = u.bbox;
    for (const { axis, from, to, color } of this.spec.bands?.(this) ?? []) {
      const [a, b] = [from, to].map((v) => u.valToPos(v, axis, true));
      u.ctx.save();
      u.ctx.beginPath();
      u.ctx.rect(left, top, width, height);
      u.ctx.clip();
      u.ctx.fillStyle = color;
      if (axis === "y") u.ctx.fillRect(left, Math.min(a, b), width, Math.abs(b - a));
      else u.ctx.fillRect(Math.min(a, b), top, Math.abs(b - a), height);
      u.ctx.restore();
    }
  }

  over(u, theme) {
    const { ctx, bbox } = u;
    const ratio = devicePixelRatio * this.scale;
    ctx.save();
    ctx.font = `${11 * ratio}px ${theme.font}`;
    for (const { x, y, color, label, cross, align } of this.marks) {
      const a = u.valToPos(x, "x", true), b = u.valToPos(y, "y", true);
      const inside = a >= bbox.left && a <= bbox.left + bbox.width && b >= bbox.top && b <= bbox.top + bbox.height;
      if (!inside) continue;
      ctx.strokeStyle = ctx.fillStyle = color ?? theme.text;
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
      ctx.fillStyle = theme.text;
      ctx.textAlign = align ?? "left";
      ctx.fillText(label, a + (align === "right" ? -6 : 6) * ratio, b - 5 * ratio);
    }
    if (this.note) {
      ctx.font = `600 ${13 * ratio}px ${theme.font}`;
      ctx.textAlign = "center";
      const width = ctx.measureText(this.note).width + 16 * ratio;
      ctx.fillStyle = theme.page;
      ctx.fillRect(bbox.left + (bbox.width - width) / 2, bbox.top + 4 * ratio, width, 19 * ratio);
      ctx.fillStyle = ALARM;
      ctx.fillText(this.note, bbox.left + bbox.width / 2, bbox.top + 18 * ratio);
    }
    ctx.restore();
  }

  select(u) {
    const { left, top, width, height } = u.select;
    if (width < 6 && height < 6) return;
    const { x, y } = this.limits(u);
    this.zoom = {
      x: width < 6 ? x : [u.posToVal(left, "x"), u.posToVal(left + width, "x")],
      y: height < 6 ? y : [u.posToVal(top + height, "y"), u.posToVal(top, "y")],
    };
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.redraw();
  }

  reset() {
    this.zoom = null;
    this.redraw();
  }

  point(u) {
    const { left, top } = u.cursor;
    this.readout.textContent = left < 0 ? "" : this.spec.tell(this, u.posToVal(left, "x"), u.posToVal(top, "y"));
  }
}

function swatch({ text: label, color, dash }) {
  const item = document.createElement("i");
  item.style.setProperty("--line", color);
  item.className = dash ? "dashed" : "";
  item.textContent = label;
  return item;
}

/** Decades carry numbers; where there is hardly one, 2 and 5 do as well. */
function isDecade(value, { min, max }) {
  const lead = Number(value.toExponential(3).split("e")[0]);
  return lead === 1 || (Math.log10(max / min) < 2 && (lead === 2 || lead === 5));
}

/** One unit as long across as up: the axis with room to spare shows more. */
function square(u, x, y) {
  const { width, height } = u.bbox ?? {};
  if (!width || !height) return { x, y };
  const unit = Math.max((x[1] - x[0]) / width, (y[1] - y[0]) / height);
  const about = ([low, high], pixels) => [(low + high - unit * pixels) / 2, (low + high + unit * pixels) / 2];
  return { x: about(x, width), y: about(y, height) };
}

/** Index of the entry of increasing `values` nearest to `wanted`. */
function nearest(values, wanted) {
  let low = 0, high = values.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= wanted) low = middle;
    else high = middle;
  }
  return wanted - values[low] < values[high] - wanted ? low : high;
}
