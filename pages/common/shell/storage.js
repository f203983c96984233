// The loops of this browser, in its own storage: nothing leaves the machine.
// Python asks once what is kept; from then on it tells what to keep. Loops of other tabs stay as they are.

const KEY = "simc-loops";

function kept() {
  try {
    return localStorage.getItem(KEY) ?? "";
  } catch {
    return ""; // storage is switched off, or the page is embedded somewhere that has none
  }
}

/** The project that is stored, with the loops of `mine` in place of all that this session has known. */
export function merged(stored, mine, known) {
  const project = mine ? JSON.parse(mine) : null;
  const others = read(stored).filter(({ id }) => !known.includes(id));
  const loops = [...others, ...(project?.loops ?? [])];
  if (!loops.length) return "";
  const current = project ? others.length + project.current : 0;
  return JSON.stringify({ format: "simc-project", version: 2, current, loops });
}

function read(text) {
  try {
    return JSON.parse(text).loops ?? [];
  } catch {
    return [];
  }
}

export default function ({ data, setTriggerValue }) {
  if (data.ask) {
    setTriggerValue("kept", { text: kept() });
    return;
  }
  try {
    const text = merged(kept(), data.mine, data.known);
    if (text) localStorage.setItem(KEY, text);
    else localStorage.removeItem(KEY);
  } catch {
    // full, or switched off: the link and the project file are there
  }
}
