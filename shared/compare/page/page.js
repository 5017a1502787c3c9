// Makes the page interactive. Without scripts it is complete: every figure is a picture.
"use strict";

function element(kind, properties = {}, children = []) {
  const made = Object.assign(document.createElement(kind), properties);
  made.append(...children);
  return made;
}

function short(value) {
  return Number(value.toPrecision(4)).toString();
}

// Value of a line at x between its corners, which is straight on the axes of its chart; null outside of it.
function valueAt(line, x, log) {
  const across = log[0] ? Math.log10 : value => value;
  for (let i = 1; i < line.length; ++i) {
    const a = line[i - 1], b = line[i];
    if (Math.min(a.x, b.x) <= x && x <= Math.max(a.x, b.x)) {
      const part = a.x === b.x ? 1 : (across(x) - across(a.x)) / (across(b.x) - across(a.x));
      return log[1] ? a.y * (b.y / a.y) ** part : a.y + (b.y - a.y) * part;
    }
  }
  return null;
}

// A vertical line under the pointer, and the values of all lines there in words below the chart.
const pointer = {
  id: "pointer",
  afterEvent(chart, {event}) {
    const area = chart.chartArea;
    const inside = event.type !== "mouseout" && event.x >= area.left && event.x <= area.right;
    chart.pointerX = inside ? chart.scales.x.getValueForPixel(event.x) : null;
    const words = [];
    if (inside) {
      words.push(`${chart.options.scales.x.title.text}: ${short(chart.pointerX)}`);
      chart.data.datasets.forEach((set, i) => {
        const value = set.label && chart.isDatasetVisible(i) ? valueAt(set.data, chart.pointerX, chart.log) : null;
        if (value !== null) words.push(`${set.label}: ${short(value)}`);
      });
    }
    chart.readout.textContent = words.join("; ");
    chart.draw();
  },
  afterDraw(chart) {
    if (chart.pointerX === null || chart.pointerX === undefined) return;
    const x = chart.scales.x.getPixelForValue(chart.pointerX), pen = chart.ctx;
    pen.save();
    pen.strokeStyle = "#888";
    pen.beginPath();
    pen.moveTo(x, chart.chartArea.top);
    pen.lineTo(x, chart.chartArea.bottom);
    pen.stroke();
    pen.restore();
  },
};

function axis(title, log, range) {
  const made = {type: log ? "logarithmic" : "linear", title: {display: true, text: title}};
  if (range) [made.min, made.max] = range;
  return made;
}

// Adds a chart to a box. lines: [{label, color, dash, marker, x, y}]
function addChart(box, {title, x, y, log, range, lines}) {
  const canvas = element("canvas", {role: "img", ariaLabel: `${title || y}: ${y} against ${x}`});
  const readout = element("p", {className: "readout", textContent: "Values: point at the chart."});
  readout.setAttribute("aria-live", "polite");
  box.append(element("div", {className: "chart"}, [canvas]), readout);
  const datasets = lines.map(line => ({
    label: line.label, data: line.x.map((value, i) => ({x: value, y: line.y[i]})).filter(p => p.x !== null && p.y !== null),
    borderColor: line.color, backgroundColor: line.color, borderDash: line.dash || [], showLine: line.dash !== null,
    borderWidth: 2, pointRadius: line.marker ? 4 : 0, pointHitRadius: 0, tension: 0,
  }));
  const chart = new Chart(canvas, {
    type: "scatter", data: {datasets}, plugins: [pointer],
    options: {
      locale: "en", animation: false, maintainAspectRatio: false, events: ["mousemove", "mouseout", "click", "touchstart", "touchmove"],
      scales: {x: axis(x, log[0], range && range[0]), y: axis(y, log[1], range && range[1])},
      plugins: {
        title: {display: Boolean(title), text: title}, tooltip: {enabled: false},
        legend: {labels: {usePointStyle: true, pointStyle: "line", filter: item => item.text !== ""}},
      },
    },
  });
  Object.assign(chart, {readout, log});
  return chart;
}

// A button under a figure of lines that puts charts in its place, on the screen only.
function offerCharts(figure, charts) {
  const picture = figure.querySelector(".frame");
  const button = element("button", {type: "button", className: "interactive", textContent: "Read off values"});
  const box = element("div", {className: "interactive", hidden: true});
  button.addEventListener("click", () => {
    box.hidden = !box.hidden;
    picture.classList.toggle("replaced", !box.hidden);
    button.textContent = box.hidden ? "Read off values" : "Show the figure";
    if (!box.hasChildNodes()) charts.forEach(chart => addChart(box, chart));
  });
  picture.after(box, button);
}

function choice(label, options) {
  const select = element("select", {}, options.map((text, i) => element("option", {value: String(i), textContent: text})));
  return [select, element("label", {}, [`${label} `, select])];
}

// A chart of a shot: the reader chooses what is drawn against what.
function explore(box, {name, across, up}) {
  const [upChoice, upLabel] = choice("Show", up.map(column => column.label));
  const [acrossChoice, acrossLabel] = choice("against", across.map(column => column.label));
  const place = element("div");
  box.append(element("div", {className: "controls"}, [upLabel, acrossLabel]), place);
  let chart = null;
  const show = () => {
    if (chart) chart.destroy();
    place.replaceChildren();
    const x = across[acrossChoice.value], y = up[upChoice.value];
    chart = addChart(place, {title: name, x: x.label, y: y.label, log: [false, false], range: null, lines: [
      {label: y.label, color: "#0072b2", dash: [], marker: false, x: x.values, y: y.values}]});
  };
  [upChoice, acrossChoice].forEach(select => select.addEventListener("change", show));
  box.hidden = false;
  show();
}

