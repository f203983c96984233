// The instrument of the plane of Kc and tau_I: my settings are a point under the hand, the responses follow.

import { Hand } from "../hand/hand.js";
import { text } from "../kit/format.js";
import { listed } from "../kit/words.js";
import { responsePanels } from "../tuning/panels.js";
import { PlanePanel } from "./panel.js";

export class Plane extends Hand {
  constructor(root) {
    super(root);
    root.classList.add("plane");
  }

  panelSets(scale) {
    const { panels, draw } = responsePanels(this.setup, scale);
    const [output, input] = panels;
    this.plane = new PlanePanel(this.setup.plane, scale, {
      moved: (Kc, tau_I) => this.put([Kc, tau_I]),
      held: (yes) => this.hold(yes),
      released: () => this.release(),
      picked: (key) => this.ask({ pick: key }),
      words: () => this.title(),
    });
    return { responses: { panels: [this.plane, output, input], draw } };
  }

  /** Both knobs at once; undefined leaves one where it is. */
  put(values) {
    for (const [i, value] of values.entries()) if (value !== undefined) this.used[i].move(value);
  }

  /** What Python says meanwhile waits until the hand has left the point. */
  hold(yes) {
    for (const slider of this.used) slider.held = yes;
  }

  show() {
    super.show();
    if (this.furnished) this.plane?.follow(this.used.map((slider) => slider.tau_c));
  }

  title() {
    const [Kc, tau_I] = this.used.map((slider) => text(slider.tau_c));
    return listed([`Kc = ${Kc}`, `τI = ${tau_I}`]);
  }
}
