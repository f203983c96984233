// What the knobs mean: the plant and the controller at their places.

/** setup: {plant, controller: {form, settings, tau_F, b, c}}; values: of the knobs, sizes without sign. */
export function turned({ plant, controller }, values) {
  return {
    plant: turnedPlant(plant, values),
    controller: parallel({ ...controller, settings: settingsAt(controller, values) }),
  };
}

function settingsAt({ settings }, values) {
  return Object.fromEntries(
    Object.entries(settings).map(([name, value]) => [name, name in values ? signed(values[name], value) : value]),
  );
}

/** k, theta and tau1, the largest time constant, whichever of them has a knob. */
function turnedPlant(plant, values) {
  const { k, theta, tau1 } = values;
  const lags = [...plant.lags];
  if (tau1 !== undefined) {
    const at = largest(lags);
    lags[at] = signed(tau1, lags[at]);
  }
  return { ...plant, lags, k: k === undefined ? plant.k : signed(k, plant.k), theta: theta ?? plant.theta };
}

export function largest(lags) {
  return lags.reduce((best, tau, i) => (Math.abs(tau) > Math.abs(lags[best]) ? i : best), 0);
}

const signed = (size, like) => (like < 0 ? -size : size);

/** Kp, Ki, Kd of a controller in series, ideal or parallel form, or of integral action alone. */
export function parallel({ form, settings, tau_F, b, c }) {
  const rest = { tau_F, b, c };
  if (form === "I") return { Kp: 0, Ki: settings.K_I, Kd: 0, ...rest };
  if (form === "parallel") return { ...settings, ...rest };
  const { Kc, tau_I: integral, tau_D } = settings;
  const tau_I = integral ?? Infinity; // JSON has no infinity: no integral action
  const f = form === "series" ? 1 + tau_D / tau_I : 1;
  return { Kp: f * Kc, Ki: Kc / tau_I, Kd: Kc * tau_D, ...rest };
}
