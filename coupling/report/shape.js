import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Group,
  HemisphereLight,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  Scene,
  SRGBColorSpace,
  Vector3,
} from "three";
import { colourAt, domain, fieldsOf } from "./colours.js";
import { h } from "./dom.js";
import { number } from "./format.js";
import { surfaceOf, tube } from "./surfaces.js";

const steps = 256; // of a colour scale
const glass = 0.12; // opacity of a surface without contact that is looked through

/** Colours of a scale as linear RGB, as three.js wants them. */
function palette(field) {
  const colour = new Color(),
    table = new Float32Array(3 * steps);
  for (let i = 0; i < steps; ++i) {
    colour.setStyle(colourAt(field, i / (steps - 1)), SRGBColorSpace).toArray(table, 3 * i);
  }
  return table;
}

/** Colour and opacity of every point; with `through`, what bears no contact is glass. */
function paint(field, values, [low, high], through) {
  const table = palette(field),
    painted = new Float32Array(4 * values.length);
  values.forEach((value, i) => {
    const t = (value * field.factor - low) / (high - low);
    const step = Math.round(Math.min(1, Math.max(0, t)) * (steps - 1));
    painted.set(table.subarray(3 * step, 3 * step + 3), 4 * i);
    painted[4 * i + 3] = through ? glass + (1 - glass) * Math.min(1, t / 0.05) : 1;
  });
  return painted;
}

/** Turns the pulling axis z to the right, and the direction in which the knot is widest upwards. */
export function upright({ x, y }) {
  let xx = 0,
    xy = 0,
    yy = 0;
  const mean = (values) => values.reduce((a, b) => a + b, 0) / values.length;
  const [mx, my] = [mean(x), mean(y)];
  x.forEach((_, i) => {
    const [a, b] = [x[i] - mx, y[i] - my];
    ((xx += a * a), (xy += a * b), (yy += b * b));
  });
  const angle = 0.5 * Math.atan2(2 * xy, xx - yy);
  const right = new Vector3(0, 0, 1),
    up = new Vector3(Math.cos(angle), Math.sin(angle), 0);
  return new Matrix4().makeBasis(right, up, right.clone().cross(up)).transpose();
}

/** The shape of one fidelity at the state shown, coloured by a field. */
export class Shape {
  constructor(fidelity, result, turned) {
    this.fidelity = fidelity;
    this.result = result;
    this.scene = new Scene();
    this.light = new DirectionalLight(0xffffff, 1.6);
    this.mesh = new Mesh(
      new BufferGeometry(),
      new MeshLambertMaterial({ vertexColors: true, side: DoubleSide }),
    );
    this.mesh.frustumCulled = false;
    const group = new Group();
    group.applyMatrix4(turned);
    group.add(this.mesh);
    this.scene.add(group, this.light, new HemisphereLight(0xffffff, 0xb8bcc0, 1.9));
    const available = this.valuesOf(result.states.find((state) => this.there(state)));
    this.fields = Object.entries(fieldsOf(result)[fidelity]).filter(([name]) => name in available);
    this.choose(this.fields[0][0]);
  }

  there(state) {
    return this.fidelity === "rod" ? !!state.lines.rod : !!state.surface && !!state.lines.solid;
  }

  valuesOf(state) {
    return this.fidelity === "rod" ? state.lines.rod : state.surface;
  }

  choose(name) {
    [this.name, this.field] = this.fields.find(([of]) => of === name);
  }

  /** The fields that there are, as [name, label]. */
  choices() {
    return this.fields.map(([name, field]) => [name, field.label]);
  }

  get visible() {
    return this.mesh.visible;
  }

  lightFrom({ position, up }) {
    this.light.position.copy(position).applyAxisAngle(up, 0.5);
    this.light.position.y += 0.5 * position.length();
  }

  /** Builds the surface of a state. `sameScale`: a colour means the same at every state;
   *  `throughRod`: contact is seen through the rest. */
  show(state, { sameScale, throughRod }) {
    this.mesh.visible = this.there(state);
    if (!this.visible) return;
    const drawn = sameScale ? this.result.states.filter((of) => this.there(of)) : [state];
    const through = throughRod && this.field.scale === "contact";
    this.domain = domain(
      this.field,
      drawn.map((of) => this.valuesOf(of)[this.name]),
    );
    this.mesh.geometry.dispose();
    this.mesh.geometry = this.geometryOf(state, through);
    this.mesh.position.fromArray(state.lines[this.fidelity].centre).negate();
    Object.assign(this.mesh.material, { transparent: through, depthWrite: !through });
    this.mesh.material.needsUpdate = true;
  }

  geometryOf(state, through) {
    const { points, triangles, node } =
      this.fidelity === "rod" ? tube(state.lines.rod) : surfaceOf(state.surface, this.result.quads);
    const values = this.valuesOf(state)[this.name];
    const atPoints = node ? Float32Array.from(node, (of) => values[of]) : values;
    const colours = paint(this.field, atPoints, this.domain, through);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(points, 3));
    geometry.setAttribute("color", new BufferAttribute(colours, 4));
    geometry.setIndex(new BufferAttribute(triangles, 1));
    geometry.computeVertexNormals();
    return geometry;
  }

  legend() {
    const stops = Array.from({ length: 24 }, (_, i) => colourAt(this.field, i / 23));
    const [low, high] = this.domain;
    return h(
      "div",
      { class: "legend" },
      h("div", {}, this.field.label),
      h("div", {
        class: "bar",
        style: `background: linear-gradient(to right, ${stops.join(",")})`,
      }),
      h(
        "div",
        { class: "ends" },
        h("span", {}, number(low)),
        this.field.scale === "about" ? h("span", {}, number(this.field.neutral)) : null,
        h("span", {}, number(high)),
      ),
    );
  }
}
