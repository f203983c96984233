// Where messages for the instrument `name` wait until it is there.

function letters(name) {
  const boxes = (globalThis.simcLetters ??= {});
  return (boxes[name] ??= { open: null, waiting: [] });
}
