// The first thing the keyboard comes to: a way past navigation and fields to the slider.

import { button } from "./format.js";
import { said } from "./words.js";

/** On the page outside the instrument, styled by shell/style.css; returns what takes it away again. */
export function skipTo(live) {
  const link = button(said("Skip to the slider"), "", () => live.slider.handle.focus());
  link.className = "skip_to_slider";
  document.body.prepend(link);
  return () => link.remove();
}
