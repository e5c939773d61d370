// What the pages share: the colours of the style, a pressure map on a canvas, a plot of series.
const bench = (() => {
  "use strict";
  const names = ["--accent", "--second", "--third", "--fourth", "--fifth", "--ink"];
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

  // paints the frame of bytes that begins at `start`; 0 is no pressure, 255 the largest
  const painter = (canvas, rows, cols, colours) => {
    canvas.width = cols;
    canvas.height = rows;
    const context = canvas.getContext("2d"), image = context.createImageData(cols, rows), cells = rows * cols;
    return (frames, start) => {
      // forward is up and left on the left: the last cell comes first
      for (let cell = 0; cell < cells; cell++) {
        const value = 4 * frames[start + cells - 1 - cell];
        image.data.set(colours.subarray(value, value + 4), 4 * cell);
      }
      context.putImageData(image, 0, 0);
    };
  };

  const plot = (place, height, label, series, data, more) => {
    const drawn = {stroke: () => colour("--muted"), grid: {stroke: () => colour("--rule"), width: 1}, font: "12px system-ui"};
    return new uPlot({
      width: place.clientWidth, height, scales: {x: {time: false}}, legend: {live: true},
      cursor: {sync: {key: "bench"}, drag: {x: true, y: false}},
      axes: [drawn, {...drawn, size: 56, label, labelFont: "12px system-ui", labelSize: 18}],
      series: [{label: "at", value: (_, value) => (value == null ? "" : value.toPrecision(5))}, ...series.map((name, number) => ({
        label: name, width: 1, stroke: () => colour(names[number % names.length]), points: {show: false},
        value: (_, value) => (value == null ? "–" : value.toPrecision(4)),
      }))],
      ...more,
    }, data, place);
  };

  // plots keep the width of their place, and take the colours of a scheme that is chosen later
  const keep = (place, height, plots) => {
    new ResizeObserver(() => plots().forEach(each => each.setSize({width: place.clientWidth, height}))).observe(place);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => plots().forEach(each => each.redraw()));
  };
  return {keep, painter, plot};
})();
