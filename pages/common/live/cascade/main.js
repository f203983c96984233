export default mount("cascade", (root) => new Cascade(root));
