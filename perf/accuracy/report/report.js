// Charts, pictures and the table of the report. Needs d3 and Plot, and the data elements of the page.
"use strict";
(() => {
  const $ = (id) => document.getElementById(id);
  const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const element = (tag, properties = {}, ...children) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  };

  // ---- Data

  // d3.csvParse() compiles a function, which the page's security policy forbids.
  const [columns, ...cells] = d3.csvParseRows($("data-rows").textContent.trim());
  const kTexts = new Set(["scene", "setting", "group"]);
  const rows = cells.map((row) => Object.fromEntries(
    columns.map((name, i) => [name, kTexts.has(name) ? row[i] : row[i] === "inf" ? Infinity : +row[i]])));
  const scenes = JSON.parse($("data-scenes").textContent);
  const pictures = JSON.parse($("data-pictures").textContent);
  const sceneNamed = new Map(scenes.map((scene) => [scene.name, scene]));
  for (const scene of scenes) {
    scene.settingNamed = new Map(scene.settings.map((setting) => [setting.name, setting]));
    scene.rows = rows.filter((row) => row.scene === scene.name);
  }
  const threadCounts = [...new Set(rows.map((row) => row.threads))];
  const kGroups = {
    default: "default", dial: "quality dial", samples: "samples per pixel", jitter: "jittered passes", depth: "depth format",
    color: "colour bits, dither", resolution: "lower resolution", combined: "combinations"};
  const kReferences = {point: "one sample per pixel", area: "16×16 samples per pixel"};
  const kMeasures = {
    rms_unrounded: {name: "RMS", axis: "RMS error against unrounded colours, levels", digits: 3},
    max: {name: "largest", axis: "Largest error, levels", digits: 0},
    flip: {name: "FLIP", axis: "FLIP, mean: 0 is invisible, 1 the largest difference", digits: 4}};
  const state = {scene: scenes[0].name, setting: "default", reference: "area", measure: "rms_unrounded", threads: threadCounts[0]};
  const errorColumn = () => `${state.reference}_${state.measure}`;
  const rowOf = (scene, setting, threads) =>
    sceneNamed.get(scene).rows.find((row) => row.setting === setting && row.threads === threads);

  // ---- Pareto front: the rule of the program, for any measure of error

  function frontOf(points, error) {
    return points.filter((p) => !points.some((q) => q[error] <= p[error] && q.time_high < p.time_low));
  }
  // The corners of the area that the front rules out: least error up to each time.
  function stairs(points, error) {
    let least = Infinity;
    return d3.sort(points, (d) => d.time).filter((d) => d[error] < least && ((least = d[error]), true));
  }

  // ---- Chart

  const figures = new Map();  // thread count -> figure
  for (const threads of threadCounts) {
    const figure = element("figure", {tabIndex: 0});
    figure.addEventListener("keydown", onKey);
    figures.set(threads, figure);
    $("figures").append(figure);
  }

  function drawChart(threads) {
    const figure = figures.get(threads);
    figure.hidden = threads !== state.threads;
    const shown = [...figures.values()].find((other) => !other.hidden) ?? figure;
    const width = Math.max(360, Math.floor((shown.clientWidth || $("figures").clientWidth || 1000) - 14));
    const height = 600;
    const error = errorColumn();
    const measure = kMeasures[state.measure];
    const scene = sceneNamed.get(state.scene);
    const points = scene.rows.filter((row) => row.threads === threads);
    const positive = d3.min(points, (d) => (d[error] > 0 ? d[error] : undefined)) ?? 1;
    const floor = positive / 2;  // where errors of 0 are drawn
    const y = (d) => Math.max(d[error], floor);
    const front = new Set(frontOf(points, error));
    const color = (d) => ink(d.group);
    const text = (d) => `${d.setting}\n${measure.name} ${d[error].toFixed(measure.digits)}\n` +
      `time ${d.time.toFixed(3)} (${d.time_low.toFixed(3)} to ${d.time_high.toFixed(3)}), ${d.ms.toFixed(2)} ms` +
      (d.told_apart ? "" : "\nnot told apart from the default in time");
    const noise = points.find((d) => d.setting === "default");
    const plot = Plot.plot({
      width, height, marginLeft: 62, marginRight: 24, marginTop: 30, marginBottom: 46, ariaLabel: `Error against time, ${threads} threads`,
      style: {background: "transparent", color: ink("ink"), fontSize: "12px"},
      x: {type: "log", label: `Time of a frame / time of the default, ${threads === 1 ? "1 thread" : threads + " threads"} →`,
          labelAnchor: "center", tickFormat: (d) => d3.format("~g")(d), ticks: Math.max(4, width / 130), grid: true, nice: false,
          domain: padded(d3.extent(points.flatMap((d) => [d.time_low, d.time_high])), 1.12)},
      y: {type: "log", label: `↑ ${measure.axis}`, tickFormat: (d) => d3.format("~g")(d), ticks: 6, grid: true,
          domain: padded([d3.min(points, y), d3.max(points, y)], 1.18)},
      marks: [
        Plot.rectX([noise], {x1: "time_low", x2: "time_high", fill: ink("default"), fillOpacity: 0.07}),
        Plot.line(stairs(points, error), {x: "time", y, curve: "step-after", stroke: ink("accent"), strokeOpacity: 0.55, strokeWidth: 1.5}),
        Plot.ruleY(points, {x1: "time_low", x2: "time_high", y, stroke: color, strokeOpacity: 0.5}),
        Plot.dot(points, {x: "time", y, r: 4.5, stroke: color, strokeWidth: 1.6, fill: (d) => (front.has(d) ? color(d) : ink("card")), className: "settings"}),
        Plot.tip(points, Plot.pointer({x: "time", y, title: text, fill: ink("card")})),
      ],
    });
    plot.addEventListener("input", () => { plot.style.cursor = plot.value ? "pointer" : ""; });
    plot.addEventListener("click", () => { if (plot.value) choose(plot.value.scene, plot.value.setting); });
    nameThePoints(plot, points, y, front, {width, height});
    figure.replaceChildren(plot);
  }

  function padded([low, high], factor) { return low < high ? [low / factor, high * factor] : [low / 2, high * 2]; }

  // Writes the name of every point near it, without overlaps: the nearest free place on growing rings.
  function nameThePoints(plot, points, y, front, size) {
    const svg = d3.select(plot.tagName === "svg" ? plot : plot.querySelector("svg"));
    const px = (d) => plot.scale("x").apply(d.time);
    const py = (d) => plot.scale("y").apply(y(d));
    const taken = points.map((d) => ({x0: px(d) - 5, x1: px(d) + 5, y0: py(d) - 5, y1: py(d) + 5}));
    const leaders = svg.insert("g", ".settings").attr("class", "leaders");
    const names = svg.insert("g", "[aria-label=tip]").attr("class", "names");
    const scene = sceneNamed.get(state.scene);
    const rank = (d) => (d.setting === state.setting ? 0 : d.setting === "default" ? 1 : front.has(d) ? 2 : d.group === "combined" ? 4 : 3);
    for (const d of d3.sort(points, rank)) {
      const label = scene.settingNamed.get(d.setting).label;
      const chosen = d.setting === state.setting;
      const box = {w: label.length * (chosen ? 6.9 : 5.7) + 4, h: chosen ? 14 : 12};
      const place = freePlace(px(d), py(d), box, taken, size);
      taken.push(place);
      const x = (place.x0 + place.x1) / 2, cy = (place.y0 + place.y1) / 2;
      if (place.ring > 0)
        leaders.append("line").attr("class", "leader").attr("x1", px(d)).attr("y1", py(d))
          .attr("x2", Math.max(place.x0, Math.min(place.x1, px(d)))).attr("y2", Math.max(place.y0 + 2, Math.min(place.y1 - 2, py(d))));
      names.append("text").attr("class", `name${front.has(d) ? "" : " off"}${chosen ? " chosen" : ""}`)
        .attr("x", x).attr("y", cy).attr("dy", "0.35em").attr("text-anchor", "middle").text(label)
        .on("click", (event) => { event.stopPropagation(); choose(d.scene, d.setting); });
      if (chosen) svg.append("circle").attr("class", "chosen-ring").attr("cx", px(d)).attr("cy", py(d)).attr("r", 9);
    }
  }

  function freePlace(x, y, {w, h}, taken, {width, height}) {
    const boxAt = (cx, cy, ring) => ({x0: cx - w / 2, x1: cx + w / 2, y0: cy - h / 2, y1: cy + h / 2, ring});
    const inside = (b) => b.x0 > 50 && b.x1 < width - 4 && b.y0 > 24 && b.y1 < height - 34;
    const overlap = (b) => d3.sum(taken, (t) =>
      Math.max(0, Math.min(b.x1, t.x1) - Math.max(b.x0, t.x0)) * Math.max(0, Math.min(b.y1, t.y1) - Math.max(b.y0, t.y0)));
    let best = null, least = Infinity;
    for (let ring = 0; ring < 22; ++ring) {
      const steps = ring === 0 ? 8 : 16;
      for (let i = 0; i < steps; ++i) {
        const angle = (2 * Math.PI * i) / steps;
        const cx = x + Math.cos(angle) * (w / 2 + 7 + 7 * ring), cy = y + Math.sin(angle) * (h / 2 + 6 + 9 * ring);
        const b = boxAt(cx, cy, ring);
        if (!inside(b)) continue;
        const covered = overlap(b);
        if (covered === 0) return b;
        if (covered < least) least = covered, best = b;
      }
    }
    return best ?? boxAt(x, y - h, 0);
  }

  // ---- Pictures: a "~" marks a difference from the default's picture, modulo 256

  const decoded = new Map();
  async function pixels(scene, name) {
    const key = `${scene}/${name}`;
    if (!decoded.has(key)) decoded.set(key, decode(scene, name));
    return decoded.get(key);
  }
  async function decode(scene, name) {
    const image = new Image();
    const text = pictures[scene][name], isDifference = text.startsWith("~");
    image.src = `data:image/png;base64,${isDifference ? text.slice(1) : text}`;
    await image.decode();
    const canvas = element("canvas", {width: image.naturalWidth, height: image.naturalHeight});
    const context = canvas.getContext("2d", {willReadFrequently: true});
    context.drawImage(image, 0, 0);
    const data = context.getImageData(0, 0, canvas.width, canvas.height);
    if (isDifference) {
      const base = (await pixels(scene, "default")).data;
      data.data.forEach((value, i) => { if (i % 4 !== 3) data.data[i] = (value + base[i]) & 255; });
    }
    return data;
  }
  function show(canvas, data) {
    canvas.width = data.width;
    canvas.height = data.height;
    canvas.getContext("2d").putImageData(data, 0, 0);
  }
  function difference(a, b, gain) {
    const result = new ImageData(a.width, a.height);
    for (let i = 0; i < a.data.length; ++i) result.data[i] = i % 4 === 3 ? 255 : gain * Math.abs(a.data[i] - b.data[i]);
    return result;
  }

  async function drawViewer() {
    const {scene, setting, reference} = state;
    const about = sceneNamed.get(scene).settingNamed.get(setting);
    const row = rowOf(scene, setting, state.threads);
    $("setting-title").textContent = `${scene} / ${setting}`;
    $("setting-text").textContent = about.text;
    const [result, wanted] = await Promise.all([pixels(scene, setting), pixels(scene, `reference_${reference}`)]);
    if (scene !== state.scene || setting !== state.setting || reference !== state.reference) return;  // overtaken
    const largest = row[`${reference}_max`];
    const automatic = [64, 32, 16, 8, 4, 2, 1].find((gain) => gain * largest <= 255) ?? 1;
    const gain = $("gain").value === "auto" ? automatic : +$("gain").value;
    $("gain").options[0].textContent = `${automatic} (largest that fits)`;
    show($("picture-result"), result);
    show($("picture-reference"), wanted);
    show($("picture-difference"), difference(result, wanted, gain));
    $("caption-result").textContent = setting;
    $("caption-reference").textContent = `reference, ${kReferences[reference]}`;
    $("caption-difference").textContent = "difference";
    const number = (title, value, note = "") => element("div", {}, element("dt", {textContent: title}),
      element("dd", {textContent: value + " "}, element("small", {textContent: note})));
    const column = (name) => row[`${reference}_${name}`];
    $("figures-of-setting").replaceChildren(
      number("RMS, unrounded", column("rms_unrounded").toFixed(4), "levels"), number("largest error", column("max"), "levels"),
      number("PSNR", Number.isFinite(column("psnr")) ? column("psnr").toFixed(2) : "∞", "dB"),
      number("off by more than 1", (100 * column("share_over_1")).toFixed(2), "% of pixels"),
      number("off by more than 2", (100 * column("share_over_2")).toFixed(2), "% of pixels"),
      number("FLIP", column("flip").toFixed(4), `99 %: ${column("flip_p99").toFixed(3)}`),
      ...threadCounts.map((threads) => {
        const d = rowOf(scene, setting, threads);
        return number(`time, ${threads === 1 ? "1 thread" : threads + " threads"}`, d.time.toFixed(3),
          `${d.time_low.toFixed(3)} to ${d.time_high.toFixed(3)}; ${d.ms.toFixed(2)} ms${d.told_apart ? "" : "; not told apart"}`);
      }));
  }

  // ---- Wall strip

  const walls = scenes.filter((scene) => /^wall-\d+$/.test(scene.name));
  async function drawStrip() {
    $("wall").style.display = walls.length < 2 ? "none" : "";
    const setting = $("wall-setting").value;
    const entries = walls.map((wall) => {
      const row = rowOf(wall.name, setting, state.threads);
      const [picture, difference_] = [element("canvas"), element("canvas")];
      const quads = wall.name.slice(5);
      const link = element("a", {href: `#${wall.name}/${setting}`}, picture, difference_, element("b", {textContent: `${quads}×${quads}`}),
        element("span", {textContent: `RMS ${row.point_rms_unrounded.toFixed(2)}, largest ${row.point_max}`}),
        element("span", {textContent: `time ${row.time.toFixed(2)}`}));
      return {wall, picture, difference: difference_, link};
    });
    $("strip").replaceChildren(...entries.map((entry) => entry.link));
    for (const {wall, picture, difference: canvas} of entries) {
      const [result, wanted] = await Promise.all([pixels(wall.name, setting), pixels(wall.name, "reference_point")]);
      show(picture, result);
      show(canvas, difference(result, wanted, 8));
    }
  }

  // ---- Table

  const body = document.querySelector("#table tbody");
  const tableRows = [...body.rows];
  function filterTable() {
    const only = $("only-scene").checked;
    for (const row of tableRows) {
      row.hidden = only && row.dataset.scene !== state.scene;
      row.classList.toggle("chosen", row.dataset.scene === state.scene && row.dataset.setting === state.setting);
    }
  }
  function sortTable(heading) {
    const index = +heading.dataset.column;
    const ascending = heading.getAttribute("aria-sort") !== "ascending";
    for (const other of document.querySelectorAll("#table th")) other.removeAttribute("aria-sort");
    heading.setAttribute("aria-sort", ascending ? "ascending" : "descending");
    const value = (row) => { const text = row.cells[index].dataset.value ?? row.cells[index].textContent; return isNaN(text) && text !== "inf" ? text : text === "inf" ? Infinity : +text; };
    tableRows.sort((a, b) => (ascending ? d3.ascending : d3.descending)(value(a), value(b)));
    body.append(...tableRows);
  }

  // ---- State

  function choose(scene, setting) {
    const hash = `#${scene}/${setting}`;
    if (location.hash === hash) draw();
    else location.hash = hash;
  }
  function readHash() {
    const [scene, setting] = decodeURIComponent(location.hash.slice(1)).split("/");
    if (!sceneNamed.has(scene)) return;
    state.scene = scene;
    state.setting = sceneNamed.get(scene).settingNamed.has(setting) ? setting : "default";
  }
  function onKey(event) {
    const settings = d3.sort(sceneNamed.get(state.scene).rows.filter((row) => row.threads === state.threads), (d) => d.time).map((d) => d.setting);
    const step = {ArrowLeft: -1, ArrowRight: 1}[event.key], sceneStep = {ArrowUp: -1, ArrowDown: 1}[event.key];
    if (step) choose(state.scene, settings[(settings.indexOf(state.setting) + step + settings.length) % settings.length]);
    else if (sceneStep) {
      const next = scenes[(scenes.findIndex((scene) => scene.name === state.scene) + sceneStep + scenes.length) % scenes.length];
      choose(next.name, next.settingNamed.has(state.setting) ? state.setting : "default");
    } else return;
    event.preventDefault();
  }
  function radios(id, options, key, convert = (value) => value) {
    for (const [value, title] of options) {
      const input = element("input", {type: "radio", name: id, value, checked: String(state[key]) === String(value)});
      input.addEventListener("change", () => { state[key] = convert(value); draw(); drawStrip(); });
      $(id).append(element("label", {}, input, ` ${title}`));
    }
  }

  function draw() {
    const scene = sceneNamed.get(state.scene);
    $("scene-title").textContent = `${scene.name}: ${scene.title}`;
    for (const link of $("scenes").children)
      if (link.dataset.scene === state.scene) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    const groups = new Set(scene.rows.map((row) => row.group));
    $("legend").replaceChildren(...Object.entries(kGroups).filter(([group]) => groups.has(group)).map(([group, title]) => {
      const swatch = element("i");
      swatch.style.background = `var(--${group})`;
      return element("span", {}, swatch, title);
    }));
    const reason = scene.default_off_front.find((off) => off.threads === state.threads && off.reference === state.reference);
    $("reason").textContent = reason && state.measure === "rms_unrounded" ? `The default is off the front: ${reason.reason}` : "";
    for (const threads of threadCounts) drawChart(threads);
    filterTable();
    drawViewer();
  }

  document.documentElement.classList.add("scripted");
  $("scenes").append(...scenes.map((scene) => {
    const link = element("a", {href: `#${scene.name}/default`, textContent: scene.name});
    link.dataset.scene = scene.name;
    return link;
  }));
  radios("reference", Object.entries(kReferences), "reference");
  radios("measure", Object.entries(kMeasures).map(([value, {name}]) => [value, name]), "measure");
  radios("threads", threadCounts.map((threads) => [threads, threads]), "threads", Number);
  $("gain").append(element("option", {value: "auto", textContent: "auto"}), ...[1, 2, 4, 8, 16, 32, 64].map((gain) => element("option", {value: gain, textContent: gain})));
  $("gain").addEventListener("change", drawViewer);
  if (walls.length > 0) {
    const shared = walls[0].settings.filter(({name}) => walls.every((wall) => wall.settingNamed.has(name)));
    $("wall-setting").append(...shared.map(({name}) => element("option", {value: name, textContent: name, selected: name === "gouraud"})));
    $("wall-setting").addEventListener("change", drawStrip);
  }
  $("only-scene").addEventListener("change", filterTable);
  for (const heading of document.querySelectorAll("#table th[data-column]")) heading.addEventListener("click", () => sortTable(heading));
  body.addEventListener("click", (event) => {
    const row = event.target.closest("tr");
    if (row) choose(row.dataset.scene, row.dataset.setting);
  });
  addEventListener("hashchange", () => { readHash(); draw(); });
  let resizing = 0;
  addEventListener("resize", () => { clearTimeout(resizing); resizing = setTimeout(draw, 150); });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  readHash();
  draw();
  drawStrip();
})();
