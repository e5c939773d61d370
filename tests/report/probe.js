// What `browser.measured` reads from a page: sizes as first opened, and the texts of all its folds.
(() => {
  const root = document.documentElement, seen = element => element.checkVisibility() && element.getClientRects().length > 0;
  const opened = root.scrollHeight, heights = {};
  for (const part of document.querySelectorAll("main > *")) heights[part.id || part.tagName] = part.getBoundingClientRect().height;
  const first = document.querySelector(".sketch, figure svg, img, canvas"), tile = document.querySelector(".tile");
  const [picture, ended] = [first, tile].map(each => each && each.getBoundingClientRect());
  const folds = [...document.querySelectorAll("main details")].filter(each => !each.closest("nav") && !each.matches(".warning"));
  for (const fold of folds) fold.open = true;
  const texts = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    if (!node.textContent.trim() || /^(SCRIPT|STYLE|NOSCRIPT|TITLE)$/.test(parent.tagName) || parent.closest(".unseen")) continue;
    if (!seen(parent)) continue;
    // a drawing is scaled as a whole
    const svg = parent.ownerSVGElement;
    const scale = svg && svg.viewBox.baseVal ? svg.getBoundingClientRect().width / svg.viewBox.baseVal.width : 1;
    texts.push([scale * parseFloat(getComputedStyle(parent).fontSize), node.textContent.trim().slice(0, 30), parent]);
  }
  const cut = texts.filter(([, , parent]) => {
    if (!parent.ownerSVGElement) return parent.scrollWidth > parent.clientWidth + 1 && getComputedStyle(parent).overflowX === "hidden"
      && getComputedStyle(parent).textOverflow !== "ellipsis";
    const box = parent.getBoundingClientRect(), frame = parent.ownerSVGElement.getBoundingClientRect();
    return box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 || box.bottom > frame.bottom + 1;
  });
  const wide = [...document.querySelectorAll(".tile")].filter(tile => seen(tile) && tile.scrollWidth > tile.clientWidth + 1)
    .map(tile => tile.textContent.trim().replace(/\s+/g, " "));
  // corners of a text as it is turned; two texts lie apart where an edge of one has the other on its far side
  const corners = text => {
    const box = text.getBBox(), matrix = text.getScreenCTM(), scale = Math.hypot(matrix.a, matrix.b);
    const [left, right, low, high] = [box.x + 1 / scale, box.x + box.width - 1 / scale, box.y + 1 / scale, box.y + box.height - 1 / scale];
    return [[left, low], [right, low], [right, high], [left, high]].map(([x, y]) => new DOMPoint(x, y).matrixTransform(matrix));
  };
  const apart = (one, other) => [0, 1].some(edge => {
    const x = one[edge + 1].x - one[edge].x, y = one[edge + 1].y - one[edge].y;
    const along = points => points.map(point => point.x * x + point.y * y), [a, b] = [along(one), along(other)];
    return Math.max(...a) <= Math.min(...b) || Math.max(...b) <= Math.min(...a);
  });
  const overlap = [];
  for (const svg of document.querySelectorAll("figure svg, .sketch")) {
    const drawn = [...svg.querySelectorAll("text")].filter(text => seen(text) && text.textContent.trim())
      .map(text => [corners(text), text.textContent.trim()]);
    drawn.forEach(([a, first], place) => drawn.slice(place + 1).forEach(([b, second]) => {
      if (!apart(a, b) && !apart(b, a)) overlap.push(`${first} / ${second}`);
    }));
  }
  const listed = new Set([...document.querySelectorAll("nav a")].map(link => link.getAttribute("href").slice(1)));
  const slider = document.querySelector(".slider input");
  let step = null;
  if (slider && slider.max > 0) {
    const begin = performance.now(), steps = 50;
    for (let place = 0; place < steps; place++) {
      slider.value = Math.floor(place * slider.max / steps);
      slider.dispatchEvent(new Event("input"));
    }
    step = (performance.now() - begin) / steps;
  }
  return {
    height: opened, heights, unfolded: root.scrollHeight, content: root.scrollWidth, window: root.clientWidth,
    pictures: document.querySelectorAll("figure svg").length,
    least_font: Math.min(...texts.map(([size]) => size)), smallest: texts.filter(([size]) => size < 11).map(([size, text]) => `${size.toFixed(1)} ${text}`),
    texts: texts.length, cut: [...cut.map(([, text]) => text), ...wide], overlap,
    unlisted: folds.filter(fold => !listed.has(fold.id) && ![...fold.querySelectorAll("[id]")].some(each => listed.has(each.id)))
      .map(fold => fold.querySelector("summary").textContent),
    broken: [...listed].filter(key => !document.getElementById(key)),
    headless: [...document.querySelectorAll("table")].filter(table => !table.querySelector("th")).length,
    first_picture: picture && picture.top, first_tile: ended && ended.bottom,
    ready: parseFloat(root.dataset.ready), step, requests: performance.getEntriesByType("resource").map(each => each.name)
      .filter(name => !name.startsWith("data:")),
  };
})()
