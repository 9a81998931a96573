import { PerspectiveCamera, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { h } from "./dom.js";

const narrow = 640; // [px] shapes are put below each other in less
const height = 440,
  stackedHeight = 320; // [px]

/** A picture of one or two shapes beside each other, all seen by the same camera. */
export class Stage {
  constructor() {
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setClearColor(0xffffff);
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.autoClear = false;
    this.canvas = this.renderer.domElement;
    this.names = h("div", { class: "names" });
    this.element = h("div", { class: "stage" }, this.canvas, this.names);
    this.shapes = [];
    this.camera = new PerspectiveCamera(22, 1, 0.1, 5000);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableZoom = false; // the wheel scrolls the page until the picture is clicked
    this.controls.addEventListener("change", () => this.render());
    this.canvas.addEventListener("pointerdown", () => (this.controls.enableZoom = true));
    this.canvas.addEventListener("pointerleave", () => (this.controls.enableZoom = false));
  }

  get width() {
    return this.element.clientWidth;
  }

  get stacked() {
    return this.width < narrow;
  }

  resize() {
    const parts = Math.max(1, this.shapes.length);
    const tall = this.stacked ? stackedHeight * parts : height;
    this.element.style.height = `${tall}px`;
    this.renderer.setSize(this.width, tall);
    this.camera.aspect = this.stacked ? this.width / stackedHeight : this.width / parts / height;
    this.camera.updateProjectionMatrix();
    this.names.classList.toggle("stacked", this.stacked);
  }

  render() {
    const parts = this.shapes.length;
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    let triangles = 0;
    this.shapes.forEach((shape, i) => {
      const box = this.stacked
        ? [0, stackedHeight * (parts - 1 - i), this.width, stackedHeight]
        : [(this.width * i) / parts, 0, this.width / parts, height];
      this.renderer.setViewport(...box);
      this.renderer.setScissor(...box);
      shape.lightFrom(this.camera);
      this.renderer.render(shape.scene, this.camera);
      triangles += this.renderer.info.render.triangles;
    });
    this.canvas.dataset.triangles = triangles;
  }

  /** Looks from the front at a ball of radius `reach` about the origin. */
  fit(reach) {
    const half = Math.sin((0.5 * this.camera.fov * Math.PI) / 180);
    this.camera.position.set(0, 0, (1.1 * reach) / half / Math.min(1, this.camera.aspect));
    this.controls.target.set(0, 0, 0);
    this.controls.update();
    this.render();
  }

  /** Goes to `factor` times the distance. */
  zoom(factor) {
    const { position } = this.camera,
      { target } = this.controls;
    position.sub(target).multiplyScalar(factor).add(target);
    this.controls.update();
    this.render();
  }
}
