"use strict";
const seconds = s => s == null ? "–" : s >= 100 ? s.toFixed(0) + " s" : s >= 1 ? +s.toPrecision(3) + " s"
  : s >= 1e-3 ? +(1e3 * s).toPrecision(3) + " ms" : +(1e6 * s).toPrecision(3) + " µs";
const figure = v => v == null ? "–" : v === 0 ? "0" : Math.abs(v) >= 1e4 || Math.abs(v) < 1e-3
  ? v.toExponential(2).replace("e+", "e") : String(+v.toPrecision(3));
const countText = n => n >= 1 << 20 ? +(n / (1 << 20)).toFixed(1) + " Mi" : n >= 1 << 14 ? +(n / 1024).toFixed(1) + " Ki" : String(n);
(() => {
  const byId = id => document.getElementById(id);
  const data = JSON.parse(byId("data").textContent), images = JSON.parse(byId("images").textContent);
  const methods = data.methods;
  const series = methods.map((m, i) => ({ name: m.method, color: `var(--c${i % 8})` }));
  const last = m => m.checkpoints[m.checkpoints.length - 1];
  const plural = (n, word) => `${n} ${word}${n === 1 ? "" : "s"}`;
  const devices = [...new Set(methods.map(m => m.setup && m.setup.device).filter(Boolean))];
  const element = (name, text, className) => {
    const node = document.createElement(name);
    if (text !== undefined) node.textContent = text;
    if (className) node.className = className;
    return node;
  };

  byId("facts").textContent = [`${data.width}×${data.height}`, `depth ${data.max_depth}`, plural(methods.length, "method"), plural(data.runs, "run") + " each", ...devices].join(" · ");
  const pictured = methods.filter(m => m.picture && m.picture.relmse > 0).sort((a, b) => a.picture.relmse - b.picture.relmse);
  if (pictured.length > 1) {
    const [best, second] = pictured, bold = element("b", best.method);
    byId("lead").append(`After ${seconds(data.equal_seconds)} of rendering, `, bold,
      ` is closest to the reference: relMSE ${figure(best.picture.relmse)}, ${figure(second.picture.relmse / best.picture.relmse)} times less than `,
      element("b", second.method), pictured.length > 2 ? `, and ${figure(pictured[pictured.length - 1].picture.relmse / best.picture.relmse)} times less than ${pictured[pictured.length - 1].method}.` : ".");
  }

  const drawn = charts(byId("charts"), byId("tip"));
  const choose = (box, names, current, pick) => names.forEach(name => {
    const button = element("button", name);
    button.type = "button";
    button.setAttribute("aria-pressed", name === current);
    button.onclick = () => { box.querySelectorAll("button").forEach(b => b.setAttribute("aria-pressed", b === button)); pick(name); };
    box.append(button);
  });
  for (const [box, key] of [["choose-y", "what"], ["choose-x", "over"]]) {
    const names = drawn.names(key);
    choose(byId(box), names, names[0], name => drawn.show(key, name));
  }
  series.forEach((s, i) => {
    const button = element("button", undefined), dot = element("span", undefined, "dot");
    dot.style.background = s.color;
    button.type = "button";
    button.append(dot, s.name);
    button.setAttribute("aria-pressed", "true");
    button.onclick = () => {
      const visible = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", String(visible));
      drawn.setSeries(i, visible);
    };
    byId("legend").append(button);
  });

  function pictures() {
    const names = methods.map(m => m.method).filter(n => images[n] && images[n].picture);
    if (!names.length || !images.reference.picture) { byId("pictures").hidden = true; return; }
    const compare = byId("compare"), left = byId("left"), right = byId("right");
    const watch = viewer(byId("pictures"), compare, byId("divider"));
    const byName = Object.fromEntries(methods.map((m, i) => [m.method, { ...m, color: series[i].color }]));
    let layer = "picture";
    const source = name => name === "reference" ? images.reference.picture : images[name][layer] || images[name].picture;
    const about = name => name === "reference" ? (data.reference.spp ? `${data.reference.spp} spp` : "") : `${byName[name].picture.spp} spp, ${seconds(byName[name].picture.device_seconds)}, relMSE ${figure(byName[name].picture.relmse)}`;
    const panes = [];
    for (const name of [...names, "reference"]) {
      for (const select of [left, right]) select.append(new Option(name, name));
      const pane = element("figure", undefined, "pane"), frame = element("div", undefined, "frame"), image = element("img");
      const caption = element("figcaption"), dot = element("span", undefined, "dot");
      dot.style.background = name === "reference" ? "var(--ink)" : byName[name].color;
      frame.style.aspectRatio = `${data.width} / ${data.height}`;
      image.alt = `${name}, ${about(name)}`;
      caption.append(dot, element("span", name.replaceAll(":", ":\u200b"), "name"), element("span", about(name), "what"));
      frame.append(image); pane.append(frame, caption);
      frame.onpick = () => { right.value = name; show(); };
      frame.title = "Click: compare it on the right";
      watch(frame);
      panes.push({ name, image });
      byId("panes").append(pane);
    }
    let thinned = "";
    const show = () => {
      byId("above").src = source(left.value); byId("under").src = source(right.value);
      byId("above").alt = left.value; byId("under").alt = right.value;
      byId("tag-left").textContent = left.value; byId("tag-right").textContent = right.value;
      for (const pane of panes) pane.image.src = source(pane.name);
      byId("pictures-note").textContent = layer === "picture"
        ? `Each after ${seconds(data.equal_seconds)} of rendering, to the nearest whole sample. Drag the divider; + and − zoom all pictures together, so does a pinch, a double click, or the wheel once a picture was clicked. Tone mapped.${thinned}`
        : "Relative error of each pixel in steps of a sixth of a decade, from 0.001 (black) to 10 (pale yellow), on one scale. The reference has none and is shown as it is.";
    };
    left.value = pictured.length ? pictured[pictured.length - 1].method : names[0];
    right.value = pictured.length > 1 ? pictured[0].method : "reference";
    left.onchange = right.onchange = show;
    choose(byId("choose-layer"), ["Picture", "Error"], "Picture", name => { layer = name.toLowerCase(); show(); });
    compare.style.aspectRatio = `${data.width} / ${data.height}`;
    compare.style.maxWidth = `calc(min(78vh, 800px) * ${data.width / data.height})`;
    const whole = new Image();
    whole.onload = () => {
      const step = Math.round(data.width / whole.naturalWidth);
      if (step > 1) { thinned = ` One pixel of ${step}×${step} is shown, as it is: an average would have less noise than the picture.`; show(); }
    };
    whole.src = images.reference.picture;
    show();
  }
  pictures();

  function fill(table, columns, rows) {
    const head = element("tr");
    columns.forEach(c => head.append(element("th", c.name, c.words ? "words" : "")));
    const thead = element("thead"), body = element("tbody");
    thead.append(head);
    rows.forEach((row, i) => {
      const line = element("tr");
      columns.forEach((c, k) => {
        const cell = element("td", undefined, c.words ? "words" : "");
        cell.dataset.label = c.name;
        const content = c.cell(row, cell), inner = element("span");
        if (k === 0 && c.dot) { const dot = element("span", undefined, "dot"); dot.style.background = series[i].color; inner.append(dot, " "); }
        inner.append(...[].concat(content));
        cell.append(inner);
        line.append(cell);
      });
      body.append(line);
    });
    table.append(thead, body);
  }
  const range = i => i && i.value != null ? [i.value.toFixed(3), element("small", i.low != null ? `${i.low.toFixed(3)} … ${i.high.toFixed(3)}` : "")] : "–";
  const bestOf = pick => Math.max(...methods.map(pick).filter(v => v != null && isFinite(v)));
  const mostEfficient = bestOf(m => last(m).efficiency);
  const bestSpeed = 1 / bestOf(m => m.time_to_target.kind === "reached" ? 1 / m.time_to_target.device_seconds : null);
  fill(byId("table"), [
    { name: "Method", dot: true, cell: m => m.method },
    { name: "Samples", cell: m => [countText(last(m).spp), element("small", seconds(last(m).device_seconds))] },
    { name: "relMSE then", cell: m => [figure(last(m).relmse.value), element("small", `trimmed ${figure(last(m).relmse_trimmed.value)}`)] },
    { name: "Slope", cell: m => range(m.slope_mse) },
    { name: `Time to ${figure(data.target_relmse)}`, cell: (m, cell) => {
      const t = m.time_to_target;
      if (t.kind === "reached" && t.device_seconds === bestSpeed) cell.className = "best";
      return ({ earlier: "< ", later: "> " }[t.kind] || "") + seconds(t.device_seconds);
    } },
    { name: "Efficiency", cell: (m, cell) => {
      const e = last(m).efficiency;
      if (e === mostEfficient) cell.className = "best";
      return e > 0 ? `${figure(100 * e / mostEfficient)} %` : "–";
    } },
    { name: "Fit: p of b", cell: m => m.fit_relmse.adjusted_p != null ? figure(m.fit_relmse.adjusted_p) : "–" },
    { name: "Bias", words: true, cell: m => m.bias.significant ? [element("span", "significant: ", "warn"), m.bias.text] : m.bias.text },
    { name: "Not finite", cell: m => last(m).nonfinite ? [element("span", String(last(m).nonfinite), "warn")] : "0" },
  ], methods);
  byId("table-note").textContent = `Time to relMSE ${figure(data.target_relmse)}, which half of the methods reach unless another was asked for; < and >: before the first and after the last measurement. Efficiency: of the best, at each method's last count.`;

  byId("command").textContent = data.command;
  byId("command").hidden = !data.command;  // a program of others measured
  const reference = data.reference;
  const entry = (name, text) => byId("made").append(element("dt", name), element("dd", text));
  entry("Reference", reference.method + (reference.spp ? `, ${reference.spp} samples a pixel` : "") +
    (reference.variance_known ? `; its own noise is ${figure(reference.mse)} of the MSE and ${figure(reference.relmse)} of the relMSE of everything here, and is taken off where slopes, bias and times are told` : "; its own noise is not known, and counts as bias"));
  entry("Devices", devices.join(", "));
  entry("Program", data.program);
  if (data.load_seconds != null) entry("Loading", `${seconds(data.load_seconds)}, the same for all`);
  const bytes = b => b == null ? "–" : b > 1 << 30 ? (b / (1 << 30)).toFixed(2) + " GiB" : (b / (1 << 20)).toFixed(1) + " MiB";
  const setup = key => m => m.setup ? seconds(m.setup[key]) : "–";
  fill(byId("costs"), [
    { name: "Before the first sample", dot: true, cell: m => m.method },
    { name: "Packing", cell: setup("pack_seconds") },
    { name: "Building", cell: setup("build_seconds") },
    { name: "Compiling", cell: setup("compile_seconds") },
    { name: "Memory", cell: m => m.setup ? bytes(m.setup.bytes) : "–" },
    { name: "Seeds from", cell: m => String(m.first_seed) },
  ], methods);
  byId("footer").textContent = `Made by diptych converge, commit ${data.commit}. One file, no network: it can be sent as it is.`;
})();
