// The charts are in the page as SVG. This shows one of them at a time, hides series, and tells the point that is nearest
// to the pointer.
"use strict";
function charts(box, tip) {
  const all = [...box.querySelectorAll(".chart")];
  let shown = all[0];
  // The browser would show a point's <title> too, a second later and beside the tip.
  for (const title of box.querySelectorAll("circle > title")) {
    title.parentNode.dataset.note = title.textContent;
    title.remove();
  }
  const hideTip = () => { tip.hidden = true; };

  box.onpointermove = box.onpointerdown = event => {
    let best = null;
    for (const circle of shown.querySelectorAll("circle")) {
      const b = circle.getBoundingClientRect();  // empty where the series or the whole SVG is not displayed
      const x = b.left + b.width / 2, y = b.top + b.height / 2;
      const distance = b.width ? Math.hypot(x - event.clientX, y - event.clientY) : Infinity;
      if (distance < 48 && (!best || distance < best.distance)) best = { circle, distance, x, y };
    }
    tip.hidden = !best;
    if (!best) return;
    tip.textContent = best.circle.dataset.note;
    tip.style.borderColor = getComputedStyle(best.circle).fill;
    const frame = box.getBoundingClientRect();
    tip.style.left = Math.max(4, Math.min(frame.width - tip.offsetWidth - 4, best.x - frame.left + 12)) + "px";
    tip.style.top = Math.max(0, best.y - frame.top - tip.offsetHeight - 10) + "px";
  };
  box.onpointerleave = hideTip;

  return {
    /// The values of an attribute in the order of the charts: "what" or "over".
    names: key => [...new Set(all.map(chart => chart.dataset[key]))],
    show(key, name) {
      const wanted = { ...shown.dataset, [key]: name };
      shown = all.find(chart => chart.dataset.what === wanted.what && chart.dataset.over === wanted.over);
      for (const chart of all) chart.hidden = chart !== shown;
      hideTip();
    },
    setSeries(index, visible) {
      for (const group of box.querySelectorAll(`[data-series="${index}"]`)) group.classList.toggle("off", !visible);
      hideTip();
    },
  };
}
