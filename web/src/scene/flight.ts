// SPDX-License-Identifier: Apache-2.0
// A recording in the scene: frames, the vehicle's links in them, marks.
import { AxesHelper, Group, Object3D, type Plane } from "three";
import type { Mark, Recording } from "../recording/recording";
import { indexAt, valueAt } from "../recording/series";
import { dispose, markShape } from "./marks";
import { buildRobot, type Robot } from "./robot";

const kTurning_rad_s = 30;

export class FlightView {
  readonly root = new Group();
  private readonly frames = new Map<string, Object3D>();
  private readonly robot: Robot;
  private readonly urdf: string;
  private readonly shown = new Map<string, { mark: Mark; shape: Object3D }>();

  /**
   * @param ghost  beside another flight: the vehicle alone, seen through
   * @param cut    of the wall, for the camera
   */
  constructor(
    readonly recording: Recording,
    private readonly ghost: boolean,
    private readonly cut: Plane,
  ) {
    const kGhost = 0.35;
    this.urdf = recording.urdf;
    this.robot = buildRobot(recording.urdf, recording.meshes, ghost ? kGhost : 1);
    this.frames.set("map", this.root);
    for (const child of recording.frames.keys()) {
      this.frames.set(child, this.robot.links.get(child) ?? new Object3D());
    }
    for (const [child, track] of recording.frames) {
      this.frames.get(track.parent)?.add(this.frames.get(child) as Object3D);
    }
    if (this.robot.links.size === 0) {
      const kArm_m = 0.3;
      this.position()?.add(new AxesHelper(kArm_m)); // of no known shape: forward, left, up
    }
  }

  /** Whether frames have come that it was not made with. */
  get outgrown(): boolean {
    return this.recording.frames.size >= this.frames.size || this.recording.urdf !== this.urdf;
  }
  /** Everything as it was at `t` [s]. */
  show(t: number): void {
    for (const [child, track] of this.recording.frames) {
      const frame = this.frames.get(child);
      if (frame === undefined) {
        continue; // come since
      }
      const [x, y, z, qx, qy, qz, qw] = track.at(t);
      frame.position.set(x, y, z);
      frame.quaternion.set(qx, qy, qz, qw);
    }
    this.turnRotors(t);
    this.pressCup(t);
    this.showMarks(t);
  }
  /** Where the vehicle is, in the scene. */
  position(): Object3D | undefined {
    return this.frames.get("base_link");
  }
  lip(): Object3D | undefined {
    return this.frames.get("lip");
  }

  /** It will not be shown again: what it holds on the graphics card is given back. */
  dispose(): void {
    dispose(this.root);
    for (const link of this.robot.links.values()) {
      dispose(link);
    }
  }

  /** Of a flight that still flies the tables grow. */
  private value(topic: string, column: string, t: number): number {
    const table = this.recording.tables.get(topic);
    const values = table?.columns.get(column);
    return (table && values && valueAt(table.time, values, t)) ?? 0;
  }
  private turnRotors(t: number): void {
    const turning = this.value("/truth/vehicle", "rotor_speed_rad_s[0]", t) > kTurning_rad_s;
    for (const disc of this.robot.discs) {
      disc.visible = turning;
    }
    for (const blade of this.robot.blades) {
      blade.visible = !turning;
    }
  }
  /** The lip is pressed together by as much as it is inside the wall. */
  private pressCup(t: number): void {
    const depth = -Math.min(0, this.value("/cup", "gap_m", t));
    const length = this.recording.frames.get("lip")?.at(0)[0] ?? 0.04;
    this.robot.soft.scale.x = Math.max(0.3, 1 - depth / length);
  }
  private showMarks(t: number): void {
    for (const [key, track] of this.recording.marks) {
      const at = indexAt(track.time, t);
      const mark = at < 0 ? null : (track.marks[at] as Mark | null);
      const before = this.shown.get(key);
      const wanted = mark !== null && (!this.ghost || mark.name === "path") ? mark : null;
      if (before?.mark === wanted || (before === undefined && wanted === null)) {
        continue;
      }
      if (before !== undefined) {
        before.shape.removeFromParent();
        dispose(before.shape);
        this.shown.delete(key);
      }
      const shape = wanted === null ? undefined : markShape(wanted, this.cut);
      if (wanted !== null && shape !== undefined) {
        (this.frames.get(wanted.frame) ?? this.root).add(shape);
        this.shown.set(key, { mark: wanted, shape });
      }
    }
  }
}