// The scale of colours of damage with its ends, and words behind it.
function colorScale({shown, colors}, words) {
  const bar = element("span", {className: "scale"});
  bar.style.background = `linear-gradient(to right, ${colors.join(", ")})`;
  return element("p", {className: "controls readout"}, [`damage ${shown[0]}`, bar, `${shown[1]}; ${words}`]);
}

// States of the section as film.py packs them: per point x, z (16 bits each), then one byte for each damage.
function unpack(text, count, names) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0)), view = new DataView(bytes.buffer);
  const places = begin => Array.from({length: count}, (_, i) => view.getUint16(begin + 2 * i, true));
  return {x: places(0), z: places(2 * count), damage: names.map((_, k) => bytes.subarray((4 + k) * count, (5 + k) * count))};
}

class Film {
  constructor(figure, film) {
    this.film = film;
    this.states = film.states.map(state => unpack(state.points, film.count, film.names));
    this.canvas = element("canvas", {className: "section", width: 960, height: Math.round(960 * (film.high - film.low) / (2 * film.half))});
    this.canvas.setAttribute("role", "img");
    this.slider = element("input", {type: "range", min: "0", max: String(film.states.length - 1), step: "1",
      value: String(film.states.length - 1)});
    this.slider.setAttribute("aria-label", "time");
    this.time = element("output");
    const [kind, kindLabel] = choice("damage", film.names);
    this.kind = kind;
    this.readout = element("p", {className: "readout", textContent: "Values: point at the picture."});
    const controls = element("div", {className: "controls"}, [element("label", {}, ["time "]), this.slider, this.time, kindLabel]);
    const box = element("div", {className: "interactive"}, [controls, this.canvas,
      colorScale(film, `grey: less; width ${short(2 * film.half)} mm`), this.readout]);
    const picture = figure.querySelector(".frame");
    picture.classList.add("replaced");
    picture.after(box);
    this.slider.addEventListener("input", () => this.draw());
    kind.addEventListener("change", () => this.draw());
    this.canvas.addEventListener("pointermove", event => this.read(event));
    this.draw();
  }

  // Pixels per mm.
  scale() {
    return this.canvas.width / (2 * this.film.half);
  }

  // -1: of a body without damage.
  damage(state, i) {
    const level = state.damage[this.kind.value][i];
    return level === 255 ? -1 : level / 254;
  }

  color(value) {
    const [low, high] = this.film.shown, colors = this.film.colors;
    if (value < 0) return this.film.steel;
    if (value < low) return this.film.sound;
    return colors[Math.min(colors.length - 1, Math.floor(colors.length * (value - low) / (high - low)))];
  }

  draw() {
    const at = Number(this.slider.value), state = this.states[at], pen = this.canvas.getContext("2d");
    const {width, height} = this.canvas, scale = this.scale();
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, width, height);
    const order = state.x.map((_, i) => i).filter(i => state.x[i] < 65535);
    order.sort((a, b) => this.damage(state, a) - this.damage(state, b));
    for (const i of order) {
      pen.fillStyle = this.color(this.damage(state, i));
      pen.beginPath();
      pen.arc(state.x[i] / 65534 * width, state.z[i] / 65534 * height, 0.5 * this.film.sizes[i] * scale, 0, 2 * Math.PI);
      pen.fill();
    }
    for (const [x, z] of this.film.states[at].outlines) {
      pen.beginPath();
      x.forEach((value, i) => pen.lineTo((value + this.film.half) * scale, (z[i] - this.film.low) * scale));
      pen.closePath();
      pen.fillStyle = "#b9c4d0e0";
      pen.strokeStyle = "#2c3e50";
      pen.lineWidth = 2;
      pen.fill();
      pen.stroke();
    }
    this.time.textContent = `${this.film.states[at].time} ms`;
    this.canvas.setAttribute("aria-label", `${this.film.names[this.kind.value]} in the section at ${this.film.states[at].time} ms`);
  }

  // Damage of the nearest point, in words.
  read(event) {
    const frame = this.canvas.getBoundingClientRect(), state = this.states[Number(this.slider.value)], {width, height} = this.canvas;
    const x = (event.clientX - frame.left) / frame.width * width, y = (event.clientY - frame.top) / frame.height * height;
    let best = -1, least = Infinity;
    state.x.forEach((value, i) => {
      const distance = Math.hypot(value / 65534 * width - x, state.z[i] / 65534 * height - y);
      if (value < 65535 && distance < least) [best, least] = [i, distance];
    });
    const found = best >= 0 && least <= this.film.sizes[best] * this.scale();
    this.readout.textContent = `x ${short(x / this.scale() - this.film.half)} mm, z ${short(y / this.scale() + this.film.low)} mm` +
      (found && this.damage(state, best) >= 0 ? `, ${this.film.names[this.kind.value]} ${short(this.damage(state, best))}` : "");
  }
}

const readData = script => JSON.parse(script.textContent);
document.querySelectorAll("figure script.charts").forEach(script => offerCharts(script.closest("figure"), readData(script)));
document.querySelectorAll("figure script.film").forEach(script => new Film(script.closest("figure"), readData(script)));
document.querySelectorAll("figure script.solid").forEach(script => offerSolid(script.closest("figure"), readData(script)));
document.querySelectorAll("div.explorer > script").forEach(script => explore(script.parentElement, readData(script)));
