// The table over tau_c: unpacking it, and reading curves between its rows. simc_core/tau_table.py is the reference.

/** [uint32 n][JSON header, n bytes][float32 blocks in the order of header.blocks: name, rows, columns] */
export function unpack(bytes) {
  const own = bytes.slice(); // aligned, and not the wire's buffer
  const length = new DataView(own.buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(own.subarray(4, 4 + length)));
  let at = 4 + length;
  const blocks = {};
  for (const [name, rows, columns] of header.blocks) {
    blocks[name] = { rows, columns, values: new Float32Array(own.buffer, at, rows * columns) };
    at += 4 * rows * columns;
  }
  return { ...header, blocks };
}

/** Rows to mix at x, and their weights: Lagrange through up to four rows, never across a kink. */
export function stencil(x, nodes, breaks) {
  let i = 0;
  while (i < nodes.length - 2 && nodes[i + 1] < x) i++;
  let b = 0;
  while (b < breaks.length - 2 && breaks[b + 1] <= i) b++;
  const low = breaks[b],
    high = breaks[b + 1];
  const count = Math.min(4, high - low + 1);
  const first = Math.max(low, Math.min(i - 1, high - count + 1));
  const weights = [];
  for (let j = first; j < first + count; j++) {
    let w = 1;
    for (let m = first; m < first + count; m++) if (m !== j) w *= (x - nodes[m]) / (nodes[j] - nodes[m]);
    weights.push(w);
  }
  return { first, weights };
}

/** The curve at a stencil, as ordinary numbers. */
export function mix(block, { first, weights }) {
  const { columns, values } = block;
  const curve = new Array(columns).fill(0);
  weights.forEach((w, j) => {
    const row = (first + j) * columns;
    for (let c = 0; c < columns; c++) curve[c] += w * values[row + c];
  });
  return curve;
}

/** A single figure between rows i and i+1; it may be infinite or have no value on one side. */
export function between(values, x, nodes) {
  let i = 0;
  while (i < nodes.length - 2 && nodes[i + 1] < x) i++;
  const share = Math.min(1, Math.max(0, (x - nodes[i]) / (nodes[i + 1] - nodes[i])));
  if (share === 0 || values[i] === values[i + 1]) return values[i];
  if (share === 1) return values[i + 1];
  return values[i] + share * (values[i + 1] - values[i]);
}

/** |S| and |T| of L, exact at every point of it. */
export function sensitivities(re, im) {
  const S = [],
    T = [];
  for (let i = 0; i < re.length; i++) {
    const size = 1 / Math.hypot(1 + re[i], im[i]);
    S.push(size);
    T.push(size * Math.hypot(re[i], im[i]));
  }
  return { S, T };
}
