// What screen readers, hyphenation and quotation marks go by.
export default function ({ data }) {
  document.documentElement.lang = data.language;
}
