// Numbers for an instrument on the same page, in a message of their own: the large tables stay in the browser's cache.

import { letters } from "./letters.js";
import { unpack } from "./table.js";

export default function ({ data }) {
  const message = unpack(data);
  if (message.once) {
    globalThis.simcHeard ??= new Set(); // of all languages: it stands there in the next run, too
    if (globalThis.simcHeard.has(message.once)) return;
    globalThis.simcHeard.add(message.once);
  }
  const box = letters(message.to);
  if (box.open) box.open(message);
  else box.waiting.push(message);
}
