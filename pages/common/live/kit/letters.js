// Where messages for the instrument `name` wait until it is there; that of another language may still stand beside it.

import { language } from "./words.js";

export function letters(name) {
  const place = `${name} ${language}`;
  globalThis.simcLetters ??= {};
  globalThis.simcLetters[place] ??= { open: null, owner: null, waiting: [] };
  return globalThis.simcLetters[place];
}
