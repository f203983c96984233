// Two fingers on a panel zoom its curves: what lay under each finger stays under it. One finger scrolls the page.

const APART = 0.08; // of the panel: fingers that lie closer along an axis leave that axis as it is
const [CLOSEST, FARTHEST] = [1e-6, 10]; // a zoomed axis over the whole one

/** The limits of an axis after the fingers went from the shares `from` of it to the shares `to`. */
export function stretched([low, high], log, from, to) {
  if (Math.abs(from[0] - from[1]) < APART || Math.abs(to[0] - to[1]) < APART) return [low, high];
  const [a, b] = log ? [Math.log(low), Math.log(high)] : [low, high];
  const span = ((b - a) * (from[0] - from[1])) / (to[0] - to[1]);
  const begin = a + from[0] * (b - a) - to[0] * span;
  return log ? [Math.exp(begin), Math.exp(begin + span)] : [begin, begin + span];
}

/** Whether limits are near enough to the whole, and of a length that numbers and ticks can follow. */
export function bounded(limits, whole, log) {
  const scaled = ([low, high]) => (log ? [Math.log(low), Math.log(high)] : [low, high]);
  const [[a, b], [low, high]] = [scaled(limits), scaled(whole)];
  const share = (b - a) / (high - low);
  return share > CLOSEST && share < FARTHEST && a < high && b > low && b - a > CLOSEST * Math.max(-a, b);
}

/**
 * A touch of a button. After two fingers Chromium makes no click of the next touch; of one that we have heard nothing
 * is made besides.
 */
export function touched(made, does) {
  made.addEventListener("touchend", (event) => {
    const { clientX: x, clientY: y } = event.changedTouches[0];
    const { left, right, top, bottom } = made.getBoundingClientRect();
    if (!event.cancelable || x < left || x > right || y < top || y > bottom) return;
    event.preventDefault();
    does();
  });
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
    if (event.isPrimary) fingers.clear(); // of an earlier touch, whose end was not heard
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    begun = fingers.size === 2 ? { at: shares(), limits: panel.limits(panel.chart) } : null;
  });
  panel.plot.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    if (!begun) return;
    const now = shares();
    const axis = (side) => stretched(begun.limits[side], panel.spec[side].log, begun.at[side], now[side]);
    panel.zoomTo({ x: axis("x"), y: axis("y") });
  });
  for (const end of ["pointerup", "pointercancel", "pointerleave"])
    panel.plot.addEventListener(end, (event) => {
      fingers.delete(event.pointerId);
      begun = null;
    });
}
