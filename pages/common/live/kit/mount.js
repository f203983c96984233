// An instrument on the page. Messages come as elements of their own (message.js), some of them before it is there.

import { letters } from "./letters.js";
import { onPaper } from "./paper.js";
import { skipTo } from "./skip.js";
import { unpack } from "./table.js";

export function mount(name, make) {
  const live = new Map(); // element of the page -> its instrument
  return ({ parentElement, data, setTriggerValue }) => {
    let one = live.get(parentElement);
    if (!one) {
      one = make(parentElement.querySelector(".live"));
      live.set(parentElement, one);
      one.ends = [skipTo(one), onPaper(one)];
    }
    one.send = (what) => setTriggerValue("release", what);
    one.take(unpack(data));
    const box = letters(name);
    box.open = (message) => given(one, message);
    for (const message of box.waiting.splice(0)) box.open(message);
    return () => {
      one.leave();
      for (const end of one.ends) end();
      live.delete(parentElement);
      if (live.size === 0) box.open = null;
    };
  };
}

/** What is said of lessons and of the lecture view is the same for all instruments. */
function given(one, message) {
  if (message.kind === "link") one.lecture.show(message);
  else if (message.kind === "lecture") one.lecture.asked(message);
  else if (message.kind === "stage") one.stage(message);
  else one.take(message);
}
