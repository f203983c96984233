export default mount("tuning", (root) => new Tuning(root));
