// What is saved: files from the server, and the panels as one picture.

import { element } from "./plot.js";

const KEPT = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-opacity", "stroke-linejoin", "font-family", "font-size"];

function offer(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

export function keep(name, mime, base64) {
  offer(new Blob([Uint8Array.from(atob(base64), (one) => one.charCodeAt(0))], { type: mime }), name);
}

export async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

// All charts in a box, one above the other, with the looks that the page gives them.
function together(box) {
  const charts = [...box.querySelectorAll("svg")];
  const width = Math.max(...charts.map((chart) => chart.clientWidth));
  const height = charts.reduce((sum, chart) => sum + chart.clientHeight, 0);
  const whole = element("svg", { width, height, viewBox: `0 0 ${width} ${height}` });
  element("rect", { width, height, fill: getComputedStyle(document.body).backgroundColor }, whole);
  let top = 0;
  for (const chart of charts) {
    const group = element("g", { transform: `translate(0 ${top})` }, whole);
    for (const child of chart.children) group.append(child.cloneNode(true));
    const [from, to] = [[...chart.querySelectorAll("path, text")], [...group.querySelectorAll("path, text")]];
    from.forEach((node, i) => {
      const look = getComputedStyle(node);
      for (const key of KEPT) to[i].setAttribute(key, look.getPropertyValue(key));
    });
    top += chart.clientHeight;
  }
  return [new XMLSerializer().serializeToString(whole), width, height];
}

export async function asPicture(box, name, kind) {
  const [text, width, height] = together(box);
  const blob = new Blob([text], { type: "image/svg+xml" });
  const stem = name.replace(/[^A-Za-z0-9.+-]+/g, "-") || "rig";
  if (kind === "svg") return offer(blob, `${stem}.svg`);
  const image = new Image();
  image.src = `data:image/svg+xml;base64,${btoa(String.fromCodePoint(...new TextEncoder().encode(text)))}`;
  await image.decode();
  const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height: 2 * height });
  canvas.getContext("2d").drawImage(image, 0, 0, 2 * width, 2 * height);
  canvas.toBlob((png) => offer(png, `${stem}.png`));
}
