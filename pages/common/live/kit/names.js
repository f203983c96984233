// Names of curves, each where its curve is farthest from the others: who sees no colours tells them apart too.

const PLACES = 100; // that are looked at on a curve
const APART = 4; // px: curves that lie closer everywhere are named at their ends

/**
 * Marks {x, y, label} for the curves whose style has a `name`. Under a hand a name goes with its curve and does not
 * jump to another place of it.
 */
export function namesOf(panel, u) {
  const { curves, spec, moving } = panel;
  if (panel.hides) return [];
  const former = moving ? panel.named : undefined;
  const at = (curve, i) => [u.valToPos(curve.x[i], "x"), u.valToPos(curve.y[i], "y")];
  const placed = [];
  panel.named = {};
  const found = [];
  for (const [n, { name }] of spec.styles.entries()) {
    const curve = curves[n];
    if (!name || !curve?.x.length) continue;
    const others = curves.filter((each, i) => i !== n && !spec.styles[i].aid && each.x.length === curve.x.length);
    const i = former?.[n] ?? farthest(u, curve, others, placed, at);
    if (i === undefined) continue;
    panel.named[n] = i;
    const here = at(curve, i);
    placed.push(here);
    found.push({
      x: curve.x[i],
      y: curve.y[i],
      label: name,
      ...aside(
        here,
        others.map((other) => at(other, i)),
      ),
    });
  }
  return found;
}

/** On the side of the curve where the nearest of the others is not. */
function aside([a, b], others) {
  const off = others.map(([c, d]) => [c - a, d - b]).filter(([across, down]) => Number.isFinite(across + down));
  if (!off.length) return {};
  const [[across, down]] = off.sort((one, other) => Math.hypot(...one) - Math.hypot(...other));
  return Math.abs(across) > Math.abs(down) ? { align: across > 0 ? "right" : "left" } : { below: down < 0 };
}

function farthest(u, curve, others, placed, at) {
  const { clientWidth: width, clientHeight: height } = u.over;
  const step = Math.max(1, Math.floor(curve.x.length / PLACES));
  let best, end;
  for (let i = 0; i < curve.x.length; i += step) {
    const [a, b] = at(curve, i);
    if (!(a >= 0 && a <= width && b >= 0 && b <= height)) continue;
    end = i;
    let away = Infinity;
    for (const [c, d] of [...others.map((other) => at(other, i)), ...placed])
      if (Number.isFinite(c) && Number.isFinite(d)) away = Math.min(away, Math.hypot(a - c, b - d));
    if (!best || away >= best.away) best = { away, i };
  }
  return best && best.away < APART ? end : best?.i;
}
