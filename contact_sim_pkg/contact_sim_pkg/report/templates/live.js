// The newest frame of the bench: one is asked for once the last has come, and drawn when the screen is.
(() => {
  "use strict";
  const colours = Uint8Array.from(atob(JSON.parse(document.getElementById("colours").textContent)), letter => letter.charCodeAt(0));
  const part = name => document.getElementById(name);
  const view = part("view"), height = 150, plots = new Map(), maps = new Map();
  const counts = {received: 0, drawn: 0};
  window.counts = counts;
  let about = {can: [], paused: false}, dirty = false, sliding = false;

  const socket = new WebSocket(`ws://${location.host}/frames`);
  socket.binaryType = "arraybuffer";
  const ask = (what, more) => { if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({do: what, ...more})); };

  const reset = () => {
    for (const each of plots.values()) each.plot.destroy();
    plots.clear();
  };
  // what is older than the span goes
  const append = (old, fresh, from) => {
    const kept = old.subarray(from), joined = new Float32Array(kept.length + fresh.length);
    joined.set(kept);
    joined.set(fresh, kept.length);
    return joined;
  };
  const takePlot = (each, floats) => {
    const key = [each.topic, ...each.names].join("|");
    if (!plots.has(key)) {
      const data = [new Float32Array(0), ...each.names.map(() => new Float32Array(0))];
      plots.set(key, {data, changed: true, plot: bench.plot(view, height, each.label, each.names, data, {})});
    }
    const found = plots.get(key), newest = floats[each.points - 1], time = found.data[0];
    let from = 0;
    while (from < time.length && time[from] < newest - about.span) from++;
    found.data = found.data.map((old, row) => append(old, floats.subarray(row * each.points, (row + 1) * each.points), from));
    found.changed = true;
  };
  const takeMap = (each, bytes) => {
    let found = maps.get(each.name);
    if (!found || found.rows !== each.rows || found.cols !== each.cols) {
      found?.figure.remove();
      const figure = document.createElement("figure"), canvas = document.createElement("canvas");
      figure.className = "film";
      figure.innerHTML = '<figcaption><b></b> <output></output></figcaption><div class="shown" role="img"></div><p class="scale"><span>0</span><i></i><span></span></p>';
      figure.querySelector("b").textContent = each.name;
      figure.querySelector(".shown").setAttribute("aria-label", `Pressure map of the ${each.name} contact`);
      figure.querySelector(".shown").append(canvas);
      part("maps").append(figure);
      found = {figure, rows: each.rows, cols: each.cols, paint: bench.painter(canvas, each.rows, each.cols, colours)};
      maps.set(each.name, found);
    }
    found.next = {each, bytes};
  };

  const words = ["idle", "starting", "ready", "running", "finished", "stopped", "failed", "paused"];
  const say = () => {
    const state = about.paused ? "paused" : words[about.state];
    part("state").textContent = [
      about.scene, about.time == null ? "" : `${about.time.toFixed(2)} s`, about.rtf ? `real-time factor ${about.rtf.toFixed(2)}` : "",
      about.load ? `load ${about.load.toFixed(0)} N` : "", state,
    ].filter(Boolean).join(" · ");
    part("pause").hidden = !about.can.includes("pause");
    part("pause").textContent = about.paused ? "Go on" : "Pause";
    part("step").hidden = !about.can.includes("step");
    part("seek").hidden = !about.can.includes("seek");
    if (about.end && !sliding) {
      const slider = part("seek").querySelector("input");
      slider.max = about.end;
      slider.value = about.at ?? 0;
    }
  };
  const draw = () => {
    dirty = false;
    counts.drawn++;
    say();
    for (const each of plots.values()) if (each.changed) {
      each.changed = false;
      each.plot.setData(each.data);
    }
    for (const found of maps.values()) if (found.next) {
      const {each, bytes} = found.next;
      found.next = null;
      found.paint(bytes, 0);
      found.figure.querySelector("output").textContent = `${each.time.toFixed(3)} s · ${each.load.toFixed(0)} N · peak ${(1e-3 * each.peak).toFixed(0)} kPa`;
      found.figure.querySelector(".scale span:last-child").textContent = `${(1e-3 * each.largest).toFixed(0)} kPa`;
    }
  };

  socket.onopen = () => ask("next");
  socket.onclose = () => { part("state").textContent += " · the bench view has ended"; };
  socket.onmessage = ({data}) => {
    const length = new DataView(data).getUint32(0, true);
    about = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
    counts.received++;
    if (about.anew) reset();
    let at = 4 + length;
    for (const each of about.plots) {
      const count = (1 + each.names.length) * each.points;
      takePlot(each, new Float32Array(data, at, count));
      at += 4 * count;
    }
    for (const each of about.maps) {
      takeMap(each, new Uint8Array(data, at, each.rows * each.cols));
      at += each.rows * each.cols;
    }
    if (!dirty) requestAnimationFrame(draw);
    dirty = true;
    ask("next");
  };

  part("pause").addEventListener("click", () => ask(about.paused ? "go" : "pause"));
  part("step").addEventListener("click", () => ask("step"));
  const slider = part("seek").querySelector("input");
  slider.addEventListener("input", () => { sliding = true; });
  slider.addEventListener("change", () => {
    sliding = false;
    ask("seek", {at: Number(slider.value)});
  });
  bench.keep(view, height, () => [...plots.values()].map(each => each.plot));
  document.documentElement.dataset.ready = performance.now().toFixed(0);
})();
