// A text to copy with one click. Over plain http and in some frames browsers have the old way only.
export default function ({ parentElement, data }) {
  const box = parentElement.querySelector("pre");
  const button = parentElement.querySelector("button");
  box.textContent = data.text;
  button.textContent = data.copy;
  button.onclick = async () => {
    getSelection().selectAllChildren(box);
    try {
      await navigator.clipboard.writeText(data.text);
    } catch {
      document.execCommand("copy");
    }
    button.textContent = data.copied;
    setTimeout(() => (button.textContent = data.copy), 1500);
  };
}
