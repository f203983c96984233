// Keys on a handle: several in a row, or one held down, are one release.

const PATIENCE = 150; // ms after the last of them

/** To be called at each key. hold(yes): an answer to an earlier release must not take the handle back meanwhile. */
export function presses(hold, released) {
  let timer = 0;
  return () => {
    hold(true);
    clearTimeout(timer);
    timer = setTimeout(() => {
      hold(false);
      released();
    }, PATIENCE);
  };
}
