// L(j omega) of a plant and a controller with exact dead time: margins, peaks, and the number of unstable poles.
//
// Size and phase are sums over factors a s^2 + b s + c, so the phase is continuous without unwrapping.

const POINTS = 300;
const AROUND = 17; // points round a resonance
const RESONANT = 0.5; // zeta below which a pair has a resonance
const FAR = 30; // |L| at the low end of a loop with integral action
const SMALL = 1e-4; // |L| at the high end: beyond it |S| is 1 to this
const TURN = 0.8; // rad that an interval may turn before it is halved
const HALVINGS = 40;
const LEEWAY = 0.1; // of ln |L| within an interval
const NODES = 5000; // of a count of poles
const FAR_STEP = 1.1;
const ITERATIONS = 60;
const GOLDEN = (Math.sqrt(5) - 1) / 2;

/** Factors of L: {gain, num, den, theta}; rows [s^2, s, 1]. */
export function factorsOf(plant, { Kp, Ki, Kd, tau_F }) {
  const pair = ([tau, zeta]) => [tau * tau, 2 * zeta * tau, 1];
  const num = [...plant.lead_pairs.map(pair), ...plant.leads.map((T) => [0, T, 1])];
  const den = [
    ...plant.lag_pairs.map(pair),
    ...plant.lags.map((tau) => [0, tau, 1]),
    ...Array(plant.integrators).fill([0, 1, 0]),
  ];
  const sign = Math.sign(Kp || Ki || Kd);
  const law = [Kd * sign, Kp * sign, Ki * sign]; // positive, so that its phase begins at 0 or 90 degrees
  if (Ki) den.push([0, 1, 0]);
  num.push(Ki ? law : [0, law[0], law[1]]);
  if (tau_F) den.push([0, tau_F, 1]);
  return { gain: plant.k * sign, num, den, theta: plant.theta };
}

/** ln |L| and its phase in rad at omega. */
export function logL({ gain, num, den, theta }, omega) {
  let size = Math.log(Math.abs(gain));
  let phase = (gain < 0 ? -Math.PI : 0) - theta * omega;
  for (const [rows, sign] of [
    [num, 1],
    [den, -1],
  ])
    for (const [a, b, c] of rows) {
      const re = c - a * omega * omega;
      const im = b * omega;
      size += sign * Math.log(Math.hypot(re, im));
      phase += sign * Math.atan2(im, re);
    }
  return [size, phase];
}

/** |S| and |T| from ln |L| and phase; |T| = 1 where |L| is infinite. */
function peaks([size, phase]) {
  if (size > 300) return [Math.exp(-size), 1];
  const L = Math.exp(size);
  const away = Math.hypot(1 + L * Math.cos(phase), L * Math.sin(phase));
  return [1 / away, L / away];
}

/** Corner frequencies of the factors and of the dead time, at least one. */
function cornersOf({ num, den, theta }) {
  const corners = [...num, ...den].map(([a, b, c]) => (a ? Math.sqrt(Math.abs(c / a)) : Math.abs(c / b)));
  const found = [...corners, 1 / theta].filter((w) => w > 0 && Number.isFinite(w));
  return found.length ? found : [1];
}

/** Frequencies at which everything is drawn, from well below the slowest corner to where |L| is small. */
export function grid(L) {
  const corners = cornersOf(L);
  let low = 0.05 * Math.min(...corners);
  let high = 20 * Math.max(...corners);
  const integral = L.den.some(([, , c]) => !c);
  for (let i = 0; integral && i < HALVINGS && logL(L, low)[0] < Math.log(FAR); i++) low /= 2;
  const resonances = [...L.num, ...L.den].filter(([a]) => a).map(([a, , c]) => Math.sqrt(Math.abs(c / a)));
  const least = Math.max(10 * low, ...resonances.map((w) => 4 * w));
  while (high > least && logL(L, high / 2)[0] < Math.log(SMALL)) high /= 2;
  for (let i = 0; i < HALVINGS && edge(L).L === 0 && logL(L, high)[0] > Math.log(SMALL); i++) high *= 2;
  const omega = Array.from({ length: POINTS }, (_, i) => low * (high / low) ** (i / (POINTS - 1)));
  for (const [a, b, c] of [...L.num, ...L.den]) {
    const zeta = Math.abs(b) / (2 * Math.sqrt(Math.abs(a * c)));
    if (!a || !(zeta < RESONANT)) continue;
    const middle = Math.sqrt(c / a);
    for (let i = 0; i < AROUND; i++) omega.push(middle * (1 + (Math.max(zeta, 1e-4) * 4 * (i - 8)) / 8));
  }
  return omega.filter((w) => w >= low && w <= high).sort((a, b) => a - b);
}

