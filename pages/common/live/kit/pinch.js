// Two fingers on a panel zoom its curves: what lay under each finger stays under it. One finger scrolls the page.

const APART = 0.08; // of the panel: fingers that lie closer along an axis leave that axis as it is

/** The limits of an axis after the fingers went from the shares `from` of it to the shares `to`. */
export function stretched([low, high], log, from, to) {
  if (Math.abs(from[0] - from[1]) < APART || Math.abs(to[0] - to[1]) < APART) return [low, high];
  const [a, b] = log ? [Math.log(low), Math.log(high)] : [low, high];
  const span = ((b - a) * (from[0] - from[1])) / (to[0] - to[1]);
  const begin = a + from[0] * (b - a) - to[0] * span;
  return log ? [Math.exp(begin), Math.exp(begin + span)] : [begin, begin + span];
}

export function pinch(panel) {
  const fingers = new Map();
  let begun = null;
  const shares = () => {
    const { left, bottom, width, height } = panel.chart.over.getBoundingClientRect();
    const all = [...fingers.values()];
    return { x: all.map(([x]) => (x - left) / width), y: all.map(([, y]) => (bottom - y) / height) };
  };
  panel.plot.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "touch" || !panel.chart) return;
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    begun = fingers.size === 2 ? { at: shares(), limits: panel.limits(panel.chart) } : null;
  });
  panel.plot.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    if (!begun) return;
    const now = shares();
    const axis = (side) => stretched(begun.limits[side], panel.spec[side].log, begun.at[side], now[side]);
    panel.zoom = { x: axis("x"), y: axis("y") };
    panel.redraw();
  });
  for (const end of ["pointerup", "pointercancel", "pointerleave"])
    panel.plot.addEventListener(end, (event) => {
      fingers.delete(event.pointerId);
      begun = null;
    });
}
