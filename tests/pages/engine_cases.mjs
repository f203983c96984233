// Reads [{plant, controller, steps, end}] from standard input and prints what the live engine draws of each.
import { readFileSync } from "node:fs";

import { picture } from "../../pages/common/live/engine/picture.js";

const cases = JSON.parse(readFileSync(0, "utf-8"));
const drawn = cases.map(({ plant, controller, steps, end }) => picture(plant, controller, steps, end));
process.stdout.write(JSON.stringify(drawn, (_, value) => (value === Infinity ? "inf" : value)));
