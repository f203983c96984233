// A plant and a controller as one system, opened at the dead time.
//
//     x' = A x + B w    y = Cy x + Dy w    z = u + d = Cz x + Dz w    w(t) = z(t - theta)
//
// x holds the sections of the plant, the controller's integral, with tau_F > 0 also the filtered y and r, and last r
// and d, which are constant: a unit step of each is a column of the initial state. Where they are ramps, their slopes are
// the last two states, and constant.
//
// plant       {k, theta, lags, leads, integrators, lag_pairs, lead_pairs}, as simc_core's Plant; pairs are [tau, zeta]
// controller  {Kp, Ki, Kd, tau_F, b, c}, as simc_core's ParallelPid

/** Numerators and denominators [s^2, s, 1] whose product is the plant without gain and dead time; quadratics first. */
export function sections(plant) {
  const den = paired([
    ...plant.lag_pairs.map(quadratic),
    ...Array(plant.integrators).fill([0, 1, 0]),
    ...plant.lags.map((tau) => [0, tau, 1]),
  ]);
  const num = paired([...plant.lead_pairs.map(quadratic), ...plant.leads.map((T) => [0, T, 1])]);
  return den.map((row, i) => [num[i] ?? [0, 0, 1], row]);
}

const quadratic = ([tau, zeta]) => [tau * tau, 2 * zeta * tau, 1];

function paired(rows) {
  const quadratics = rows.filter(([a]) => a);
  const linear = rows.filter(([a]) => !a);
  while (linear.length > 1) {
    const [, b1, c1] = linear.shift();
    const [, b2, c2] = linear.shift();
    quadratics.push([b1 * b2, b1 * c2 + b2 * c1, c1 * c2]);
  }
  return [...quadratics, ...linear];
}

/** A, B, C, D of the plant without its dead time: each section drives the next. */
function chain(plant) {
  const parts = sections(plant);
  const n = parts.reduce((sum, [, [a]]) => sum + (a ? 2 : 1), 0);
  const A = new Float64Array(n * n);
  const B = new Float64Array(n);
  let C = new Float64Array(n);
  let D = 1;
  let used = 0;
  for (const [[b2, b1, b0], [a, b, c]] of parts) {
    const size = a ? 2 : 1;
    const last = used + size - 1;
    const lead = a || b; // coefficient of the highest power
    const through = a ? b2 / a : b1 / b;
    for (let j = 0; j < n; j++) A[last * n + j] = C[j] / lead; // u of this section is y of the one before
    B[last] = D / lead;
    A[last * n + used] = -c / lead;
    if (a) {
      A[last * n + last] = -b / a;
      A[used * n + last] = 1;
    }
    C = C.map((value) => through * value);
    D *= through;
    C[used] = b0 - through * c;
    if (a) C[last] = b1 - through * b;
    used += size;
  }
  return { n, A, B, C: C.map((value) => plant.k * value), D: plant.k * D };
}

/** The system of the head of this file, ramped: with slopes; or null where this engine has none: a jump would have to be differentiated. */
export function openedLoop(plant, { Kp, Ki, Kd, tau_F, b, c }, ramped = false) {
  const g = chain(plant);
  const filtered = tau_F > 0;
  const [p, q, I] = filtered ? [g.n, g.n + 1, g.n + 2] : [-1, -1, g.n];
  const [r, d] = [I + 1, I + 2];
  const n = I + (ramped ? 5 : 3);
  if (!filtered && Kd && (g.D || c)) return null;
  const A = new Float64Array(n * n);
  const B = new Float64Array(n);
  if (ramped) A[r * n + n - 2] = A[d * n + n - 1] = 1;
  const [Cy, Cu] = [new Float64Array(n), new Float64Array(n)];
  for (let i = 0; i < g.n; i++) {
    A.set(g.A.subarray(i * g.n, (i + 1) * g.n), i * n);
    B[i] = g.B[i];
    Cy[i] = g.C[i];
  }
  let Du;
  if (filtered) {
    for (let j = 0; j < g.n; j++) A[p * n + j] = g.C[j] / tau_F;
    B[p] = g.D / tau_F;
    A[p * n + p] = A[q * n + q] = -1 / tau_F;
    A[q * n + r] = 1 / tau_F;
    A[I * n + q] = 1;
    A[I * n + p] = -1;
    for (let j = 0; j < g.n; j++) Cu[j] = (-Kd * g.C[j]) / tau_F;
    Cu[p] = -Kp + Kd / tau_F;
    Cu[q] = b * Kp - (c * Kd) / tau_F;
    Cu[r] = (c * Kd) / tau_F;
    Du = (-Kd * g.D) / tau_F;
  } else {
    for (let j = 0; j < g.n; j++) {
      let slope = 0; // y' = C (A x + B w)
      for (let i = 0; i < g.n; i++) slope += g.C[i] * g.A[i * g.n + j];
      A[I * n + j] = -g.C[j];
      Cu[j] = -Kp * g.C[j] - Kd * slope;
    }
    B[I] = -g.D;
    A[I * n + r] = 1;
    Cu[r] = b * Kp;
    Du = -Kp * g.D - Kd * g.C.reduce((sum, value, i) => sum + value * g.B[i], 0);
  }
  Cu[I] = Ki;
  const Cz = Cu.slice();
  Cz[d] += 1;
  return { n, A, B, Cy, Dy: g.D, Cu, Cz, Dz: Du, theta: plant.theta };
}
