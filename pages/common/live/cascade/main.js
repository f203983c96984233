import { mount } from "../kit/mount.js";
import { Cascade } from "./cascade.js";

export default mount("cascade", (root) => new Cascade(root));
