import { mount } from "../kit/mount.js";
import { Plane } from "./plane.js";

export default mount("plane", (root) => new Plane(root));
