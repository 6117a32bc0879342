// SPDX-License-Identifier: Apache-2.0
// Keyboard shortcuts: time, views and search everywhere, rotating and zooming while the canvas has
// the focus.

const TURN_RAD = 0.12;
const ZOOM = 1.12;
const VIEWS = {
  1: "world",
  2: "top",
  3: "side",
  4: "follow"
};
const TURNS = {
  ArrowLeft: [-TURN_RAD, 0, 1],
  ArrowRight: [TURN_RAD, 0, 1],
  ArrowUp: [0, -TURN_RAD, 1],
  ArrowDown: [0, TURN_RAD, 1],
  "+": [0, 0, 1 / ZOOM],
  "=": [0, 0, 1 / ZOOM],
  "-": [0, 0, ZOOM]
};

// view: {at, timeBar(), lists, look(name), stage | null, deselect()}
export function listenToKeys(target, view) {
  target.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const focused = view.at.root.activeElement;
    if (press(event, focused, view)) event.preventDefault();
  });
}

function press(event, focused, view) {
  if (event.key === "Escape") return view.deselect();
  const writes = focused && focused.matches("input, select, textarea");
  if (writes) return false;
  if (focused === view.at.canvas && view.stage && TURNS[event.key]) {
    view.stage.orbit(...TURNS[event.key]);
    return true;
  }
  if (VIEWS[event.key]) {
    view.look(VIEWS[event.key]);
    return true;
  }
  if (event.key === "/") {
    view.lists.search.focus();
    return true;
  }
  const time = view.timeBar();
  if (!time) return false;
  if (event.key === " " && !focused?.matches("button"))
    time.toggle();
  else if (event.key === ".")
    time.stepOn();
  else if (event.key === "ArrowRight" && time.recording)
    time.stepOn(event.shiftKey ? 10 : 1);
  else if (event.key === "ArrowLeft" && time.recording)
    time.stepOn(event.shiftKey ? -10 : -1);
  else
    return false;
  return true;
}
