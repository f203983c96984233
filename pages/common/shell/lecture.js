// Keys of the lecture view of a page: Esc leaves it, H hides numbers and curves, arrows go through a story.

const VEILED = "veiled"; // class of the page while they are hidden
const THEIRS = "input, textarea, [role=slider], [role=tab], [role=radio]"; // what has a use of its own for these keys

export default function () {
  const page = document.querySelector("[data-testid=stMain]");
  const steps = () => [...document.querySelectorAll(".st-key-story [data-testid=stMarkdown]")];
  let shown = 0;
  const story = () => {
    steps().forEach((step, i) => {
      step.style.visibility = i > shown ? "hidden" : "";
    });
  };
  const keys = {
    Escape: () => document.querySelector(".st-key-lecture_leave button")?.click(),
    h: () => page.classList.toggle(VEILED),
    ArrowRight: () => {
      shown = Math.min(shown + 1, steps().length - 1);
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
    for (const step of steps()) step.style.visibility = "";
  };
}
