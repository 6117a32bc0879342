// SPDX-License-Identifier: Apache-2.0
// Light and dark theme: that of the system until the user switches it.

const COLORS = {
  light: {
    background: "#e4e9ee",
    floor: "#f6f7f8",
    grid: "#b4bdc7",
    edge: "#1d2731",
    unread: "#7b858f",
    ink: "#101820",
    path: "#66788a",
    blocked: "#c2255c",
    estimate: "#6b21a8"
  },
  dark: {
    background: "#14181d",
    floor: "#20262d",
    grid: "#46515d",
    edge: "#000000",
    unread: "#8f99a3",
    ink: "#ffffff",
    path: "#8b9bab",
    blocked: "#ff7aa8",
    estimate: "#d8b4fe"
  }
};
const KEY = "tagfield-theme";

function remembered() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;  // Storage is not allowed here: the system's theme applies.
  }
}

export class Theme {
  // apply(colors) is called immediately and at each change.
  constructor(at, apply) {
    this.at = at;
    this.apply = apply;
    this.dark = matchMedia("(prefers-color-scheme: dark)");
    this.chosen = remembered();
    this.dark.addEventListener("change", () => this.set());
    at.theme.addEventListener("click", () => {
      this.chosen = this.name() === "dark" ? "light" : "dark";
      try {
        localStorage.setItem(KEY, this.chosen);
      } catch {
        // Not stored: the choice lasts until the page is closed.
      }
      this.set();
    });
    this.set();
  }

  name() {
    return this.chosen in COLORS ? this.chosen : this.dark.matches ? "dark" : "light";
  }

  set() {
    const name = this.name();
    this.at.view.dataset.theme = name;
    this.at.theme.textContent = name === "dark" ? "Light" : "Dark";
    this.apply(COLORS[name]);
  }
}
