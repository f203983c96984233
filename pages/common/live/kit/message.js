// Numbers for an instrument on the same page, in a message of their own: the large tables stay in the browser's cache.

import { letters } from "./letters.js";
import { unpack } from "./table.js";

export default function ({ data }) {
  const message = unpack(data);
  const box = letters(message.to);
  if (message.once) {
    if (box.heard === message.once) return; // it stands there in the next run, too
    box.heard = message.once;
  }
  if (box.open) box.open(message);
  else box.waiting.push(message);
}
