import { h } from "./dom.js";
import { number, short } from "./format.js";
import { Shape, upright } from "./shape.js";
import { Stage } from "./stage.js";
import { fidelityName } from "./words.js";

const pause = 700; // [ms] between states while playing

function select(label, options, chosen, onchange) {
  const entries = options.map(([value, text]) =>
    h("option", { value, selected: value === chosen }, text),
  );
  return h(
    "label",
    {},
    `${label} `,
    h("select", { onchange: (event) => onchange(event.target.value) }, entries),
  );
}

const button = (text, onclick) => h("button", { type: "button", onclick }, text);

/** Play, slider and name of the state; calls `show(index)`. */
class Player {
  constructor(states, show) {
    Object.assign(this, { states, show, at: states.length - 1, timer: null });
    this.play = button("Play", () => (this.timer ? this.stop() : this.start()));
    this.slider = h("input", {
      type: "range",
      min: 0,
      max: states.length - 1,
      value: this.at,
      "aria-label": "recorded state",
      oninput: () => {
        this.stop();
        this.go(Number(this.slider.value));
      },
    });
    this.name = h("output", { class: "now" });
    this.element = h("div", { class: "controls" }, this.play, this.slider, this.name);
  }

  go(at) {
    this.at = at;
    this.slider.value = at;
    this.name.textContent = `ē = ${short(this.states[at].ebar)}`;
    this.show(at);
  }

  start() {
    const last = this.states.length - 1;
    if (this.at === last) this.go(0);
    this.timer = setInterval(() => (this.at < last ? this.go(this.at + 1) : this.stop()), pause);
    this.play.textContent = "Pause";
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
    this.play.textContent = "Play";
  }
}

/** The recorded states as surfaces that can be turned, with a slider over them. */
class Viewer {
  constructor(result, drawn) {
    this.states = result.states;
    this.stage = new Stage();
    const last = this.states.at(-1).lines;
    const turned = upright(last.rod ?? last.solid);
    this.shapes = drawn.map((fidelity) => new Shape(fidelity, result, turned));
    this.stage.shapes = this.shapes;
    this.options = { sameScale: true, throughRod: true, follow: true };
    this.reach = 1; // [D] of the state shown
    this.legends = h("div", { class: "legends" });
    this.player = new Player(this.states, () => this.update());
    this.element = h(
      "div",
      {},
      this.player.element,
      this.stage.element,
      this.legends,
      this.controls(),
    );
    let width = 0;
    new ResizeObserver(() => {
      if (this.stage.width === width || this.stage.width === 0) return;
      const first = width === 0;
      width = this.stage.width;
      this.stage.resize();
      this.player.go(this.player.at);
      if (first) this.fitKnot();
    }).observe(this.stage.element);
  }

  get state() {
    return this.states[this.player.at];
  }

  controls() {
    const check = (text, option) => {
      const onchange = (event) => {
        this.options[option] = event.target.checked;
        this.update();
      };
      return h("label", {}, h("input", { type: "checkbox", checked: true, onchange }), ` ${text}`);
    };
    const choices = [
      ["both", "rod and solid"],
      ["rod", "rod"],
      ["solid", "solid"],
    ];
    return h(
      "div",
      { class: "controls" },
      this.shapes.length > 1
        ? select("show", choices, "both", (choice) => this.choose(choice))
        : null,
      this.shapes.map((shape) =>
        select(`colour of ${shape.fidelity}`, shape.choices(), shape.name, (name) => {
          shape.choose(name);
          this.update();
        }),
      ),
      check("same colours at all ē", "sameScale"),
      check("see contact through the rod", "throughRod"),
      check("zoom follows the knot", "follow"),
      button("Knot", () => this.fitKnot()),
      button("Whole rod", () => this.fitRod()),
      button("+", () => this.stage.zoom(0.8)),
      button("−", () => this.stage.zoom(1.25)),
    );
  }

  /** Shows the state of the player. */
  update() {
    const { state } = this;
    for (const shape of this.stage.shapes) shape.show(state, this.options);
    const before = this.reach;
    this.reach = this.knotReach();
    if (this.options.follow && before !== this.reach) this.stage.zoom(this.reach / before);
    this.stage.names.replaceChildren(...this.stage.shapes.map((shape) => this.nameOf(shape)));
    this.legends.replaceChildren(
      ...this.stage.shapes.map((shape) => (shape.visible ? shape.legend() : h("div"))),
    );
    this.stage.canvas.dataset.state = state.name;
    this.stage.render();
  }

  nameOf({ fidelity, visible }) {
    const row = this.state.row[fidelity];
    const tension = row ? ` T̄ = ${number(row.force_normalised)}` : "";
    return h("div", {}, fidelityName(fidelity), visible ? tension : " no state recorded here");
  }

  choose(which) {
    this.stage.shapes = this.shapes.filter(
      ({ fidelity }) => which === "both" || fidelity === which,
    );
    this.stage.resize();
    this.update();
    this.fitKnot();
  }

  knotReach() {
    const reaches = this.stage.shapes.map(({ fidelity }) => this.state.lines[fidelity]?.reach ?? 0);
    return Math.max(...reaches) || this.reach;
  }

  fitKnot() {
    this.stage.fit(this.knotReach());
  }

  fitRod() {
    const ends = Object.values(this.state.lines).map(({ z, centre }) =>
      Math.max(z.at(-1) - centre[2], centre[2] - z[0]),
    );
    this.stage.fit(Math.max(...ends));
  }
}

/** The viewer, or a sentence on why there is none. */
export function viewer(result) {
  const drawn = result.fidelities.filter((fidelity) =>
    result.states.some((state) => (fidelity === "rod" ? state.lines.rod : state.surface)),
  );
  if (drawn.length === 0) return h("p", {}, "No recorded state has been written yet.");
  try {
    return new Viewer(result, drawn).element;
  } catch (error) {
    const files = drawn.map((fidelity) => `${fidelity}/${fidelity}.pvd`).join(" and ");
    return h(
      "p",
      {},
      `This browser cannot draw the shapes (${error.message}); ParaView opens ${files}.`,
    );
  }
}
