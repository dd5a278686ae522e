// Pictures side by side under one divider, and all of them in panes: zoomed and moved together.
"use strict";
function viewer(root, compare, divider) {
  const view = { zoom: 1, x: 0, y: 0 };  // x, y: what lies at the panes' top left, 0 to 1 of the picture
  const level = root.querySelector("#zoom-level");
  const apply = () => {
    view.zoom = Math.min(32, Math.max(1, view.zoom));
    view.x = Math.min(1 - 1 / view.zoom, Math.max(0, view.x));
    view.y = Math.min(1 - 1 / view.zoom, Math.max(0, view.y));
    root.style.setProperty("--z", view.zoom);
    root.style.setProperty("--tx", -100 * view.x * view.zoom);
    root.style.setProperty("--ty", -100 * view.y * view.zoom);
    root.classList.toggle("zoomed", view.zoom > 1.001);
    level.textContent = (view.zoom < 10 ? +view.zoom.toFixed(1) : Math.round(view.zoom)) + "×";
  };
  /// About the point u, v of a pane, 0 to 1.
  const zoomBy = (factor, u, v) => {
    const zoom = Math.min(32, Math.max(1, view.zoom * factor));
    view.x += u / view.zoom - u / zoom;
    view.y += v / view.zoom - v / zoom;
    view.zoom = zoom;
    apply();
  };
  root.querySelectorAll("[data-zoom]").forEach(button => button.addEventListener("click", () => {
    if (button.dataset.zoom === "reset") { view.zoom = 1; apply(); } else zoomBy(button.dataset.zoom === "in" ? 1.6 : 1 / 1.6, .5, .5);
  }));

  const cutTo = percent => {
    const cut = Math.min(100, Math.max(0, percent));
    compare.style.setProperty("--cut", cut + "%");
    divider.setAttribute("aria-valuenow", Math.round(cut));
  };
  const cutAt = event => { const b = compare.getBoundingClientRect(); cutTo(100 * (event.clientX - b.left) / b.width); };
  divider.addEventListener("pointerdown", event => {
    event.stopPropagation(); event.preventDefault();
    divider.setPointerCapture(event.pointerId); divider.focus(); cutAt(event);
  });
  divider.addEventListener("pointermove", event => { if (divider.hasPointerCapture(event.pointerId)) cutAt(event); });
  divider.addEventListener("keydown", event => {
    const step = { ArrowLeft: -2, ArrowRight: 2, Home: -100, End: 100 }[event.key];
    if (step) { event.preventDefault(); cutTo(+divider.getAttribute("aria-valuenow") + step); }
  });

  function watch(frame) {
    const pointers = new Map();
    let moved = 0;
    const place = event => { const b = frame.getBoundingClientRect(); return [(event.clientX - b.left) / b.width, (event.clientY - b.top) / b.height]; };
    frame.addEventListener("wheel", event => {
      if (!event.ctrlKey && !event.metaKey && !root.classList.contains("engaged")) return;  // the page scrolls on
      event.preventDefault();
      zoomBy(Math.exp(-event.deltaY * (event.deltaMode ? .05 : .002)), ...place(event));
    }, { passive: false });
    frame.addEventListener("pointerdown", event => {
      root.classList.add("engaged");
      frame.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, place(event)); moved = 0;
    });
    frame.addEventListener("pointermove", event => {
      const before = pointers.get(event.pointerId);
      if (!before) return;
      const now = place(event), other = [...pointers].find(([id]) => id !== event.pointerId);
      if (other) {
        const [u, v] = other[1];
        zoomBy(Math.hypot(now[0] - u, now[1] - v) / Math.max(.01, Math.hypot(before[0] - u, before[1] - v)), u, v);
      } else {
        view.x -= (now[0] - before[0]) / view.zoom;
        view.y -= (now[1] - before[1]) / view.zoom;
        apply();
      }
      moved += Math.abs(now[0] - before[0]) + Math.abs(now[1] - before[1]);
      pointers.set(event.pointerId, now);
    });
    const lift = event => {
      if (pointers.delete(event.pointerId) && moved < .01 && event.type === "pointerup" && frame.onpick) frame.onpick(event);
    };
    frame.addEventListener("pointerup", lift);
    frame.addEventListener("pointercancel", lift);
    frame.addEventListener("dblclick", event => zoomBy(2, ...place(event)));
  }
  document.addEventListener("pointerdown", event => { if (!root.contains(event.target)) root.classList.remove("engaged"); });
  watch(compare);
  apply();
  return watch;
}