/** {Ms, Mt, GM, GM_lower, PM_deg, delay_margin} of a stable loop, as simc_core's Margins; Infinity: no limit. */
export function margins(L, omega = grid(L)) {
  const values = omega.map((w) => logL(L, w));
  const at = (w) => logL(L, w);
  const S = largest(
    omega,
    values.map((v) => peaks(v)[0]),
    (w) => peaks(at(w))[0],
  );
  const T = largest(
    omega,
    values.map((v) => peaks(v)[1]),
    (w) => peaks(at(w))[1],
  );
  const integral = L.den.some(([, , c]) => !c);
  const atInfinity = edge(L);
  const found = {
    Ms: Math.max(S, atInfinity.S, 1),
    Mt: Math.max(T, atInfinity.T, integral ? 1 : 0),
    GM: Infinity,
    GM_lower: 0,
    PM_deg: Infinity,
    delay_margin: Infinity,
  };
  for (let i = 0; i + 1 < omega.length; i++) {
    const [[s0, p0], [s1, p1]] = [values[i], values[i + 1]];
    if (s0 * s1 <= 0 && s0 !== s1) {
      const w = root((x) => at(x)[0], omega[i], omega[i + 1]);
      const phase = at(w)[1] + Math.PI; // of -L
      const turns = phase / (2 * Math.PI);
      const ahead = (turns - Math.floor(turns)) * 2 * Math.PI;
      found.PM_deg = Math.min(found.PM_deg, (Math.min(ahead, 2 * Math.PI - ahead) * 180) / Math.PI);
      found.delay_margin = Math.min(found.delay_margin, (ahead || 2 * Math.PI) / w);
    }
    if (Math.max(s0, s1) + LEEWAY < -Math.log(found.GM)) continue; // no crossing here limits the gain more
    const [k0, k1] = [p0, p1].map((p) => (p - Math.PI) / (2 * Math.PI)); // whole on the negative real axis
    for (let k = Math.ceil(Math.min(k0, k1)); k <= Math.max(k0, k1); k++) {
      const w = root((x) => at(x)[1] - Math.PI - 2 * Math.PI * k, omega[i], omega[i + 1]);
      const size = at(w)[0];
      if (size < 0) found.GM = Math.min(found.GM, Math.exp(-size));
      if (size > 0) found.GM_lower = Math.max(found.GM_lower, Math.exp(-size));
    }
  }
  if (found.GM === Infinity) found.GM = farGain(L, omega[omega.length - 1]);
  if (atInfinity.L > 0) found.GM = Math.min(found.GM, 1 / atInfinity.L);
  return found;
}

/** The gain margin where the phase crosses beyond the grid, at a |L| too small to be drawn; Infinity if it does not. */
function farGain(L, last) {
  let [w, k] = [last, Math.floor((logL(L, last)[1] - Math.PI) / (2 * Math.PI))];
  for (let i = 0; i < 10 * HALVINGS; i++, w *= FAR_STEP) {
    const phase = (x) => logL(L, x)[1] - Math.PI - 2 * Math.PI * k;
    if (phase(w * FAR_STEP) <= 0) return Math.exp(-logL(L, root(phase, w, w * FAR_STEP))[0]);
  }
  return Infinity;
}

/** |L| at infinite frequency, and what |S| and |T| are there at most. */
function edge({ gain, num, den, theta }) {
  const degree = (rows) => rows.reduce((sum, [a, b]) => sum + (a ? 2 : b ? 1 : 0), 0);
  if (degree(num) < degree(den)) return { L: 0, S: 1, T: 0 };
  const lead = (rows) => rows.reduce((product, [a, b, c]) => product * (a || b || c), 1);
  const L = (gain * lead(num)) / lead(den);
  const S = theta ? 1 / Math.max(0, 1 - Math.abs(L)) : 1 / Math.abs(1 + L);
  return { L: Math.abs(L), S, T: S * Math.abs(L) };
}

