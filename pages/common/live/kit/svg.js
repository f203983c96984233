// Panels as SVG: the same curves, ticks, labels and marks as on the canvas, as paths and text.

import { namesOf } from "./names.js";
import { ALARM, trace } from "./panel.js";

export const escaped = (words) =>
  String(words).replace(/[&<>"]/g, (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c]);
export const place = (v) => (Math.round(v * 100) / 100).toString();

/** `<name key="value" .../>`, or with content in it; what is undefined is left out, numbers are written to 0.01 px. */
export function element(name, attributes, content = "") {
  const written = Object.entries(attributes)
    .filter(([, value]) => value !== undefined)
    .map(([key, value]) => ` ${key}="${typeof value === "number" ? place(value) : escaped(value)}"`);
  return `<${name}${written.join("")}${content ? `>${content}</${name}>` : "/>"}`;
}

/** A pen for trace() that writes path data. */
class SvgPen {
  parts = [];
  moveTo(x, y) {
    this.parts.push(`M${place(x)} ${place(y)}`);
  }
  lineTo(x, y) {
    this.parts.push(`L${place(x)} ${place(y)}`);
  }
}

export function svgText(x, y, words, { anchor = "start", weight = 400, size = 11, turn = 0, color: fill } = {}) {
  const transform = turn ? `rotate(${turn} ${place(x)} ${place(y)})` : undefined;
  const type = { "text-anchor": anchor, "font-size": size, "font-weight": weight };
  return element("text", { x, y, ...type, fill, transform }, escaped(words));
}

/** One panel with its corner of the plot at (left, top); id: of its clip path. */
export function svgPanel(panel, left, top, head, id) {
  const { chart: u, spec, scale, theme } = panel;
  const width = u.over.clientWidth,
    height = u.over.clientHeight;
  const [x0, y0] = [left + u.over.offsetLeft, top + u.over.offsetTop];
  const size = 11 * scale;
  const out = [element("clipPath", { id }, element("rect", { width, height })), svgHead(panel, left, head)];
  const grid = [],
    words = [];
  for (const [i, side] of ["x", "y"].entries()) {
    u.axes[i]._splits.forEach((value, n) => {
      const shown = u.axes[i]._values[n],
        at = u.valToPos(value, side);
      if (!shown || at < -1 || at > (i ? height : width) + 1) return;
      grid.push(i ? `M0 ${place(at)}H${width}` : `M${place(at)} 0V${height}`);
      words.push(
        i
          ? svgText(x0 - 6 * scale, y0 + at + size / 3, shown, { anchor: "end", size })
          : svgText(x0 + at, y0 + height + 1.4 * size, shown, { anchor: "middle", size }),
      );
    });
  }
  if (spec.x.label)
    words.push(svgText(x0 + width / 2, y0 + height + 2.9 * size, spec.x.label, { anchor: "middle", size }));
  if (spec.y.label)
    words.push(svgText(left + size, y0 + height / 2, spec.y.label, { anchor: "middle", size, turn: -90 }));
  const shades = panel
    .shades(u, false)
    .map(([x, y, width, height, fill]) => element("rect", { x, y, width, height, fill }));
  const curves = panel.curves.map((curve, i) => {
    const { color, width: line = 2, dash, fill } = spec.styles[i];
    const pen = trace(u, curve, new SvgPen(), false);
    return element("path", {
      class: "curve",
      d: pen.parts.join(""),
      stroke: theme.ink(color),
      fill: fill && theme.ink(fill),
      "stroke-width": line * scale,
      "stroke-dasharray": dash?.map((d) => d * scale).join(),
    });
  });
  const lines = element("path", { d: grid.join(""), stroke: theme.grid });
  const drawn = element("g", { fill: "none", "stroke-linejoin": "round" }, curves.join(""));
  const clipped = element("g", { "clip-path": `url(#${id})` }, shades.join("") + lines + drawn);
  const marks = svgMarks(panel, width, height, size);
  out.push(element("g", { transform: `translate(${place(x0)} ${place(y0)})` }, clipped + marks), ...words);
  const label = panel.plot.getAttribute("aria-label") ?? spec.title;
  return element("g", { role: "img", "aria-label": label }, out.join("\n"));
}

/** Title and legend above a panel. */
function svgHead({ spec, scale, theme }, left, head) {
  const out = [svgText(left, head, spec.title, { weight: 600, size: 12 * scale })];
  let x = left + (spec.title.length * 6.6 + 14) * scale;
  for (const { text: words, color, dash } of spec.legend ?? []) {
    out.push(
      element("path", {
        d: `M${place(x)} ${place(head - 4 * scale)}h${18 * scale}`,
        stroke: theme.ink(color),
        "stroke-width": 2 * scale,
        "stroke-dasharray": dash && `${5 * scale} ${3 * scale}`,
      }),
    );
    out.push(svgText(x + 23 * scale, head, words, { size: 11 * scale }));
    x += (words.length * 6 + 36) * scale;
  }
  return out.join("");
}

function svgMarks(panel, width, height, size) {
  const { chart: u, scale, theme } = panel;
  const out = [];
  for (const { x, y, color, label, cross, align, below } of [...panel.marks, ...namesOf(panel, u)]) {
    const a = u.valToPos(x, "x"),
      b = u.valToPos(y, "y"),
      r = 5 * scale;
    if (!(a >= 0 && a <= width && b >= 0 && b <= height)) continue;
    if (cross)
      out.push(
        element("path", {
          d: `M${place(a - r)} ${place(b)}h${2 * r}M${place(a)} ${place(b - r)}v${2 * r}`,
          stroke: theme.ink(color),
          "stroke-width": 2 * scale,
        }),
      );
    else if (color) out.push(element("circle", { cx: a, cy: b, r: 4.5 * scale, fill: theme.ink(color) }));
    if (label)
      out.push(
        svgText(
          a + (align === "right" ? -6 : 6) * scale,
          below ? Math.min(b + 15 * scale, height - 2) : Math.max(b - 5 * scale, size),
          label,
          { anchor: align === "right" ? "end" : "start", size },
        ),
      );
  }
  if (panel.note)
    out.push(
      svgText(width / 2, 18 * scale, panel.note, {
        anchor: "middle",
        weight: 600,
        size: 13 * scale,
        color: theme.ink(ALARM),
      }),
    );
  return out.join("");
}
