// The words of the page's language: said("Loop not stable"), said("{name} = {value}", { name, value }).
// spoken.py puts SPOKEN before all modules: the language, translations by English template, the decimal sign.

const ours = typeof SPOKEN === "undefined" ? { language: "en", words: {}, decimal: "." } : SPOKEN;

export const language = ours.language;

/** The sentence in the page's language. template: text in double quotes, so that it comes into the catalogue. */
export function said(template, values) {
  const told = ours.words[template] ?? template;
  return values ? told.replace(/\{(\w+)\}/g, (_, name) => values[name]) : told;
}

/** A number that is written already, with the decimal sign of the language. */
export const numeral = (written) => String(written).replace(".", ours.decimal);

/** Numbers in a row: semicolons part those that have commas. */
export const listed = (numbers) => numbers.join(ours.decimal === "," ? "; " : ", ");
