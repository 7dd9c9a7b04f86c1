import {
  ArrowHelper, BoxGeometry, BufferGeometry, CapsuleGeometry, Color, CylinderGeometry, DirectionalLight, DoubleSide, ExtrudeGeometry,
  Float32BufferAttribute, Group, HemisphereLight, InstancedMesh, LineBasicMaterial, LineSegments, Mesh, MeshStandardMaterial, Object3D,
  PerspectiveCamera, Plane, PlaneGeometry, Scene, Shape, TorusGeometry, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const metal = (color) => new MeshStandardMaterial({ color, metalness: 0.3, roughness: 0.6 });

/** A cylinder whose axis is y, as wheels and segments are. */
function drum(radius, length, material) {
  return new Mesh(new CylinderGeometry(radius, radius, length, 24), material);
}

/** A bar between two points of a group's frame. */
function bar(from, to, radius, material) {
  const a = new Vector3(...from);
  const b = new Vector3(...to);
  const made = drum(radius, a.distanceTo(b), material);
  made.position.copy(a).add(b).multiplyScalar(0.5);
  made.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), b.sub(a).normalize());
  return made;
}

/** The fuselage as a capsule with wings and tail, in the true places of gear and hook. */
function fuselage(g) {
  const group = new Group();
  const paint = metal(0x9aa7b4);
  const body = new Mesh(new CapsuleGeometry(g.radius_m, g.length_m, 6, 20), paint);
  body.rotation.z = Math.PI / 2;
  body.position.set(g.middle_m, 0, g.height_m);
  const wing = new Mesh(new BoxGeometry(g.chord_m, g.span_m, 0.15), paint);
  wing.position.set(-0.1 * g.length_m, 0, g.height_m);
  const tail = new Mesh(new BoxGeometry(0.6 * g.chord_m, 0.45 * g.span_m, 0.12), paint);
  tail.position.set(g.middle_m - 0.5 * g.length_m, 0, g.height_m + 0.2);
  const fin = new Mesh(new BoxGeometry(0.6 * g.chord_m, 0.12, 0.14 * g.span_m), paint);
  fin.position.set(g.middle_m - 0.5 * g.length_m, 0, g.height_m + 0.09 * g.span_m);
  for (const part of [body, wing, tail, fin]) { part.material.transparent = true; part.material.opacity = 0.55; }
  group.add(body, wing, tail, fin);
  for (const strut of g.struts) group.add(bar(strut.top, strut.foot, 0.09, metal(0xd8dde2)));
  return group;
}

/** The hook: the outline of its head extruded over its width, and the shank to the pivot. */
function hook(g) {
  const group = new Group();
  const steel = metal(0x7a848e);
  const outline = new Shape();
  g.outline.forEach(([u, w], i) => (i ? outline.lineTo(u, w) : outline.moveTo(u, w)));
  const head = new Mesh(new ExtrudeGeometry(outline, { depth: g.width_m, bevelEnabled: false, steps: 1 }), steel);
  // the outline's plane is x, z of the hook; extruded along y about the middle
  head.rotation.x = Math.PI / 2;
  head.position.set(g.shoe_m[0], g.shoe_m[1] + 0.5 * g.width_m, g.shoe_m[2]);
  group.add(head, bar(g.shank[0], g.shank[1], g.arm_radius_m, metal(0xd0b040)));
  return group;
}

function wheel(g) {
  const group = new Group();
  const tyre = new Mesh(new TorusGeometry(0.72 * g.radius_m, 0.28 * g.radius_m, 14, 32), metal(0x202224));
  tyre.rotation.x = Math.PI / 2;
  tyre.scale.z = g.width_m / (0.56 * g.radius_m);
  const rim = drum(0.5 * g.radius_m, 0.6 * g.width_m, metal(0xb0b6bc));
  const mark = new Mesh(new BoxGeometry(0.9 * g.radius_m, 0.62 * g.width_m, 0.08), metal(0xd55e00));
  group.add(tyre, rim, mark);
  return group;
}

