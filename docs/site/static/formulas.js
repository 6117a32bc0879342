// SPDX-License-Identifier: Apache-2.0
// Formulas as KaTeX draws them.
document.addEventListener("DOMContentLoaded", () => {
  if (typeof katex === "undefined") return; // They stand there as TeX.
  for (const element of document.querySelectorAll(".formula")) {
    katex.render(element.textContent, element, {
      displayMode: element.tagName === "DIV",
      throwOnError: false,
    });
  }
});
