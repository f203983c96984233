// Where messages for the instrument `name` wait until it is there.

export function letters(name) {
  globalThis.simcLetters ??= {};
  globalThis.simcLetters[name] ??= { open: null, waiting: [] };
  return globalThis.simcLetters[name];
}
