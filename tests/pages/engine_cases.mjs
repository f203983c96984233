// Reads [{plant, controller, end, load}] from standard input and prints what the live engine draws of each.
import { readFileSync } from "node:fs";

import { picture } from "../../pages/common/live/engine/picture.js";

const cases = JSON.parse(readFileSync(0, "utf-8"));
const drawn = cases.map(({ plant, controller, end, load }) => picture(plant, controller, { r: 1, d: 1, load }, end));
process.stdout.write(JSON.stringify(drawn, (_, value) => (value === Infinity ? "inf" : value)));
