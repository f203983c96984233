// Responses to unit steps of r and of d, both from rest, with exact dead time: the method of steps.
//
// A step is h = theta/m. On it w = sum W_j P_j(2 s - 1), j < order, s = 0..1, and of z are kept its Legendre moments:
// (x, W) -> (x+, Z) is one constant matrix, made by one exponential. x+ is exact for a polynomial w, however stiff the
// plant. Edges of steps carry every jump.

import { exponential, times } from "./matrix.js";

const ORDER = 4;
const BRIEF_ORDER = 8; // where one step is a whole dead time, all that happens within it must fit
const STEPS = 600; // to the horizon, at least
const PARTS = 16; // of a dead time, where that takes no more than
const AFFORDED = 2000; // steps
const FIRST = 8; // dead times that are stepped in PARTS in any case: what is fast in them dies out
const SINGLE = 1600; // more steps than this are taken in strides that double, STRIDE at a time
const STRIDE = 64;
const BEYOND = 1e150; // an unstable response is followed no further
const INPUTS = 2; // r, d

const binomial = (n, k) => (k === 0 ? 1 : (binomial(n - 1, k - 1) * n) / k);
const factorial = (n) => (n < 2 ? 1 : n * factorial(n - 1));

/** {t, y: [for r, for d], u: [for r, for d]} of `loop` (loop.js) up to about T; null where the loop is ill-posed. */
export function unitSteps(loop, T) {
  if (loop.theta === 0) return undelayed(loop, T);
  const { theta } = loop;
  if (theta < T / STEPS) return brief(loop, T);
  const m = Math.max(Math.ceil((STEPS * theta) / T), Math.min(PARTS, Math.floor((AFFORDED * theta) / T)));
  return new March(loop, m).until(T).record;
}

/** x of both unit steps at t = 0, (n, INPUTS). */
function start(n) {
  const x = new Float64Array(n * INPUTS);
  x[(n - 2) * INPUTS] = 1;
  x[(n - 1) * INPUTS + 1] = 1;
  return x;
}

/** What is recorded: right-hand limits, and before a jump the left-hand ones too. */
class Record {
  constructor(loop) {
    this.loop = loop;
    this.theta = loop.theta;
    this.t = [];
    this.y = [[], []];
    this.u = [[], []];
  }

  /** x (n, INPUTS), w of both inputs. Whether the response is still within bounds. */
  add(t, x, w) {
    const { n, Cy, Cu, Dy, Dz } = this.loop;
    this.t.push(t);
    let largest = 0;
    for (let i = 0; i < INPUTS; i++) {
      let y = Dy * w[i];
      let u = Dz * w[i];
      for (let j = 0; j < n; j++) {
        y += Cy[j] * x[j * INPUTS + i];
        u += Cu[j] * x[j * INPUTS + i];
      }
      this.y[i].push(y);
      this.u[i].push(u);
      largest = Math.max(largest, Math.abs(y));
    }
    return largest < BEYOND;
  }
}

function undelayed(loop, T) {
  const { n, A, B, Cz, Dz } = loop;
  if (Math.abs(1 - Dz) < 1e-12) return null;
  const h = T / STEPS;
  const closed = A.map((value, k) => (value + (B[Math.floor(k / n)] * Cz[k % n]) / (1 - Dz)) * h);
  const E = exponential(closed, n);
  const record = new Record(loop);
  let x = start(n);
  for (let i = 0; i <= STEPS; i++) {
    const z = times(Cz, x, 1, n, INPUTS).map((value) => value / (1 - Dz));
    if (!record.add(i * h, x, z)) break;
    x = times(E, x, n, n, INPUTS);
  }
  return record;
}

/** The loop stepped in m parts of its dead time; what is on its way through the dead time is in a ring. */
class March {
  constructor(loop, m) {
    Object.assign(this, { loop, m, h: loop.theta / m, i: 0 });
    this.E = stepMatrix(loop, this.h, ORDER);
    this.record = new Record(loop);
    this.ring = Array.from({ length: m }, () => new Float64Array(ORDER * INPUTS));
    this.x = start(loop.n);
  }

