// Numbers for an instrument on the same page, in a message of their own: the large tables stay in the browser's cache.
export default function ({ data }) {
  const message = unpack(data);
  const box = letters(message.to);
  if (box.open) box.open(message);
  else box.waiting.push(message);
}
