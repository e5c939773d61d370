// The maps over time, and the series of the run on one axis: all of it from the JSON in the page.
(() => {
  "use strict";
  const source = document.getElementById("data");
  if (!source) return;
  const data = JSON.parse(source.textContent);
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const places = text => new Uint32Array(bytes(text).buffer);
  const floats = text => new Float32Array(bytes(text).buffer);
  const time = floats(data.time), distance = data.distance ? floats(data.distance) : null;
  const colours = bytes(data.colours);

  // number of the last of the ascending values that is not above a value
  const before = (values, value) => {
    let low = 0, high = values.length;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (values[middle] <= value + 1e-6) low = middle; else high = middle;
    }
    return low;
  };

  // what the second of two films presses more than the first, at their last common instant; without one each between two
  // frames along a straight line
  const difference = (film, paint, text) => {
    const pair = film.of.map((number, side) => ({...films[number], places: places(film.places[side])}));
    const at = (one, time) => {
      const first = before(one.time, time), last = Math.min(first + 1, one.time.length - 1), length = one.time[last] - one.time[first];
      const share = length > 0 ? Math.min(Math.max((time - one.time[first]) / length, 0), 1) : 0;
      return place => (place === 0 ? 0 : (1 - share) * one.frames[first * one.cells + place - 1] + share * one.frames[last * one.cells + place - 1]);
    };
    const instants = floats(film.instants);
    const frame = new Uint8Array(film.rows * film.cols), kilo = value => Number((value * film.unit).toPrecision(3)).toString();
    const show = cursor => {
      const time = instants.length ? instants[before(instants, cursor)] : cursor;
      const [first, second] = pair.map(one => at(one, time));
      let least = 0, most = 0;
      for (let cell = 0; cell < frame.length; cell++) {
        const [a, b] = [first(pair[0].places[cell]), second(pair[1].places[cell])];
        least = Math.min(least, b - a);
        most = Math.max(most, b - a);
        frame[cell] = a > 0 || b > 0 ? Math.min(Math.max(Math.round(128 + 127 * (b - a) / film.largest), 1), 255) : 0;
      }
      paint(frame, 0);
      text.textContent = `${time.toFixed(3)} s · ${kilo(least)} to ${kilo(most)} kPa`;
    };
    return {show};
  };

  // a canvas in place of each picture, with the same cells
  const films = [];
  data.films.forEach((film, number) => {
    const picture = document.querySelector(`[data-film="${number}"]`), canvas = document.createElement("canvas");
    const paint = bench.painter(canvas, film.rows, film.cols, film.of ? bytes(data.differences) : colours);
    picture.replaceWith(canvas);
    const text = canvas.closest("figure").querySelector("output");
    if (film.of) {
      films.push(difference(film, paint, text));
      return;
    }
    const all = {time: floats(film.time), load: floats(film.load), peak: floats(film.peak), frames: bytes(film.frames)};
    let shown = -1;
    const show = at => {
      const frame = before(all.time, at), cells = film.rows * film.cols;
      if (frame === shown) return;
      shown = frame;
      paint(all.frames, frame * cells);
      text.textContent = `${all.time[frame].toFixed(3)} s · ${all.load[frame].toFixed(0)} N · peak ${all.peak[frame].toFixed(0)} kPa`;
    };
    films.push({...all, show, cells: film.rows * film.cols});
  });
  const slider = document.querySelector(".slider input");
  const steps = films.reduce((most, {time}) => (time && time.length > most.length ? time : most), new Float32Array(0));

  // one time for maps, slider and curves
  let plots = [], axis = time, moving = false, peak = null;
  const show = (at, from) => {
    if (moving) return;
    moving = true;
    for (const film of films) film.show(at);
    if (slider && from !== slider) slider.value = before(steps, at);
    if (from === slider) {
      const place = axis[before(time, at)];
      for (const plot of plots) plot.setCursor({left: plot.valToPos(place, "x"), top: 10}, false);
    }
    moving = false;
  };
  if (slider && steps.length) {
    const first = films[0], highest = first.peak.indexOf(first.peak.reduce((most, peak) => Math.max(most, peak)));
    slider.max = steps.length - 1;
    slider.disabled = false;
    slider.addEventListener("input", () => show(steps[slider.value], slider));
    peak = first.time[highest];
    show(peak);
  }

  const view = document.getElementById("view");
  // a narrow page begins with every picture folded
  if (matchMedia("(max-width: 640px)").matches) for (const fold of document.querySelectorAll(".pictures > details")) fold.open = false;
  const height = view.clientWidth < 640 ? 120 : 150;
  const draw = group => bench.plot(
    view, height, group.label, group.series.map(each => each.name), [axis, ...group.series.map(each => each.values)],
    {hooks: {setCursor: [plot => { if (plot.cursor.idx != null) show(time[plot.cursor.idx], plot); }]}},
  );
  // a run that ended before another has a gap behind it
  for (const group of data.groups) for (const each of group.series) each.values = Array.from(floats(each.values), value => (isNaN(value) ? null : value));
  if (distance) {
    const choice = document.createElement("div");
    choice.className = "switch";
    for (const [label, values] of [["over time, s", time], ["over distance, m", distance]]) {
      const button = document.createElement("input"), text = document.createElement("label");
      button.type = "radio";
      button.name = "axis";
      button.checked = values === time;
      button.addEventListener("change", () => {
        axis = values;
        plots.forEach((plot, number) => plot.setData([axis, ...data.groups[number].series.map(each => each.values)]));
      });
      text.append(button, ` ${label}`);
      choice.append(text);
    }
    view.append(choice);
  }
  plots = data.groups.map(draw);
  // the curves begin at the instant of the maps
  if (peak !== null) requestAnimationFrame(() => show(peak, slider));
  bench.keep(view, height, () => plots);
  document.documentElement.dataset.ready = performance.now().toFixed(0);
})();
