// Before a page is printed figures shrink to the width of the paper, and they grow again after it.

const PAPER = 680; // px of a sheet of A4 between its margins

export default function () {
  const figures = () => document.querySelectorAll(".js-plotly-plot");
  const before = () => {
    for (const figure of figures()) figure.style.zoom = Math.min(1, PAPER / figure.getBoundingClientRect().width);
  };
  const after = () => {
    for (const figure of figures()) figure.style.zoom = "";
  };
  addEventListener("beforeprint", before);
  addEventListener("afterprint", after);
  return () => {
    removeEventListener("beforeprint", before);
    removeEventListener("afterprint", after);
  };
}
