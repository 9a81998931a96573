/** An element with attributes and children: h("p", {class: "note"}, "text", element). */
export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value != null) element.setAttribute(name, value);
  }
  element.append(...children.flat(Infinity).filter((child) => child != null));
  return element;
}

/** A chart of its own width: `draw(width)` is called whenever the width changes. */
export function figure(name, caption, draw) {
  const box = h("div", { class: "chart", "data-chart": name });
  let drawn = 0;
  new ResizeObserver(([entry]) => {
    const width = Math.round(entry.contentRect.width);
    if (width === drawn || width === 0) return;
    drawn = width;
    box.replaceChildren(draw(width));
  }).observe(box);
  return h("figure", {}, box, h("figcaption", {}, caption));
}

/** A table from cells; the first row is its head, the first column names the rows. */
export function table(head, rows) {
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          head.map((cell) => h("th", { scope: "col" }, cell)),
        ),
      ),
      h(
        "tbody",
        {},
        rows.map(([name, ...cells]) =>
          h(
            "tr",
            {},
            h("th", { scope: "row" }, name),
            cells.map((cell) => h("td", {}, cell)),
          ),
        ),
      ),
    ),
  );
}

export const section = (title, ...content) => h("section", {}, h("h2", {}, title), content);

/** Side by side where there is room. */
export const row = (...figures) => h("div", { class: "row" }, figures);
