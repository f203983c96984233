// The strip of figures that decide: peaks Ms first and largest, their band in words and colour.

import { LABELS } from "./curves.js";
import { text } from "./format.js";
import { escaped } from "./svg.js";
import { numeral, said } from "./words.js";

const MOVING = 3; // digits while the slider moves, 4 at rest

/** judgement: {cells, bands, solved}, see judgement.py.   why: in words, why there are no numbers. */
export function strip(element, { cells, bands, solved }, metrics, exact, why) {
  const shown = (name, factor) => text(factor * metrics[name], exact ? 4 : MOVING);
  element.innerHTML = cells
    .map(({ name, label, meaning, factor, peak, unit }) => {
      const [, tone, band] = bands.find(([upto]) => metrics[name] <= upto * (1 + solved)) ?? bands.at(-1);
      const more = peak ? `<span>${why || (Number.isNaN(metrics[name]) ? said("not known yet") : band)}</span>` : "";
      const both = name === "GM" && metrics.GM_lower > 0;
      const value = Number.isNaN(metrics[name]) ? why || said("not known") : numeral(factor * metrics[name]);
      const title = exact ? value : said("interpolated while you drag; exact when you let go");
      const look = peak ? `peak ${why ? "alarm" : tone}` : "";
      return (
        `<div data-figure="${name}" class="${look}" title="${title}\n${meaning}">` +
        `<small>${both ? said("{figure}, low · high", { figure: label }) : label}</small>` +
        `<b>${both ? `${shown("GM_lower", 1)} · ` : ""}${shown(name, factor)}</b> ` +
        `<i>${escaped(LABELS[unit] || "")}</i>${more}</div>`
      );
    })
    .join("");
}
