// SPDX-License-Identifier: Apache-2.0
// Renders formulas with KaTeX.
document.addEventListener("DOMContentLoaded", () => {
  if (typeof katex === "undefined") return; // Formulas remain TeX source.
  for (const element of document.querySelectorAll(".formula")) {
    katex.render(element.textContent, element, {
      displayMode: element.tagName === "DIV",
      throwOnError: false,
    });
  }
});
