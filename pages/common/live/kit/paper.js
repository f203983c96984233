// On paper an instrument shows all its panels, two by two, and all its numbers (.printing in live.css).

/** Returns what ends it. */
export function onPaper(live) {
  const print = (begins) => {
    live.root.classList.toggle("printing", begins);
    live.fit();
    live.show();
  };
  const before = () => print(true);
  const after = () => print(false);
  addEventListener("beforeprint", before);
  addEventListener("afterprint", after);
  return () => {
    removeEventListener("beforeprint", before);
    removeEventListener("afterprint", after);
  };
}
