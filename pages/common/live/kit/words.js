// The words of the page's language: said("Loop not stable"), said("{name} = {value}", { name, value }).
// components.py puts SPOKEN before all modules: translations by English template, and the decimal sign.

const { words, decimal } = typeof SPOKEN === "undefined" ? { words: {}, decimal: "." } : SPOKEN;

/** The sentence in the page's language. template: text in double quotes, so that it comes into the catalogue. */
export function said(template, values) {
  const told = words[template] ?? template;
  return values ? told.replace(/\{(\w+)\}/g, (_, name) => values[name]) : told;
}

/** A number that is written already, with the decimal sign of the language. */
export const numeral = (written) => String(written).replace(".", decimal);

/** Numbers in a row: semicolons part those that have commas. */
export const listed = (numbers) => numbers.join(decimal === "," ? "; " : ", ");