/** The largest value, looked at between the points about every peak. */
function largest(omega, values, at) {
  let best = Math.max(...values);
  for (let i = 0; i < values.length; i++) {
    if (values[i] < (values[i - 1] ?? -1) || values[i] < (values[i + 1] ?? -1) || values[i] < 0.8 * best) continue;
    let [low, high] = [Math.log(omega[Math.max(0, i - 1)]), Math.log(omega[Math.min(values.length - 1, i + 1)])];
    for (let k = 0; k < ITERATIONS && high - low > 1e-10; k++) {
      const [a, b] = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
      if (at(Math.exp(a)) > at(Math.exp(b))) high = b;
      else low = a;
    }
    best = Math.max(best, at(Math.exp((low + high) / 2)));
  }
  return best;
}

/** A zero of f between a and b, where its sign changes: Illinois. */
function root(f, a, b) {
  let [fa, fb] = [f(a), f(b)];
  if (fa === 0) return a;
  if (fb === 0) return b;
  for (let i = 0; i < ITERATIONS; i++) {
    const c = (a * fb - b * fa) / (fb - fa);
    const fc = f(c);
    if (fc === 0 || Math.abs(b - a) < 1e-14 * Math.abs(b)) return c;
    if (fc * fb < 0) [a, fa] = [b, fb];
    else fa /= 2;
    [b, fb] = [c, fc];
    if (Math.abs(fc) < 1e-14) return c;
  }
  return b;
}

/** Closed-loop poles in the right half plane, by the argument principle; Infinity where |L| at infinity is >= 1. */
export function unstablePoles(L) {
  const end = edge(L);
  if (L.theta && end.L >= 1) return Infinity;
  const corners = cornersOf(L);
  const inside = Math.min(...corners);
  const moved = L.den.map(([a, b, c]) =>
    a ? [a, Math.max(Math.abs(b), Math.sqrt(2 * a * c)), c] : c ? [0, Math.abs(b), c] : [0, 1, inside],
  );
  let high = 1e3 * Math.max(...corners);
  for (let i = 0; i < HALVINGS && logL(L, high)[0] > Math.log(Math.max(0.1, 2 * end.L)); i++) high *= 2;
  const f = (omega) => {
    // [den + num e^{-j theta omega}]/den*, den* the denominator with all its roots on the left
    let [re, im] = [1, 0];
    for (const [i, [a, b, c]] of L.den.entries()) {
      const [p, q] = [c - a * omega * omega, b * omega];
      const [u, v] = [moved[i][2] - moved[i][0] * omega * omega, moved[i][1] * omega];
      const size = u * u + v * v;
      const [x, y] = [(p * u + q * v) / size, (q * u - p * v) / size];
      [re, im] = [re * x - im * y, re * y + im * x];
    }
    let [nr, ni] = [L.gain * Math.cos(L.theta * omega), -L.gain * Math.sin(L.theta * omega)];
    for (const [a, b, c] of L.num) {
      const [p, q] = [c - a * omega * omega, b * omega];
      [nr, ni] = [nr * p - ni * q, nr * q + ni * p];
    }
    for (const [a, b, c] of moved) {
      const [p, q] = [c - a * omega * omega, b * omega];
      const size = p * p + q * q;
      [nr, ni] = [(nr * p + ni * q) / size, (ni * p - nr * q) / size];
    }
    return [re + nr, im + ni];
  };
  const turn = ([a, b], [c, d]) => Math.atan2(a * d - b * c, a * c + b * d);
  const between = (a, fa, b, fb, depth) => {
    const angle = turn(fa, fb);
    const middle = (a + b) / 2;
    const fm = f(middle);
    const halves = turn(fa, fm) + turn(fm, fb);
    if (depth > HALVINGS || (Math.abs(angle) < TURN && Math.abs(halves - angle) < TURN / 4)) return halves;
    return between(a, fa, middle, fm, depth + 1) + between(middle, fm, b, fb, depth + 1);
  };
  const nodes = [0, ...grid(L)];
  const last = nodes[nodes.length - 1];
  for (let w = last; w < high && nodes.length < NODES; ) {
    const hides = L.theta && logL(L, w)[0] > -1; // a turn of the dead time, where |L| is large enough to matter
    w = Math.min(1.3 * w, hides ? w + 1 / L.theta : Infinity);
    nodes.push(w);
  }
  let sum = 0;
  for (let i = 0, left = f(0); i + 1 < nodes.length; i++) {
    const right = f(nodes[i + 1]);
    sum += between(nodes[i], left, nodes[i + 1], right, 0);
    left = right;
  }
  return Math.max(0, Math.round(-sum / Math.PI));
}
