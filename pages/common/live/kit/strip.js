// The strip of figures that decide: peaks Ms first and largest, their band in words and colour.

import { text } from "./format.js";

const BANDS = [
  [1.6, "calm", "calm: robust (≤ 1.6)"],
  [2, "attention", "attention: little to spare (≤ 2.0)"],
  [Infinity, "alarm", "alarm: too close to −1 (> 2.0)"],
];
const SOLVED = 1e-6; // a loop designed for Ms = 2 has it to this

/** cells: [name, words, peak]; peak: it is an Ms, shown with its band.   why: in words, why there are no numbers. */
export function strip(element, cells, metrics, exact, why) {
  element.innerHTML = cells
    .map(([name, label, peak]) => {
      const value = label.endsWith("%") ? 100 * metrics[name] : metrics[name];
      const [, band, words] = BANDS.find(([limit]) => value <= limit * (1 + SOLVED)) ?? BANDS[2];
      const more = peak ? `<span>${why || (Number.isNaN(value) ? "not known yet" : words)}</span>` : "";
      return (
        `<div data-figure="${name}" class="${peak ? `peak ${why ? "alarm" : band}` : ""}" title="${exact ? value : "read from the table; exact when released"}">` +
        `<small>${label}</small><b>${text(value, exact ? 4 : 3)}</b>${more}</div>`
      );
    })
    .join("");
}