  until(T) {
    const { loop, m, h, E, record, ring } = this;
    const { n } = loop;
    for (; (this.i - 1) * h < T; this.i++) {
      const { i, x } = this;
      const W = ring[i % m];
      if (i % m === 0 && i > 0 && loop.Dz) record.add(i * h, x, ends(this.before, 1)); // the left-hand limit
      if (!record.add(i * h, x, ends(W, -1))) break;
      const next = times(E, joined(x, W), n + ORDER, n + ORDER, INPUTS);
      this.x = next.slice(0, n * INPUTS);
      ring[i % m] = next.slice(n * INPUTS);
      this.before = W;
    }
    return this;
  }
}

/** Dead time shorter than T/STEPS: after its first steps (x, W) is the whole state, and steps may be taken together. */
function brief(loop, T) {
  const { n, theta } = loop;
  const size = n + BRIEF_ORDER;
  const begun = new March(loop, PARTS).until((FIRST - 1.5 / PARTS) * theta);
  const { record } = begun;
  if (begun.i < FIRST * PARTS) return record;
  let E = stepMatrix(loop, theta, BRIEF_ORDER);
  let state = joined(begun.x, whole(begun.ring));
  let stride = theta;
  const together = T / theta > SINGLE;
  for (let t = FIRST * theta, i = 0; t - stride < T; t += stride) {
    if (!record.add(t, state, ends(state.subarray(n * INPUTS), -1))) break;
    if (together && i > 0 && i % STRIDE === 0 && 2 * stride <= T / AFFORDED) {
      E = times(E, E, size, size, size);
      stride *= 2;
    }
    state = times(E, state, size, size, INPUTS);
    i += 1;
  }
  return record;
}

const GAUSS = [
  [-0.8611363115940526, 0.3478548451374538],
  [-0.3399810435848563, 0.6521451548625461],
  [0.3399810435848563, 0.6521451548625461],
  [0.8611363115940526, 0.3478548451374538],
];

/** The parts of a dead time as one polynomial over it, in least squares: W_j = (2j+1) int_0^1 P_j(2s-1) w ds. */
function whole(ring) {
  const W = new Float64Array(BRIEF_ORDER * INPUTS);
  for (const [part, piece] of ring.entries())
    for (const [node, weight] of GAUSS) {
      const P = legendre(node, ORDER);
      const Q = legendre((2 * part + 1 + node) / ring.length - 1, BRIEF_ORDER);
      for (let i = 0; i < INPUTS; i++) {
        let w = 0;
        for (let j = 0; j < ORDER; j++) w += P[j] * piece[j * INPUTS + i];
        for (let j = 0; j < BRIEF_ORDER; j++)
          W[j * INPUTS + i] += ((2 * j + 1) * Q[j] * w * weight) / (2 * ring.length);
      }
    }
  return W;
}

/** P_0 .. P_{count-1} at x. */
function legendre(x, count) {
  const P = [1, x];
  for (let j = 1; j + 1 < count; j++) P.push(((2 * j + 1) * x * P[j] - j * P[j - 1]) / (j + 1));
  return P;
}

function joined(x, W) {
  const state = new Float64Array(x.length + W.length);
  state.set(x);
  state.set(W, x.length);
  return state;
}

/** w at an end of its step: side -1 for the beginning, 1 for the end; P_j(+-1) = (+-1)^j. */
function ends(W, side) {
  const w = [0, 0];
  for (let j = 0; j * INPUTS < W.length; j++) for (let i = 0; i < INPUTS; i++) w[i] += side ** j * W[j * INPUTS + i];
  return w;
}

