// SPDX-License-Identifier: Apache-2.0
// Charts of the recent phase and RSSI of one tag: a small canvas each, one colour per antenna.

import {antennaColor} from "../colors.js";

const MARGIN = {
  left: 40,
  right: 8,
  top: 22,
  bottom: 18
};
const POINT_PX = 2.4;

function ticks(low, high, most) {
  const rough = (high - low) / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough);
  const all = [];
  for (let value = Math.ceil(low / step - 1e-9) * step; value <= high + 1e-9 * step; value += step)
    all.push(value);
  return all;
}

// points: flat array of time, value, antenna. axis: {title, low, high, label?(value), ticks?}
export function drawChart(canvas, points, from, to, axis, style) {
  const ratio = Math.min(devicePixelRatio, 2);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (!width || !height) return;
  if (canvas.width !== Math.round(width * ratio)) canvas.width = Math.round(width * ratio);
  if (canvas.height !== Math.round(height * ratio)) canvas.height = Math.round(height * ratio);
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "11px system-ui, sans-serif";
  const x = (t) => MARGIN.left + ((t - from) / (to - from)) * (width - MARGIN.left - MARGIN.right);
  const y = (v) => height - MARGIN.bottom -
    ((v - axis.low) / (axis.high - axis.low)) * (height - MARGIN.top - MARGIN.bottom);
  pen.strokeStyle = style.line;
  pen.fillStyle = style.faint;
  pen.lineWidth = 1;
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (const value of axis.ticks ?? ticks(axis.low, axis.high, 4)) {
    pen.beginPath();
    pen.moveTo(MARGIN.left, y(value));
    pen.lineTo(width - MARGIN.right, y(value));
    pen.stroke();
    pen.fillText(
      axis.label ? axis.label(value) : String(value).replace("-", "−"), MARGIN.left - 5, y(value));
  }
  pen.textAlign = "center";
  pen.textBaseline = "alphabetic";
  for (const t of ticks(from, to, 5)) {
    if (t >= 0)
      pen.fillText(
        `${Number(t.toFixed(3))} s`, Math.min(Math.max(x(t), 20), width - 16), height - 4);
  }
  pen.textAlign = "left";
  pen.fillStyle = style.ink;
  pen.fillText(axis.title, 2, 11);
  for (let i = 0; i < points.length; i += 3) {
    pen.fillStyle = antennaColor(points[i + 2]);
    pen.beginPath();
    pen.arc(x(points[i]), y(points[i + 1]), POINT_PX, 0, 2 * Math.PI);
    pen.fill();
  }
}
