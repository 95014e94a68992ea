// Elements of a report with too little contrast by WCAG 2: 4.5 for text, 3 for the lines and bars of plots.
(() => {
  const probe = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgb = (colour) => {
    probe.fillStyle = colour;
    probe.fillRect(0, 0, 1, 1);
    return [...probe.getImageData(0, 0, 1, 1).data].slice(0, 3);
  };
  const linear = (v) => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
  const luminance = (colour) => {
    const [r, g, b] = rgb(colour).map(linear);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const contrast = (a, b) => {
    const [high, low] = [luminance(a), luminance(b)].sort((x, y) => y - x);
    return (high + 0.05) / (low + 0.05);
  };
  const behind = (element) => {
    for (let e = element; e; e = e.parentElement) {
      const colour = getComputedStyle(e).backgroundColor;
      if (colour !== "rgba(0, 0, 0, 0)") return colour;
    }
    return "white";
  };
  const poor = new Set();
  const check = (selector, property, needed) => document.querySelectorAll(selector).forEach((e) => {
    if (!e.getClientRects().length) return;
    const found = contrast(getComputedStyle(e)[property], behind(e));
    if (found < needed) poor.add(`${e.tagName}.${e.getAttribute("class")} ${property} ${found.toFixed(2)}`);
  });
  check("h1,h2,h3,p,th,td,li,a,caption,figcaption,b,button,span:not(:empty)", "color", 4.5);
  check("svg text:not(.cell):not(.inside)", "fill", 4.5);
  check("svg .line, svg .predicted, svg .measured, svg .dots", "stroke", 3);
  check("svg .bar", "fill", 3);
  return [...poor];
})()
