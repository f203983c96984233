// The panels in sight as a file: PNG from their canvases, SVG from their curves.

import { plain } from "./format.js";
import { element, escaped, place, svgPanel, svgText } from "./svg.js";

/** Panels shown, with their places on the sheet in pixels of the page. */
function sheetOf(live) {
  const origin = live.root.querySelector(`.field.${live.view}`).getBoundingClientRect();
  const places = live.views[live.view].panels
    .filter((panel) => panel.box.offsetParent || panel.box.checkVisibility())
    .map((panel) => {
      const head = panel.box.getBoundingClientRect(),
        at = panel.plot.getBoundingClientRect();
      return {
        panel,
        head: head.top - origin.top + TITLE + 15 * panel.scale,
        left: at.left - origin.left,
        top: at.top - origin.top + TITLE,
      };
    });
  return { width: origin.width, height: origin.height + TITLE, places };
}

const TITLE = 22; // height of the line above all panels

export function savePng(live) {
  const { width, height, places } = sheetOf(live),
    ratio = devicePixelRatio;
  const sheet = document.createElement("canvas");
  sheet.width = width * ratio;
  sheet.height = height * ratio;
  const ctx = sheet.getContext("2d");
  ctx.fillStyle = live.theme.page;
  ctx.fillRect(0, 0, sheet.width, sheet.height);
  ctx.fillStyle = live.theme.text;
  const write = (words, x, y, size) => {
    ctx.font = `600 ${size * ratio}px ${live.theme.font}`;
    ctx.fillText(words, x * ratio, y * ratio);
  };
  write(live.title(), 4, 15, 13);
  for (const { panel, head, left, top } of places) {
    write(panel.spec.title, left + 4, head, 12 * panel.scale);
    ctx.drawImage(panel.chart.ctx.canvas, left * ratio, top * ratio);
  }
  download(live, sheet.toDataURL("image/png"), "png");
}

export function saveSvg(live) {
  const { width, height, places } = sheetOf(live);
  const { page, text: ink, font } = live.theme;
  const parts = places.map(({ panel, head, left, top }, i) => svgPanel(panel, left, top, head, `panel${i}`));
  const svg = element(
    "svg",
    {
      xmlns: "http://www.w3.org/2000/svg",
      width,
      height,
      viewBox: `0 0 ${place(width)} ${place(height)}`,
      "font-family": font,
      fill: ink,
    },
    [
      element("title", {}, escaped(live.title())),
      element("rect", { width: "100%", height: "100%", fill: page }),
      svgText(4, 15, live.title(), { weight: 600, size: 13 }),
      ...parts,
    ].join("\n"),
  );
  const address = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
  download(live, address, "svg");
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

function download(live, href, kind) {
  const link = document.createElement("a");
  link.href = href;
  const places = live.sliders.filter(({ row }) => !row.hidden).map(({ name, tau_c }) => `${name}-${plain(tau_c)}`);
  link.download = `simc-${places.join("-")}.${kind}`.replace(/[^\w.]+/g, "-");
  link.click();
}
