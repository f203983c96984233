// Numbers in words and on axes.

import { numeral } from "./words.js";

export const STEPS = [];
for (let e = -12; e <= 12; e++) for (const m of [1, 2, 5]) STEPS.push(Number(`${m}e${e}`));

/** Four significant digits at most, no trailing zeros, the decimal sign of the language; infinity as the sign. */
export const text = (value, digits = 4) => numeral(plain(value, digits));

/** The same with a decimal point. */
export function plain(value, digits = 4) {
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
export function round(low, high) {
  const span = high - low || Math.abs(high) || 1;
  const step = STEPS.find((s) => span / s <= 6) ?? span;
  return [step * Math.floor(low / step + 1e-9), step * Math.ceil(high / step - 1e-9)];
}

/** Decades carry numbers; where there is hardly one, 2 and 5 do as well. */
export function isDecade(value, { min, max }) {
  const lead = Number(value.toExponential(3).split("e")[0]);
  return lead === 1 || (Math.log10(max / min) < 2 && (lead === 2 || lead === 5));
}

/** Index of the entry of increasing `values` nearest to `wanted`. */
export function nearest(values, wanted) {
  let low = 0,
    high = values.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= wanted) low = middle;
    else high = middle;
  }
  return wanted - values[low] < values[high] - wanted ? low : high;
}

/** Figures from JSON, which has neither infinity nor nan. */
export function numbers(given) {
  return Object.fromEntries(
    Object.entries(given).map(([name, v]) => [name, v === null ? NaN : v === "inf" ? Infinity : v]),
  );
}

/** A button, never one that submits. */
export function button(words, title, onclick) {
  const made = document.createElement("button");
  Object.assign(made, { type: "button", title, onclick });
  made.textContent = words;
  return made;
}
