// Behaviour of the report page: the theme, and interactive time series where the library is there.
"use strict";
(() => {
  const root = document.documentElement;
  const prefersDark = window.matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => root.dataset.theme ? root.dataset.theme === "dark" : prefersDark.matches;

  // The choice is remembered where the browser lets a local file do so.
  const remembered = {
    get() { try { return localStorage.getItem("ident-theme"); } catch { return null; } },
    set(value) { try { localStorage.setItem("ident-theme", value); } catch { /* not remembered */ } },
  };
  const button = document.getElementById("theme");
  const labelButton = () => { button.textContent = isDark() ? "Light" : "Dark"; };
  if (remembered.get()) root.dataset.theme = remembered.get();
  labelButton();
  button.hidden = false;
  button.addEventListener("click", () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    remembered.set(root.dataset.theme);
    labelButton();
    charts.forEach((chart) => chart.draw());
  });
  prefersDark.addEventListener("change", () => { labelButton(); charts.forEach((chart) => chart.draw()); });

  const wide = window.matchMedia("(min-width: 78rem)");
  const contents = document.getElementById("contents");
  const unfold = () => { contents.open = wide.matches; };
  wide.addEventListener("change", unfold);
  unfold();

  const charts = [];
  const source = document.getElementById("plot-data");
  if (!source || typeof uPlot === "undefined") return;
  const page = JSON.parse(source.textContent);
  const colour = (name) => getComputedStyle(root).getPropertyValue(name).trim();

  // A vector from base64 float32; `gaps` asks for null where there is no number, which uPlot leaves open.
  const decoded = page.arrays.map(() => null);
  function vector(index) {
    if (!decoded[index]) {
      const text = atob(page.arrays[index]);
      const bytes = new Uint8Array(text.length);
      for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
      decoded[index] = new Float32Array(bytes.buffer);
    }
    return decoded[index];
  }
  function gaps(values) {
    return values.some(Number.isNaN) ? Array.from(values, (v) => (Number.isNaN(v) ? null : v)) : values;
  }

  // uPlot wants one time axis: series of other rates are joined, and drawn across the samples they lack.
  function align(plot) {
    const columns = [];
    plot.series.forEach((s) => {
      columns.push({ x: s.x, y: gaps(vector(s.y)) });
      if (s.style === "band") columns.push({ x: s.x, y: gaps(vector(s.y2)) });
    });
    const axes = [...new Set(columns.map((c) => c.x))];
    const shifted = new Map(axes.map((x) => [x, new Float64Array(vector(x)).map((t) => t + plot.origin)]));
    if (axes.length === 1) return [shifted.get(axes[0]), ...columns.map((c) => c.y)];
    return uPlot.join(columns.map((c) => [shifted.get(c.x), c.y]));
  }

  // uPlot cuts gaps out of one line, and none that is narrower than a pixel: pieces are drawn one by one, where
  // they are not too many for that.
  const inPieces = (values) => values.length < 50000 && values.some(Number.isNaN);
  function pieces(u, series, from, to) {
    const stroke = new Path2D(), x = u.data[0], y = u.data[series];
    let down = false;
    for (let i = Math.max(0, from - 1); i <= Math.min(x.length - 1, to + 1); i++) {
      if (y[i] === undefined) continue;
      if (y[i] === null) { down = false; continue; }
      const at = [u.valToPos(x[i], "x", true), u.valToPos(y[i], "y", true)];
      down ? stroke.lineTo(...at) : stroke.moveTo(...at);
      down = true;
    }
    return { stroke };
  }

  // Ticks with the decimals that their distance asks for.
  function tickLabels(u, ticks, axis, space, step) {
    let decimals = 0;
    for (let s = step; decimals < 12 && Math.abs(s - Math.round(s)) > 1e-6 * s; s *= 10) decimals++;
    const label = (v) => decimals > 5 ? Number(v.toPrecision(3)).toExponential() : v.toFixed(decimals);
    return ticks.map((v) => v === 0 ? "0" : label(v));
  }

  const width = { measured: 1, predicted: 2, line: 1.5 };
  function seriesOf(plot) {
    const all = [{ label: plot.x }], bands = [];
    // What was measured lies wide and pale below what should lie on it, several long lines let each other
    // through: as in the static pictures.
    const under = plot.series.some((s) => s.style === "predicted");
    const dense = plot.series.filter((s) => s.style === "line" && vector(s.y).length > 400).length > 1;
    plot.series.forEach((s) => {
      const below = under && s.style === "measured", through = dense && s.style === "line";
      const stroke = (s.style === "measured" ? colour("--measured") : colour(`--c${s.colour}`)) +
        (below ? "66" : through ? "a6" : "");
      if (s.style === "band") {
        const edge = { class: "edge", stroke: `${stroke}66`, width: 0.5, points: { show: false } };
        all.push({ ...edge, label: `${s.name} low` }, { ...edge, label: `${s.name} high` });
        bands.push({ series: [all.length - 1, all.length - 2], fill: `${stroke}33` });
      } else if (s.style === "points") {
        all.push({ label: s.name, stroke, width: 0, paths: () => null, points: { show: true, size: 4, fill: stroke } });
      } else if (s.style === "bars") {
        all.push({ label: s.name, stroke, fill: stroke, paths: uPlot.paths.bars(), points: { show: false } });
      } else {
        all.push({ label: s.name, stroke, width: below ? 4 : through ? 1 : width[s.style], points: { show: false },
          ...(inPieces(vector(s.y)) && { paths: pieces }) });
      }
    });
    return { all, bands };
  }

  function axis(label, size) {
    const font = "12px system-ui, sans-serif";
    return { label, size, font, values: tickLabels, labelFont: font, labelSize: 22, stroke: colour("--soft"),
      grid: { stroke: colour("--grid"), width: 1 }, ticks: { stroke: colour("--grid"), width: 1 } };
  }

  let sharing = false; // while a zoom is passed on, so that it is not passed back
  class Chart {
    constructor(box, plot) {
      this.box = box;
      this.plot = plot;
      this.data = null;
      this.view = null;
      this.reset = document.createElement("button");
      this.reset.type = "button";
      this.reset.className = "reset";
      this.reset.textContent = "Whole record";
      this.reset.addEventListener("click", () => this.zoom(null));
    }
    draw() {
      const start = performance.now();
      const range = this.range;
      this.data ??= align(this.plot);
      this.view?.destroy();
      const { all, bands } = seriesOf(this.plot);
      this.view = new uPlot({
        width: this.box.clientWidth, height: 300, series: all, bands,
        scales: { x: { time: false } },
        axes: [axis(this.plot.x, 34), axis(this.plot.y, 62)],
        legend: { markers: { width: 0, fill: (u, i) => u.series[i].stroke() } },
        cursor: { sync: { key: this.plot.group }, drag: { x: true, y: false, uni: 12 } },
        hooks: { setScale: [(_, key) => { if (key === "x") this.share(); }] },
      }, this.data, this.box);
      if (range) this.zoom(range);
      this.box.append(this.reset);
      this.box.classList.add("live");
      // uPlot draws in a microtask of its own, queued before this one.
      queueMicrotask(() => { this.box.dataset.milliseconds = (performance.now() - start).toFixed(0); });
    }
    get whole() { return [this.data[0][0], this.data[0][this.data[0].length - 1]]; }
    // What is shown, null for the whole record.
    get range() {
      if (!this.view) return null;
      const { min, max } = this.view.scales.x, [from, to] = this.whole;
      return min <= from && max >= to ? null : [min, max];
    }
    zoom(range) {
      const [min, max] = range ?? this.whole;
      this.view.setScale("x", { min, max });
    }
    share() {
      if (!this.view) return;
      const range = this.range;
      this.reset.hidden = range === null;
      if (sharing) return;
      sharing = true;
      charts.forEach((other) => {
        if (other === this || other.plot.group !== this.plot.group) return;
        other.view ? other.zoom(range) : (other.wanted = range);
      });
      queueMicrotask(() => { sharing = false; });
    }
  }

  document.querySelectorAll("[data-plot]").forEach((box) => {
    charts.push(new Chart(box, page.plots[Number(box.dataset.plot)]));
  });
  const seen = new IntersectionObserver((entries) => entries.forEach((entry) => {
    if (!entry.isIntersecting) return;
    seen.unobserve(entry.target);
    const chart = charts.find((c) => c.box === entry.target);
    chart.draw();
    if (chart.wanted) chart.zoom(chart.wanted);
  }), { rootMargin: "800px" });
  const resized = new ResizeObserver((entries) => entries.forEach(({ target }) => {
    const chart = charts.find((c) => c.box === target);
    if (chart.view && target.clientWidth !== chart.view.width)
      chart.view.setSize({ width: target.clientWidth, height: 300 });
  }));
  charts.forEach((chart) => { seen.observe(chart.box); resized.observe(chart.box); });
})();
