// Keys of the lecture view of a page: Esc leaves it, H hides numbers and curves, arrows go through a story.

const STEPS = ".st-key-story > [data-testid=stElementContainer]";
const VEILED = "veiled"; // class of the page while they are hidden
const THEIRS = "input, textarea, [role=slider], [role=tab], [role=radio]"; // what has a use of its own for these keys

export default function () {
  const page = document.querySelector("[data-testid=stMain]");
  const steps = () => document.querySelectorAll(STEPS).length;
  const hidden = document.head.appendChild(document.createElement("style")); // it holds for steps that come later too
  let shown = 0;
  const story = () => {
    // Streamlit's own words are made visible each
    hidden.textContent = `${STEPS}:nth-child(n + ${shown + 2}) * { visibility: hidden }`;
  };
  const keys = {
    Escape: () => document.querySelector(".st-key-lecture_leave button")?.click(),
    h: () => page.classList.toggle(VEILED),
    ArrowRight: () => {
      shown = Math.min(shown + 1, Math.max(steps() - 1, 0));
      story();
    },
    ArrowLeft: () => {
      shown = Math.max(shown - 1, 0);
      story();
    },
  };
  const press = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches(THEIRS)) return;
    keys[event.key.length === 1 ? event.key.toLowerCase() : event.key]?.();
  };
  document.addEventListener("keydown", press);
  story();
  return () => {
    document.removeEventListener("keydown", press);
    page.classList.remove(VEILED);
    hidden.remove();
  };
}
