// SPDX-License-Identifier: Apache-2.0
// Light, floor, camera: what flights are shown on.
import {
  AmbientLight,
  Color,
  DirectionalLight,
  GridHelper,
  HemisphereLight,
  MOUSE,
  PerspectiveCamera,
  Plane,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { FlightView } from "./flight";

export type ViewName = "side" | "cup" | "chase" | "overview";
export const kViews: [ViewName, string][] = [
  ["side", "Side"],
  ["cup", "Cup"],
  ["chase", "Chase"],
  ["overview", "Overview"],
];

/** From what is looked at to the camera [m]: towards the wall, to the right, up. */
const kFrom: Record<ViewName, [number, number, number]> = {
  side: [-0.1, 2.2, 0],
  cup: [-0.35, 0.55, 0.2],
  chase: [-2.4, 0.5, 0.8],
  overview: [-2.0, 3.2, 1.4],
};
const kBriefly = 0.5;
/** Shares of the dots, from picture to picture while it plays. */
const kDetails = [1, 0.7, 0.5, 0.35];
const kSlow_ms = 40; // between two pictures; 60 a second are 17, 30 are 33
const kSlowPictures = 4; // in a row
const kNowhere_m = 1e6;
/** Less than a vehicle that rests is before the wall, or the camera would be within it. */
const kAhead_m = 0.1;

export class Stage {
  readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(38, 1, 0.01, 200);
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight(0xffffff, 2.2);
  private grid: GridHelper | undefined;
  private flights: FlightView[] = [];
  /** What of a wall is nearer to the camera than this is not drawn. */
  readonly cut = new Plane(new Vector3(1, 0, 0), kNowhere_m);
  private view: ViewName = "side";
  private readonly followed = new Vector3();

  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.localClippingEnabled = true;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.mouseButtons = { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    Object.assign(this.sun.shadow.camera, {
      left: -3,
      right: 3,
      top: 3,
      bottom: -3,
      near: 0.1,
      far: 20,
    });
    this.scene.add(this.sun, this.sun.target, new AmbientLight(0xffffff, 0.5));
    this.scene.add(new HemisphereLight(0xffffff, 0x888888, 1.0));
  }

  /** Pictures follow each other at once, with fewer dots; a machine without a graphics card keeps up. */
  brief = false;
  private playing = false;
  private detail = 0;
  private slow = 0; // pictures in a row
  private readonly replaced: FlightView[] = [];
  /** It plays: with as many dots as the machine draws in time, to be found out anew. */
  get moving(): boolean {
    return this.playing;
  }
  set moving(moving: boolean) {
    if (moving && !this.playing) {
      this.detail = 0;
      this.slow = 0;
    }
    this.playing = moving;
  }
  /** @param took_ms  from the picture before to this one, while it plays */
  pace(took_ms: number): void {
    this.slow = took_ms > kSlow_ms ? this.slow + 1 : 0;
    if (this.slow >= kSlowPictures && this.detail < kDetails.length - 1) {
      this.detail += 1;
      this.slow = 0;
    }
  }
  setFlights(flights: FlightView[]): void {
    const gone = this.flights.filter((flight) => !flights.includes(flight));
    this.scene.remove(...gone.map((flight) => flight.root));
    this.replaced.push(...gone);
    this.flights = flights;
    this.scene.add(...flights.map((flight) => flight.root));
  }
  setDark(dark: boolean): void {
    this.scene.background = new Color(dark ? 0x3b424a : 0xeef1f4);
    if (this.grid !== undefined) {
      this.scene.remove(this.grid);
      this.grid.dispose();
    }
    this.grid = new GridHelper(20, 20, dark ? 0x5a626b : 0xb0b8c0, dark ? 0x4a525b : 0xd4dae0);
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = this.floor;
    this.scene.add(this.grid);
  }
  private floor = -2;
  setFloor(z: number): void {
    this.floor = z;
    if (this.grid !== undefined) {
      this.grid.position.z = z;
    }
  }

  /** Puts the camera there; it goes along with the vehicle from then on. */
  look(view: ViewName): void {
    this.view = view;
    const vehicle = this.flights[0]?.position();
    if (vehicle === undefined) {
      return;
    }
    const at = vehicle.getWorldPosition(new Vector3());
    const lip = this.flights[0]?.lip()?.getWorldPosition(new Vector3()) ?? at;
    // The wall is ahead of the vehicle's start: sideways to it, level.
    const ahead = this.ahead();
    const right = new Vector3(ahead.y, -ahead.x, 0);
    const target = view === "cup" ? lip : at.clone().addScaledVector(ahead, kAhead_m);
    const [forward, aside, up] = kFrom[view];
    this.camera.position
      .copy(target)
      .addScaledVector(ahead, forward)
      .addScaledVector(right, aside)
      .add(new Vector3(0, 0, up));
    this.controls.target.copy(target);
    this.controls.update();
    this.followed.copy(view === "cup" ? lip : at);
  }
  get currentView(): ViewName {
    return this.view;
  }

  /** Shows each flight at its time [s]. */
  draw(times: number[]): void {
    this.flights.forEach((flight, i) => {
      flight.show(times[i] ?? 0);
    });
    this.follow();
    const canvas = this.renderer.domElement;
    const { clientWidth: width, clientHeight: height } = canvas;
    const dots = this.brief ? kBriefly : this.playing ? (kDetails[this.detail] ?? 1) : 1;
    const ratio = dots * Math.min(window.devicePixelRatio, 2);
    if (
      canvas.width !== Math.floor(width * ratio) ||
      canvas.height !== Math.floor(height * ratio)
    ) {
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / Math.max(1, height);
      this.camera.updateProjectionMatrix();
    }
    this.renderer.shadowMap.autoUpdate = !this.brief; // the last one stays
    this.renderer.render(this.scene, this.camera);
    // Not before the next are drawn: a shader without a material is compiled anew.
    for (const flight of this.replaced.splice(0)) {
      flight.dispose();
    }
  }
  /** Waits until the renderer has drawn: it works later than it is called. */
  finish(): void {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
  /** Where the vehicle is in the picture: x, y from -1 to 1, and whether it is in it. */
  vehicleInPicture(): { x: number; y: number; seen: boolean } {
    const at = this.flights[0]?.position()?.getWorldPosition(new Vector3()) ?? new Vector3();
    const p = at.project(this.camera);
    return { x: p.x, y: p.y, seen: Math.abs(p.x) < 1 && Math.abs(p.y) < 1 && p.z < 1 };
  }

  /** Into the wall, level; where the nose points first when there is none. */
  private ahead(): Vector3 {
    const frames = this.flights[0]?.recording.frames;
    const [, , , x, y, z, w] = (frames?.get("wall") ?? frames?.get("base_link"))?.at(0) ?? [
      0, 0, 0, 0, 0, 0, 1,
    ];
    const ahead = new Vector3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 0);
    return ahead.lengthSq() > 1e-6 ? ahead.normalize() : new Vector3(1, 0, 0);
  }
  private follow(): void {
    const flight = this.flights[0];
    const followed =
      this.view === "cup" ? (flight?.lip() ?? flight?.position()) : flight?.position();
    if (followed === undefined) {
      return;
    }
    const now = followed.getWorldPosition(new Vector3());
    const moved = now.clone().sub(this.followed);
    this.followed.copy(now);
    this.camera.position.add(moved);
    this.controls.target.add(moved);
    this.controls.update();
    const ahead = this.ahead();
    const kCut_m = 0.45; // of the vehicle's middle: its rotors stay before the wall
    this.cut.normal.set(-ahead.y, ahead.x, 0);
    this.cut.constant = this.view === "side" ? kCut_m - this.cut.normal.dot(now) : kNowhere_m;
    this.sun.target.position.copy(now);
    this.sun.position
      .copy(now)
      .addScaledVector(ahead, -3)
      .add(new Vector3(ahead.y * 2.5, -ahead.x * 2.5, 5));
  }
}
