// What was predicted in which lesson, in the browser's own storage. Python asks once, and from then on tells.

const KEY = "simc-lessons";

function kept() {
  try {
    return localStorage.getItem(KEY) ?? "";
  } catch {
    return ""; // storage is switched off, or the page is embedded somewhere that has none
  }
}

/** What is stored, with what this session knows in place of it. */
export function joined(stored, mine) {
  try {
    return JSON.stringify({ ...JSON.parse(stored || "{}"), ...mine });
  } catch {
    return JSON.stringify(mine);
  }
}

export default function ({ data, setTriggerValue }) {
  if (data.ask) {
    setTriggerValue("kept", { text: kept() });
    return;
  }
  try {
    if (data.forget) localStorage.removeItem(KEY);
    else localStorage.setItem(KEY, joined(kept(), data.mine));
  } catch {
    // full, or switched off
  }
}
