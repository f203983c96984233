import { mount } from "../kit/mount.js";
import { Tuning } from "./tuning.js";

export default mount("tuning", (root) => new Tuning(root));