function deck(g) {
  const group = new Group();
  const width = 1.4 * g.span_m;
  const plate = new Mesh(new PlaneGeometry(120, width), new MeshStandardMaterial({ color: 0x5a6066, roughness: 0.95, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
  const coarse = [];
  for (let x = -30; x <= 30; ++x) coarse.push(x, -0.5 * width, 0.001, x, 0.5 * width, 0.001);
  const fine = []; // every 10 cm where hook and cable meet
  for (let i = -20; i <= 20; ++i) fine.push(0.1 * i, -2, 0.001, 0.1 * i, 2, 0.001, -2, 0.1 * i, 0.001, 2, 0.1 * i, 0.001);
  const grid = (ends, opacity) => new LineSegments(new BufferGeometry().setAttribute("position", new Float32BufferAttribute(ends, 3)),
    new LineBasicMaterial({ color: 0x30353a, transparent: true, opacity }));
  group.add(plate, grid(coarse, 0.6), grid(fine, 0.15));
  for (const y of g.supports_m) {
    const leaf = new Mesh(new BoxGeometry(0.25, 0.05, g.support_height_m), metal(0xe69f00));
    leaf.position.set(0, y, 0.5 * g.support_height_m);
    group.add(leaf);
  }
  for (const y of [-0.5 * g.span_m, 0.5 * g.span_m]) {
    const sheave = drum(0.18, 0.12, metal(0x999999));
    sheave.position.set(0, y, g.sheave_height_m);
    group.add(sheave);
  }
  return group;
}

/** Blue where slack, through yellow, to red at the largest tension. */
function heat(share, out) {
  return out.setHSL(0.62 * (1 - Math.min(1, Math.max(0, share))), 0.9, 0.5);
}

/** One landing in three dimensions on one canvas. */
export class Stage {
  /** @param {HTMLCanvasElement} canvas @param {import("./motion.js").Motion} motion */
  constructor(canvas, motion) {
    const g = motion.record.geometry;
    this.motion = motion;
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.scene = new Scene();
    this.scene.background = new Color(0xaec6dc);
    this.camera = new PerspectiveCamera(40, 1, 0.3, 400);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.scene.add(new HemisphereLight(0xffffff, 0x667788, 1.6), deck(g.deck));
    const sun = new DirectionalLight(0xffffff, 1.8);
    sun.position.set(-20, -30, 60);
    this.scene.add(sun);

    this.parts = motion.record.bodies.names.map((name) => {
      if (name === "fuselage") return fuselage(g.fuselage);
      if (name === "hook") return hook(g.hook);
      const found = g.wheels.find((w) => w.body === name);
      if (found) return wheel(found);
      const piston = g.pistons.find((p) => p.body === name);
      return piston ? new Group().add(bar([0, 0, 0], piston.top, 0.06, metal(0xeeeeee))) : new Group();
    });
    this.scene.add(...this.parts);

    this.points = new Float32Array(3 * motion.nodes);
    this.tensions = new Float32Array(motion.nodes);
    this.tightest = Math.max(motion.record.cable.tension.greatest, 1);
    this.rope = new InstancedMesh(new CylinderGeometry(g.deck.rope_radius_m, g.deck.rope_radius_m, 1, 12, 1), metal(0xffffff), motion.nodes - 1);
    // the close-up leaves out the cable between the eye and the hook
    this.renderer.localClippingEnabled = true;
    this.cut = new Plane(new Vector3(0, 1, 0), 1e3);
    this.halfWidth = 0.5 * g.hook.width_m;
    this.rope.material.clippingPlanes = [this.cut];
    this.rope.material.side = DoubleSide;
    this.rope.frustumCulled = false;
    this.scene.add(this.rope);
    this.arrows = g.forces.map((force) => {
      const arrow = new ArrowHelper(new Vector3(0, 0, 1), new Vector3(), 1, 0x009e73, 0.2, 0.1);
      this.scene.add(arrow);
      return { force, arrow };
    });
    this.view = "side";
    this.follow = true;
    this.hookBody = motion.record.bodies.names.indexOf("hook");
    this.resize();
    this.look("side");
    this.show(motion.begin);
  }

  resize() {
    const width = this.canvas.clientWidth || 640;
    const height = this.canvas.clientHeight || 360;
    this.renderer.setPixelRatio(Math.min(2, globalThis.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  /** @param {"side"|"hook"|"above"|"orbit"} view */
  look(view) {
    this.view = view;
    const at = this.target(this.time ?? this.motion.begin);
    const offset = { side: [0, -20, 3], hook: [0.2, -3.2, 0.5], above: [-4, 0.01, 26], orbit: [-14, -14, 8] }[view];
    this.camera.fov = view === "hook" ? 13 : 40; // the close-up is a long lens
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(at);
    this.camera.position.copy(at).add(new Vector3(...offset));
    this.controls.update();
  }

  /** What the camera follows: the lip in the close-up, the aircraft else. */
  target(time) {
    if (this.view === "hook")
      return new Vector3(this.motion.value("lip_x_m", time), this.motion.value("lip_y_m", time), Math.max(0.05, this.motion.value("lip_z_m", time)));
    const place = this.motion.place(0, time);
    return new Vector3(place[0] - 2, 0, this.view === "above" ? 0 : 1.5);
  }

  show(time) {
    this.time = time;
    const m = this.motion;
    this.parts.forEach((part, body) => {
      part.position.set(...m.place(body, time));
      const e = m.turn(body, time);
      part.quaternion.set(e[1], e[2], e[3], e[0]);
    });
    m.rope(time, this.points, this.tensions);
    this.cut.constant = this.view === "hook" ? 0.06 + this.halfWidth - m.value("lip_y_m", time) : 1e3;
    this.layRope();
    const pull = new Vector3();
    for (const { force, arrow } of this.arrows) {
      if (force.vector) {
        pull.set(...force.vector.map((name) => m.value(name, time)));
        const size = pull.length();
        arrow.visible = size * force.metres_per_newton > 0.01;
        if (!arrow.visible) continue;
        arrow.position.set(...force.at.map((name) => m.value(name, time)));
        arrow.setDirection(pull.divideScalar(size));
        arrow.setLength(size * force.metres_per_newton, 0.05, 0.025);
        continue;
      }
      const size = m.value(force.curve, time);
      const length = Math.max(0, size) * force.metres_per_newton;
      arrow.visible = length > 0.02;
      if (!arrow.visible) continue;
      arrow.position.set(m.value(force.x, time), force.y ? m.value(force.y, time) : force.side, 0.01);
      arrow.setLength(length, 0.25 * length, 0.12 * length);
    }
    if (this.view !== "orbit") {
      const moved = this.target(time).sub(this.controls.target);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
    }
    this.controls.update();
    this.renderer.render(this.scene, this.camera);
  }

  layRope() {
    const piece = Stage.piece ?? (Stage.piece = new Object3D());
    const up = new Vector3(0, 1, 0);
    const a = new Vector3();
    const b = new Vector3();
    const color = new Color();
    for (let i = 0; i + 1 < this.motion.nodes; ++i) {
      a.fromArray(this.points, 3 * i);
      b.fromArray(this.points, 3 * i + 3);
      piece.position.copy(a).add(b).multiplyScalar(0.5);
      b.sub(a);
      piece.scale.set(1, b.length() * 1.02, 1);
      piece.quaternion.setFromUnitVectors(up, b.normalize());
      piece.updateMatrix();
      this.rope.setMatrixAt(i, piece.matrix);
      this.rope.setColorAt(i, heat(this.tensions[i] / this.tightest, color));
    }
    this.rope.instanceMatrix.needsUpdate = true;
    this.rope.instanceColor.needsUpdate = true;
  }

  dispose() {
    this.controls.dispose();
    this.renderer.dispose();
  }
}
