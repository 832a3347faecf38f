// The tray in 3-D. The library is large and is fetched only when somebody wants to see this.
import { element } from './elements.js';
import { is_lit, item_of_label } from './item_colours.js';
import { make_mesh, paint_mesh } from './tray_mesh.js';
import { highest_mm } from './tray_shape.js';
import { word } from './words.js';

const kTurnStep = Math.PI / 24;
const kLowest = 0.1;  // from straight above, rad
const kFlattest = 1.45;

// Where the eye stands on a sphere around the tray.
class Eye {
  constructor(size) {
    this.turn = -0.5;
    this.tilt = 0.85;
    this.distance = size * 1.3;
    this.nearest = size * 0.4;
    this.farthest = size * 3;
  }

  move(turn, tilt, factor = 1) {
    this.turn += turn;
    this.tilt = Math.min(Math.max(this.tilt + tilt, kLowest), kFlattest);
    this.distance = Math.min(Math.max(this.distance * factor, this.nearest), this.farthest);
  }

  place(camera, height) {
    const flat = this.distance * Math.sin(this.tilt);
    camera.position.set(flat * Math.sin(this.turn), -flat * Math.cos(this.turn),
      height + this.distance * Math.cos(this.tilt));
    camera.up.set(0, 0, 1);
    camera.lookAt(0, 0, height);
  }
}

const kKeys = {
  ArrowLeft: [-kTurnStep, 0], ArrowRight: [kTurnStep, 0], ArrowUp: [0, -kTurnStep], ArrowDown: [0, kTurnStep],
  '+': [0, 0, 0.9], '-': [0, 0, 1.1],
};

class Scene {
  constructor(three, canvas, shape, scan, selection, signal) {
    this.three = three;
    this.canvas = canvas;
    this.shape = shape;
    this.scan = scan;
    this.selection = selection;
    this.signal = signal;
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.camera = new three.PerspectiveCamera(38, 4 / 3, 10, 5000);
    this.eye = new Eye(Math.max(shape.bounds.width, shape.bounds.depth));
    this.middle = highest_mm(shape) / 3;
    this.build();
    this.listen();
  }

  build() {
    const { three, shape, scan } = this;
    const { bounds } = shape;
    const centre = [bounds.left + bounds.width / 2, bounds.near + bounds.depth / 2];
    this.scene = new three.Scene();
    this.scene.add(new three.HemisphereLight(0xffffff, 0x888880, 0.75));
    const lamp = new three.DirectionalLight(0xffffff, 0.55);
    lamp.position.set(-1, -0.6, 1.6);
    this.scene.add(lamp);
    this.meshes = shape.dishes.map((dish) => make_mesh(three, dish, scan, centre));
    this.meshes.forEach((mesh) => this.scene.add(mesh));
  }

  listen() {
    const { signal } = this;
    const on = (name, action) => this.canvas.addEventListener(name, action, { signal });
    on('pointerdown', (event) => this.canvas.setPointerCapture(event.pointerId));
    on('pointermove', (event) => (event.buttons === 0 ? this.point(event) : this.drag(event)));
    on('pointerleave', () => this.selection.point(null));
    on('wheel', (event) => this.turn(event, [0, 0, event.deltaY > 0 ? 1.08 : 0.92]));
    on('keydown', (event) => kKeys[event.key] && this.turn(event, kKeys[event.key]));
    this.selection.addEventListener('change', () => this.light_up(), { signal });
    const observer = new ResizeObserver(() => this.fit());
    observer.observe(this.canvas.parentElement);
    signal.addEventListener('abort', () => {
      observer.disconnect();
      this.meshes.forEach((mesh) => mesh.geometry.dispose());
      this.renderer.dispose();
    });
  }

  turn(event, move) {
    event.preventDefault();
    this.eye.move(...move);
    this.draw();
  }

  drag(event) {
    this.eye.move(-event.movementX / 150, -event.movementY / 150);
    this.draw();
  }

  point(event) {
    const box = this.canvas.getBoundingClientRect();
    const place = new this.three.Vector2(((event.clientX - box.left) / box.width) * 2 - 1,
      1 - ((event.clientY - box.top) / box.height) * 2);
    const ray = new this.three.Raycaster();
    ray.setFromCamera(place, this.camera);
    const hit = ray.intersectObjects(this.meshes)[0];
    const label = hit ? this.shape.dishes[this.meshes.indexOf(hit.object)].labels[hit.face.a] : 0;
    this.selection.point(item_of_label(label, this.scan)?.label ?? null);
  }

  light_up() {
    const { label } = this.selection;
    const lit = label === null ? null : (of_cell) => is_lit(of_cell, label, this.scan);
    this.meshes.forEach((mesh, i) => paint_mesh(this.three, mesh, this.shape.dishes[i], this.scan, lit));
    this.draw();
  }

  fit() {
    const width = this.canvas.parentElement.clientWidth;
    if (width === 0) return;
    const height = Math.round(width * 0.68);
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  // Once for each change and not all the time: a small board draws this, too.
  draw() {
    if (this.is_waiting) return;
    this.is_waiting = true;
    requestAnimationFrame(() => {
      this.is_waiting = false;
      if (this.signal.aborted) return;
      this.eye.place(this.camera, this.middle);
      this.renderer.render(this.scene, this.camera);
      this.canvas.dataset.drawn = this.selection.label ?? 'all';
    });
  }
}

function has_webgl() {
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('webgl2') ?? canvas.getContext('webgl');
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return context !== null;
}

function sentence(key) {
  return element('p', { class: 'notice', role: 'note' }, word(key));
}

async function open_scene(frame, shape, scan, selection, signal) {
  if (!has_webgl()) throw new Error('tray.no_webgl');
  const three = await import('./three/three.module.js').catch(() => { throw new Error('tray.no_library'); });
  if (signal.aborted) return;
  const canvas = element('canvas', {
    class: 'space', tabindex: '0', role: 'application', 'aria-label': word('tray.space_label'),
  });
  frame.replaceChildren(canvas, element('p', { class: 'quiet told' }, word('tray.space_hint')));
  const scene = new Scene(three, canvas, shape, scan, selection, signal);
  scene.fit();
}

export function show_space(shape, scan, selection, signal) {
  const frame = element('div', {}, element('p', { class: 'quiet' }, word('tray.loading')));
  open_scene(frame, shape, scan, selection, signal).catch((error) => {
    const key = error.message === 'tray.no_library' ? error.message : 'tray.no_webgl';
    frame.replaceChildren(sentence(key));
  });
  return frame;
}
