// An instrument on the page. Messages come as elements of their own (message.js), some of them before it is there.

import { letters } from "./letters.js";
import { onPaper } from "./paper.js";
import { skipTo } from "./skip.js";
import { unpack } from "./table.js";

/**
 * Streamlit calls what this gives whenever the data are others. Where that happens before the script is loaded, it
 * calls twice, and says of the first call that it is over although the instrument stays: only who is not called again
 * leaves.
 */
export function mount(name, make) {
  const known = new WeakMap(); // element of the page -> its instrument
  return ({ parentElement, data, setTriggerValue }) => {
    const root = parentElement.querySelector(".live");
    let one = known.get(parentElement);
    if (one?.root !== root) {
      if (one) leave(one);
      one = make(root);
      known.set(parentElement, one);
    }
    one.ends ??= [skipTo(one), onPaper(one)];
    one.send = (what) => setTriggerValue("release", what);
    one.take(unpack(data));
    const box = letters(name);
    box.owner = one;
    box.open = (message) => given(one, message);
    for (const message of box.waiting.splice(0)) box.open(message);
    const turn = (one.turn ?? 0) + 1;
    one.turn = turn;
    return () => setTimeout(() => one.turn === turn && leave(one, box));
  };
}

function leave(one, box) {
  one.leave();
  for (const end of one.ends ?? []) end();
  one.ends = null;
  if (box?.owner === one) box.open = null;
}

/** What is said of lessons and of the lecture view is the same for all instruments. */
function given(one, message) {
  if (message.kind === "link") one.lecture.show(message);
  else if (message.kind === "lecture") one.lecture.asked(message);
  else if (message.kind === "stage") one.stage(message);
  else one.take(message);
}
