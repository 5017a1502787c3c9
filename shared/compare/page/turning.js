// How the view in space (solid.js) is offered below its picture, and turned.
"use strict";

// Ways to turn: pointer, wheel with a key (the wheel alone scrolls the page), keys, buttons.
function steer(view, canvas) {
  const step = Math.PI / 18, pointers = new Map();
  const span = () => Math.hypot(...["x", "y"].map(k => [...pointers.values()].reduce((difference, pointer) => pointer[k] - difference, 0)));
  const acts = {
    ArrowLeft: () => view.rotate(-step, 0), ArrowRight: () => view.rotate(step, 0), ArrowUp: () => view.rotate(0, -step),
    ArrowDown: () => view.rotate(0, step), "+": () => view.magnify(1.2), "-": () => view.magnify(1 / 1.2), Home: () => view.reset(),
  };
  canvas.addEventListener("keydown", event => {
    const act = acts[event.key === "=" ? "+" : event.key];
    if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    act();
  });
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
  canvas.addEventListener("pointermove", event => {
    const old = pointers.get(event.pointerId), now = {x: event.clientX, y: event.clientY};
    if (!old) return;
    const before = pointers.size === 2 ? span() : 0;
    pointers.set(event.pointerId, now);
    if (before) view.magnify(span() / before);
    else view.rotate((now.x - old.x) * 0.01, (now.y - old.y) * 0.01);
  });
  canvas.addEventListener("wheel", event => {
    if (!event.ctrlKey) return;
    event.preventDefault();
    view.magnify(Math.exp(-0.002 * event.deltaY));
  }, {passive: false});
  return [["◀", "turn left", "ArrowLeft"], ["▶", "turn right", "ArrowRight"], ["▲", "turn up", "ArrowUp"],
    ["▼", "turn down", "ArrowDown"], ["+", "larger", "+"], ["−", "smaller", "-"], ["first view", "first view", "Home"]].map(([text, label, key]) => {
    const button = element("button", {type: "button", textContent: text, ariaLabel: label});
    button.addEventListener("click", acts[key]);
    return button;
  });
}

// A button under a picture of the body that puts the view in its place; where the browser cannot, the picture stays.
function offerSolid(figure, solid) {
  const picture = figure.querySelector(".frame");
  const button = element("button", {type: "button", className: "interactive", textContent: "Turn it in 3D"});
  const box = element("div", {className: "interactive", hidden: true});
  const words = element("p", {className: "readout", hidden: true});
  const show = shown => {
    box.hidden = !shown;
    picture.classList.toggle("replaced", shown);
    button.textContent = shown ? "Show the picture" : "Turn it in 3D";
  };
  const give = text => { show(false); box.replaceChildren(); Object.assign(words, {hidden: false, textContent: text}); };
  const build = () => {
    const canvas = element("canvas", {className: "solid", width: 900, height: 720, tabIndex: 0, role: "img",
      ariaLabel: `The body in space at ${solid.time} ms, coloured by damage; arrow keys turn it, + and - change its size`});
    const view = new Solid(solid, canvas), open = element("input", {type: "checkbox"});
    canvas.addEventListener("webglcontextlost", () => give("The browser has ended this view; the picture stays."));
    open.addEventListener("change", () => { view.open = open.checked; view.draw(); });
    box.append(element("div", {className: "controls"}, [...steer(view, canvas), element("label", {}, [open, " cut open"])]), canvas,
      colorScale(solid, `grey: less; ${solid.time} ms`), element("p", {className: "readout", textContent:
        "Drag it, or use the arrow keys, to turn it; + and −, two fingers, or the wheel with Ctrl change its size."}));
  };
  button.addEventListener("click", () => {
    try {
      if (!box.hasChildNodes()) build();
      words.hidden = true;
      show(box.hidden);
    } catch {
      give("This browser cannot draw in 3D (it has no WebGL 2): the picture stays.");
    }
  });
  picture.after(box, words, button);
}
