// A log-log chart of several methods, drawn as SVG and drawn anew when its box changes.
"use strict";
const superscript = n => String(n).replace("-", "⁻").replace(/[0-9]/g, d => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
const power = n => n === 0 ? "1" : n === 1 ? "10" : "10" + superscript(n);
const seconds = s => s == null ? "–" : s >= 100 ? s.toFixed(0) + " s" : s >= 1 ? +s.toPrecision(3) + " s"
  : s >= 1e-3 ? +(1e3 * s).toPrecision(3) + " ms" : +(1e6 * s).toPrecision(3) + " µs";
const figure = v => v == null ? "–" : v === 0 ? "0" : Math.abs(v) >= 1e4 || Math.abs(v) < 1e-3
  ? v.toExponential(2).replace("e+", "e") : String(+v.toPrecision(3));
const countText = n => n >= 1 << 20 ? +(n / (1 << 20)).toFixed(1) + " Mi" : n >= 8192 ? +(n / 1024).toFixed(1) + " Ki" : String(n);

function chart(box, series, options) {
  const { x, y, xLabel, yLabel, xTick, guide } = options;
  const svgName = "http://www.w3.org/2000/svg";
  const make = (name, attributes, parent, text) => {
    const node = document.createElementNS(svgName, name);
    for (const key in attributes) node.setAttribute(key, attributes[key]);
    if (text !== undefined) node.textContent = text;
    parent.append(node);
    return node;
  };
  const tip = document.createElement("div");
  tip.className = "tip"; tip.hidden = true;

  function draw() {
    const width = Math.max(280, box.clientWidth), wide = width > 700;
    const height = Math.round(Math.max(320, Math.min(560, width * 0.56)));
    const edge = { left: 52, right: wide ? 16 + 7.7 * Math.max(...series.map(s => s.name.length)) : 14, top: 14, bottom: 46 };
    const shown = series.filter(s => !s.hidden).map(s => ({ ...s,
      points: s.points.filter(p => x(p) > 0 && y(p).value > 0) })).filter(s => s.points.length);
    box.replaceChildren();
    const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${yLabel} over ${xLabel}` }, box);
    box.append(tip);
    tip.hidden = true;
    if (!shown.length) {
      make("text", { x: width / 2, y: height / 2, "text-anchor": "middle" }, svg, "Nothing to draw: no value here is above zero.");
      return;
    }
    const xs = shown.flatMap(s => s.points.map(x)), ys = shown.flatMap(s => s.points.map(p => y(p).value));
    const bottom = Math.min(...ys), pad = 1.25;
    const range = { x0: Math.min(...xs) / pad, x1: Math.max(...xs) * pad,
                    y0: bottom / pad, y1: Math.max(...ys, ...shown.flatMap(s => s.points.map(p => y(p).high || 0))) * pad };
    const px = v => edge.left + (Math.log(v / range.x0) / Math.log(range.x1 / range.x0)) * (width - edge.left - edge.right);
    const py = v => height - edge.bottom - (Math.log(Math.max(v, range.y0) / range.y0) / Math.log(range.y1 / range.y0)) * (height - edge.top - edge.bottom);
    const right = width - edge.right, floor = height - edge.bottom;

    const decades = (low, high) => { const list = []; for (let e = Math.ceil(Math.log10(low) - 1e-9); e <= Math.floor(Math.log10(high) + 1e-9); e++) list.push(e); return list; };
    const yDecades = decades(range.y0, range.y1);
    for (let e = Math.floor(Math.log10(range.y0)); e <= Math.log10(range.y1); e++)
      for (const m of [2, 5]) { const v = m * 10 ** e; if (v > range.y0 && v < range.y1) {
        make("line", { class: "minor", x1: edge.left, x2: right, y1: py(v), y2: py(v) }, svg);
        if (yDecades.length < 2) make("text", { x: edge.left - 8, y: py(v) + 4, "text-anchor": "end" }, svg, figure(v)); } }
    for (const e of yDecades) {
      make("line", { class: "grid", x1: edge.left, x2: right, y1: py(10 ** e), y2: py(10 ** e) }, svg);
      make("text", { x: edge.left - 8, y: py(10 ** e) + 4, "text-anchor": "end" }, svg, power(e));
    }
    const ticks = options.xPowersOfTwo ? powersOfTwo(range.x0, range.x1) : decimals(range.x0, range.x1);
    const every = Math.ceil(ticks.length / (wide ? 14 : 6));
    ticks.forEach((v, i) => {
      make("line", { class: "grid", x1: px(v), x2: px(v), y1: edge.top, y2: floor }, svg);
      if (i % every === 0) make("text", { x: px(v), y: floor + 18, "text-anchor": "middle" }, svg, xTick(v));
    });
    make("text", { class: "axis", x: (edge.left + right) / 2, y: height - 6, "text-anchor": "middle" }, svg, xLabel);
    make("text", { class: "axis", x: edge.left, y: edge.top - 2 }, svg, yLabel);

    if (guide) {  // error ∝ 1/N through the middle of the plot, as far as it stays inside
      const cx = Math.sqrt(range.x0 * range.x1), cy = Math.sqrt(range.y0 * range.y1);
      const reach = Math.min(range.x1 / cx, range.y1 / cy) ** 0.92;
      make("path", { class: "guide", d: `M${px(cx / reach)},${py(cy * reach)}L${px(cx * reach)},${py(cy / reach)}` }, svg);
      make("text", { x: px(cx * reach) - 4, y: py(cy / reach) - 8, "text-anchor": "end" }, svg, "∝ 1/N");
    }
    for (const s of shown) {
      const band = s.points.filter(p => y(p).high > 0);
      if (band.length > 1) make("path", { fill: s.color, opacity: .15, d: "M" + band.map(p => `${px(x(p))},${py(y(p).high)}`).join("L") +
        "L" + band.slice().reverse().map(p => `${px(x(p))},${py(Math.max(y(p).low || 0, range.y0))}`).join("L") + "Z" }, svg);
      make("path", { fill: "none", stroke: s.color, "stroke-width": 2.2, "stroke-linejoin": "round", "stroke-dasharray": s.dash || "none",
        d: "M" + s.points.map(p => `${px(x(p))},${py(y(p).value)}`).join("L") }, svg);
      for (const p of s.points) make("circle", { cx: px(x(p)), cy: py(y(p).value), r: 3.2, fill: s.color }, svg);
    }
    if (wide) endLabels(shown, svg);

    function endLabels(list, parent) {
      const labels = list.map(s => ({ s, at: py(y(s.points[s.points.length - 1]).value) })).sort((a, b) => a.at - b.at);
      const gap = 17;
      for (let pass = 0; pass < 60; pass++)
        for (let i = 1; i < labels.length; i++) {
          const short = gap - (labels[i].at - labels[i - 1].at);
          if (short > 0) { labels[i - 1].at = Math.max(edge.top + 8, labels[i - 1].at - short / 2); labels[i].at += short / 2; }
        }
      for (const { s, at } of labels) {
        const last = s.points[s.points.length - 1], lx = px(x(last));
        make("path", { fill: "none", stroke: s.color, opacity: .45, d: `M${lx + 4},${py(y(last).value)}L${right + 4},${at}` }, parent);
        const text = make("text", { class: "label", x: right + 8, y: at + 4 }, parent, s.name);
        text.style.fill = s.color;
      }
    }

    svg.onpointermove = svg.onpointerdown = event => {
      const bounds = svg.getBoundingClientRect(), scale = width / bounds.width;
      const mx = (event.clientX - bounds.left) * scale, my = (event.clientY - bounds.top) * scale;
      let best = null;
      for (const s of shown) for (const p of s.points) {
        const d = Math.hypot(px(x(p)) - mx, py(y(p).value) - my);
        if (d < 48 && (!best || d < best.d)) best = { d, s, p };
      }
      tip.hidden = !best;
      if (!best) return;
      const v = y(best.p);
      tip.replaceChildren();
      const title = document.createElement("b");
      title.textContent = best.s.name; title.style.color = best.s.color;
      tip.append(title, `${best.p.spp} spp, ${seconds(best.p.device_seconds)}`, document.createElement("br"),
        `${yLabel} ${figure(v.value)}` + (v.low != null && v.high != null ? ` (${figure(v.low)} … ${figure(v.high)})` : ""));
      const left = px(x(best.p)) / scale, top = py(y(best.p).value) / scale;
      tip.style.left = Math.max(4, Math.min(bounds.width - tip.offsetWidth - 4, left + 12)) + "px";
      tip.style.top = Math.max(0, top - tip.offsetHeight - 10) + "px";
    };
    svg.onpointerleave = () => { tip.hidden = true; };
  }
  /// Decades, with 2 and 5 between them where that leaves room.
  function decimals(low, high) {
    const list = [], steps = high / low < 2000 ? [1, 2, 5] : [1];
    for (let e = Math.floor(Math.log10(low)); e <= Math.log10(high); e++)
      for (const m of steps) { const v = m * 10 ** e; if (v >= low && v <= high) list.push(v); }
    return list;
  }
  function powersOfTwo(low, high) {
    const list = [];
    for (let v = 1; v <= high; v *= 2) if (v >= low) list.push(v);
    return list;
  }
  draw();
  return draw;
}