/** (x, W) -> (x+, Z) over a step of length h, (n + order, n + order). */
function stepMatrix({ n, A, B, Cz, Dz }, h, order) {
  const [w, R] = [n, n + order]; // places of w, w', w'', ... and of R_1, R_2, ...
  const size = n + 2 * order;
  const M = new Float64Array(size * size);
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) M[i * size + j] = h * A[i * n + j];
    M[i * size + w] = h * B[i];
    M[R * size + i] = Cz[i];
  }
  M[R * size + w] = Dz;
  for (let k = 0; k + 1 < order; k++) {
    M[(w + k) * size + w + k + 1] = 1;
    M[(R + k + 1) * size + R + k] = 1;
  }
  const E = exponential(M, size);
  // from W to w, w', ... at the beginning, and from R_k = int (1-s)^(k-1)/(k-1)! z ds to the moments Z
  const inward = new Float64Array((n + order) * size);
  const before = new Float64Array(size * (n + order));
  for (let i = 0; i < n; i++) before[i * (n + order) + i] = inward[i * size + i] = 1;
  for (let j = 0; j < order; j++)
    for (let k = 0; k <= j; k++) {
      const weight = binomial(j, k) * binomial(j + k, k) * factorial(k);
      before[(w + k) * (n + order) + n + j] = (-1) ** (j + k) * weight;
      inward[(n + j) * size + R + k] = (2 * j + 1) * (-1) ** k * weight;
    }
  return times(inward, times(E, before, size, size, n + order), n + order, size, n + order);
}

/**
 * A set point of height r from 0 on and a load of height d from `load` on: {t, y, u}. A height that is reached evenly
 * in the time r_ramp or d_ramp makes the mean of the step response over that time. record, ramps: unit responses to
 * steps, and to ramps of slope 1 where there are any.
 *
 * Instants are those of the set-point response before the load step and those of the load response after it, where the
 * set-point response is smooth enough to be read between its own.
 */
export function scenario(record, ramps, { r, d, load, r_ramp, d_ramp }, T) {
  const [first, second] = [0, 1];
  const before = record.t.filter((t) => t < load && t < T);
  const after = record.t.map((t) => t + load).filter((t) => t < T);
  const t = load < T ? [...before, load, ...after, T] : [...before, T];
  const begins = before.length + 1; // the load step is seen from here on
  const both = (signal) => {
    const [ofR, ofD] = [
      course(record, ramps, (of) => of[signal][first], r_ramp),
      course(record, ramps, (of) => of[signal][second], d_ramp),
    ];
    return t.map((s, i) => {
      const late = i >= begins && load < T;
      return r * ofR(s) + (late ? d * ofD(s - load) : 0);
    });
  };
  return { t, y: both("y"), u: both("u") };
}

/** The response of one input to a step, or to a ramp of this duration, at any instant >= 0. */
function course(steps, ramps, curve, ramp) {
  if (!ramp) return (at) => reading(steps, curve(steps), at);
  const risen = (at) => (at <= 0 ? 0 : reading(ramps, curve(ramps), at));
  return (at) => (risen(at) - risen(at - ramp)) / ramp;
}

/** Index of the last of increasing t that is not above `at`; the first one where all are. */
function below(t, at) {
  let [low, high] = [0, t.length];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (t[middle] <= at) low = middle;
    else high = middle;
  }
  return low;
}

const KINKS = 8; // multiples of theta at which a curve may bend too sharply to be read across

/** The curve between its points: a polynomial through up to four of them, not across a jump or an early kink. */
export function reading({ t, theta }, curve, at) {
  const last = t.length - 1;
  const low = below(t, at);
  const high = low + 1;
  if (low === last || t[low] === at) return curve[low];
  let [first, end] = [Math.max(0, low - 1), Math.min(last, low + 2)];
  const k = Math.floor((at / theta) * (1 + 1e-12));
  if (theta && k < KINKS) {
    while (t[first] < k * theta * (1 - 1e-9)) first++;
    while (t[end] > (k + 1) * theta * (1 + 1e-9)) end--;
  }
  while (first < low && t[first] === t[first + 1]) first++;
  if (t[low - 1] === t[low]) first = low;
  if (t[high] === t[high + 1]) end = high;
  let sum = 0;
  for (let j = first; j <= end; j++) {
    let weight = 1;
    for (let i = first; i <= end; i++) if (i !== j) weight *= (at - t[i]) / (t[j] - t[i]);
    sum += weight * curve[j];
  }
  return sum;
}
