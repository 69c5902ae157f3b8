// SPDX-License-Identifier: BSD-3-Clause
// Small helpers; the same words and figures as report.html.
export const $ = id => document.getElementById(id);

export function element(tag, attributes = {}, ...children) {
  const e = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes))
    if (name.startsWith("on")) e.addEventListener(name.slice(2), value);
    else if (value !== null) e.setAttribute(name, value);
  e.append(...children);
  return e;
}

export const number = (v, digits = 3) => v === null || v === undefined ? "–" : Math.abs(v) < 1e-9 ? "0" :
  Math.abs(v) >= 10 ** (digits + 1) ? Math.round(v).toLocaleString("en") : String(+v.toPrecision(digits));
export const plural = (n, word) => `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;
export const many = n => n < 1e6 ? n.toLocaleString("en") : `${number(n / 1e6, 3)} million`;

/// A panel in the middle of the page instead of the map.
export function message(title, ...lines) {
  $("message").replaceChildren(element("h3", {}, title), ...lines.map(l => element("p", {}, l)));
  $("message").hidden = false;
}
