// SPDX-License-Identifier: Apache-2.0
// Creates an element in one call. Text is set as text only: data from a server is never parsed as
// HTML.

export function h(name, properties = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on"))
      element.addEventListener(key.slice(2), value);
    else if (key === "text")
      element.textContent = value;
    else if (key === "value")
      element.value = value;
    else
      element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

export const minus = (text) => text.replace("-", "−");

export function fixed(value, digits = 1) {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : minus(text);
}

export function signed(value, digits = 1) {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? `+${text.replace("-", "")}` : (value > 0 ? "+" : "") + minus(text);
}

// "tag2" before "tag10".
export const naturally = new Intl.Collator("en", {numeric: true}).compare;
