// SPDX-License-Identifier: Apache-2.0
// A recording in the scene: frames, the vehicle's links in them, marks.
import { AxesHelper, Group, Object3D, type Plane } from "three";
import type { Mark, MarkTrack, Recording } from "../recording/recording";
import { indexAt, valueAt } from "../recording/series";
import { alike, dispose, markShape } from "./marks";
import { Path, type Piece } from "./path";
import { buildRobot, type Robot } from "./robot";

const kTurning_rad_s = 30;

export class FlightView {
  readonly root = new Group();
  private readonly frames = new Map<string, Object3D>();
  private readonly robot: Robot;
  private readonly urdf: string;
  private readonly meshes: number; // that it was made with
  private readonly shown = new Map<string, { mark: Mark; shape: Object3D }>();
  private marks = new Map<string, MarkTrack>();
  private path: Path | undefined;
  private sorted: Map<string, MarkTrack> | undefined; // into these two, with so many
  private sortedMarks = 0;

  /**
   * @param ghost  next to another flight: the vehicle alone, seen through
   * @param cut    of the wall, for the camera
   */
  constructor(
    public recording: Recording,
    private readonly ghost: boolean,
    private readonly cut: Plane,
  ) {
    const kGhost = 0.35;
    this.urdf = recording.urdf;
    this.meshes = recording.meshes.size;
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

  /**
   * Another flight of the same vehicle in this one's place, with all that is drawn already.
   * @returns whether it is so: of the same shape, with the same frames
   */
  takes(recording: Recording, ghost: boolean): boolean {
    const before = this.recording;
    const same =
      !this.outgrown &&
      (recording === before ||
        (recording.urdf === this.urdf &&
          sameMeshes(recording.meshes, before.meshes) &&
          recording.frames.size === before.frames.size &&
          [...recording.frames].every(([name, { parent }]) => {
            return before.frames.get(name)?.parent === parent;
          })));
    if (same && ghost === this.ghost) {
      this.recording = recording;
      return true;
    }
    return false;
  }
  /** Whether frames or meshes have come that it was not made with. */
  get outgrown(): boolean {
    const { frames, meshes, urdf } = this.recording;
    return frames.size >= this.frames.size || urdf !== this.urdf || meshes.size !== this.meshes;
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
    this.sortMarks();
    this.path?.show(t);
    for (const [key, track] of this.marks) {
      const at = indexAt(track.time, t);
      const mark = at < 0 ? null : (track.marks[at] as Mark | null);
      const before = this.shown.get(key);
      if (before !== undefined && mark !== null && alike(before.mark, mark)) {
        continue;
      }
      this.hide(key);
      const shape = mark === null ? undefined : markShape(mark, this.cut);
      if (mark !== null && shape !== undefined) {
        (this.frames.get(mark.frame) ?? this.root).add(shape);
        this.shown.set(key, { mark, shape });
      }
    }
  }
  private hide(key: string): void {
    const shape = this.shown.get(key)?.shape;
    if (shape !== undefined) {
      shape.removeFromParent();
      dispose(shape);
      this.shown.delete(key);
    }
  }
  /** The way is one line, the rest comes and goes; a ghost has its way alone. */
  private sortMarks(): void {
    const { marks } = this.recording;
    if (this.sorted === marks && this.sortedMarks === marks.size) {
      return;
    }
    this.sorted = marks;
    this.sortedMarks = marks.size;
    const pieces: Piece[] = [];
    this.marks = new Map();
    for (const [key, track] of marks) {
      const first = track.marks[0];
      if (first?.name === "path") {
        pieces.push({ time: track.time[0] as number, mark: first });
      } else if (!this.ghost) {
        this.marks.set(key, track);
      }
    }
    for (const key of [...this.shown.keys()].filter((key) => !this.marks.has(key))) {
      this.hide(key);
    }
    if (this.path !== undefined) {
      this.path.line.removeFromParent();
      dispose(this.path.line);
    }
    this.path = pieces.length > 0 ? new Path(pieces) : undefined;
    if (this.path !== undefined) {
      (this.frames.get(pieces[0]?.mark.frame ?? "") ?? this.root).add(this.path.line);
    }
  }
}

function sameMeshes(a: Map<string, Uint8Array>, b: Map<string, Uint8Array>): boolean {
  const same = (ours: Uint8Array, theirs: Uint8Array | undefined): boolean =>
    ours.length === theirs?.length && ours.every((byte, i) => byte === theirs[i]);
  return a.size === b.size && [...a].every(([name, bytes]) => same(bytes, b.get(name)));
}
