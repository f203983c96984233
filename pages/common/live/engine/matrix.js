// Small dense matrices, row by row in a Float64Array: product and exponential.

/** C = A B; A is (rows, inner), B (inner, columns). */
export function times(A, B, rows, inner, columns) {
  const C = new Float64Array(rows * columns);
  for (let i = 0; i < rows; i++)
    for (let k = 0; k < inner; k++) {
      const a = A[i * inner + k];
      if (a === 0) continue;
      const row = k * columns;
      for (let j = 0, c = i * columns; j < columns; j++, c++) C[c] += a * B[row + j];
    }
  return C;
}

const TERMS = 12; // of the Taylor series, for a norm of at most 1/2: 2^-13/13! = 2e-14

/** e^A by scaling and squaring; A is (n, n). */
export function exponential(A, n) {
  let norm = 0;
  for (let i = 0; i < n; i++) {
    let sum = 0;
    for (let j = 0; j < n; j++) sum += Math.abs(A[i * n + j]);
    norm = Math.max(norm, sum);
  }
  const squarings = Math.max(0, Math.ceil(Math.log2(norm || 1)) + 1);
  const scaled = A.map((value) => value / 2 ** squarings);
  let E = identity(n);
  for (let k = TERMS; k > 0; k--) {
    // Horner: E = 1 + A E/k
    E = times(scaled, E, n, n, n);
    for (let i = 0; i < E.length; i++) E[i] /= k;
    for (let i = 0; i < n; i++) E[i * n + i] += 1;
  }
  for (let k = 0; k < squarings; k++) E = times(E, E, n, n, n);
  return E;
}

function identity(n) {
  const E = new Float64Array(n * n);
  for (let i = 0; i < n; i++) E[i * n + i] = 1;
  return E;
}
