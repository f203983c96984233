// The figures of the strip of a single loop: name, words, and whether it is a peak Ms.

export const FIGURES = [
  ["Ms", "Ms, peak of |S|", true],
  ["GM", "Gain margin"],
  ["PM_deg", "Phase margin °"],
  ["delay_margin", "Delay margin"],
  ["IAE_setpoint", "IAE set point"],
  ["IAE_load", "IAE load"],
  ["Mt", "Mt, peak of |T|"],
  ["TV_setpoint", "TV set point"],
  ["TV_load", "TV load"],
  ["overshoot", "Overshoot %"],
  ["noise_gain", "Noise gain"],
];
