import { mount } from "../kit/mount.js";
import { Hand } from "./hand.js";

export default mount("hand", (root) => new Hand(root));
