// Exact numbers for the instrument on the same page, in a message of their own: the table stays in the browser's cache.
export default function ({ data }) {
  if (globalThis.simcExact) globalThis.simcExact(data);
  else globalThis.simcPending = data;
}
