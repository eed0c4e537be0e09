// SPDX-License-Identifier: Apache-2.0
// A flight's recording as the page knows it: tables of numbers, where the frames are, marks, events.
import { parse as parseDefinition } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { type Channel, type McapTaker, readMcap } from "./mcap";
import { type Pose, Track } from "./poses";
import { Column, type Table } from "./series";
import { type Definitions, type Shape, Shapes, type Spot, type TakeShaped } from "./shape";

export interface FlightEvent {
  time: number;
  station: string;
  name: string;
  reason: string;
  values: [string, number][];
}

/** A stretch of time in which guidance was in one state. */
export interface Phase {
  from: number;
  to: number;
  name: string;
}

/** A mark as visualization_msgs/Marker has it. */
export interface Mark {
  frame: string;
  name: string;
  type: number;
  pose: Pose;
  scale: [number, number, number];
  colour: [number, number, number, number];
  points: [number, number, number][];
}

/** A mark over time; null where it is not there. */
export interface MarkTrack {
  time: number[];
  marks: (Mark | null)[];
}

export interface Recording {
  name: string;
  scenario: string;
  outcome: string;
  duration: number;
  urdf: string;
  meshes: Map<string, Uint8Array>;
  frames: Map<string, Track>;
  marks: Map<string, MarkTrack>;
  events: FlightEvent[];
  phases: Phase[];
  tables: Map<string, Table>;
  /** What is missing of it, in a sentence; empty where it is whole. */
  damage: string;
}

/** Without which there is nothing to see. */
export const kSceneTopics = ["/robot_description", "/tf", "/tf_static", "/scene", "/events"];
const kVehicle = "base_link";

export class NotARecording extends Error {}

interface EventMessage {
  station: string;
  name: string;
  reason: string;
  value_names: string[];
  values: Float64Array;
}

const kNothing: Spot = () => 0;
/** Of a vector, a quaternion, a colour: its numbers by their names. */
const spotsOf = ({ numbers }: Shape, path: string, names: string): Spot[] =>
  [...names].map((name) => numbers.get(`${path}.${name}`) ?? kNothing);
/** @returns where p and q of it stand */
function poseOf(shape: Shape, p: string, q: string): (view: DataView) => Pose {
  const spots = [...spotsOf(shape, p, "xyz"), ...spotsOf(shape, q, "xyzw")];
  return (view) => spots.map((spot) => spot(view)) as Pose;
}

/** Columns that are filled from messages of plain numbers and texts. */
class TableBuilder {
  private readonly time = new Column();
  private readonly columns = new Map<string, Column>();
  private readonly texts = new Map<string, string[]>();

  /** @param wanted  columns; none: all of them */
  constructor(
    private readonly topic: string,
    private readonly wanted: readonly string[],
  ) {}

  plan({ numbers, texts }: Shape): TakeShaped {
    const columns: [Spot, Column][] = [];
    for (const [path, spot] of numbers) {
      if (this.wanted.length === 0 || this.wanted.includes(path)) {
        const column = this.columns.get(path) ?? new Column();
        this.columns.set(path, column);
        columns.push([spot, column]);
      }
    }
    const lists = [...texts]
      .filter(([path]) => !path.startsWith("header."))
      .map(([path, text]): [string, string[]] => {
        const list = this.texts.get(path) ?? [];
        this.texts.set(path, list);
        return [text, list];
      });
    return (t, view) => {
      this.time.push(t);
      for (const [spot, column] of columns) {
        column.push(spot(view));
      }
      for (const [text, list] of lists) {
        list.push(text);
      }
    };
  }
  table(): Table {
    const length = this.time.values.length;
    const columns = new Map<string, Float64Array>();
    for (const [name, column] of this.columns) {
      if (column.values.length === length) {
        columns.set(name, column.values);
      }
    }
    return { topic: this.topic, time: this.time.values, columns, texts: this.texts };
  }
}

/** Which columns of which topics; none: all of a topic's. */
export type Wanted = ReadonlyMap<string, readonly string[]>;
type Take = (t: number, bytes: Uint8Array) => void;

/** Takes channels and messages, in any order of channels, and makes a Recording of them. */
export class Builder implements McapTaker {
  private readonly takers = new Map<number, Take>();
  private readonly tables = new Map<string, TableBuilder>();
  private readonly estimated = new Track("map"); // the estimated pose of the vehicle
  private damages = 0;
  private firstDamage = "";
  readonly recording: Recording;

  constructor(
    name: string,
    private readonly columns: Wanted,
  ) {
    this.recording = {
      name,
      scenario: "",
      outcome: "",
      duration: 0,
      urdf: "",
      meshes: new Map(),
      frames: new Map(),
      marks: new Map(),
      events: [],
      phases: [],
      tables: new Map(),
      damage: "",
    };
  }

  damaged(why: string): void {
    this.damages += 1;
    this.firstDamage ||= why;
  }

  /** @returns whether its messages are wanted */
  channel({ id, topic, encoding, schemaEncoding, schema }: Channel): boolean {
    if (this.takers.has(id)) {
      return true; // a file's summary names all once more
    }
    const take =
      encoding === "cdr" && schemaEncoding === "ros2msg"
        ? this.taker(topic, parseDefinition(schema, { ros2: true }))
        : undefined;
    if (take !== undefined) {
      this.takers.set(id, take);
    }
    return take !== undefined;
  }
  message(channel: number, t: number, data: Uint8Array): void {
    const take = this.takers.get(channel);
    if (take !== undefined) {
      this.recording.duration = Math.max(this.recording.duration, t);
      take(t, data);
    }
  }
  attachment(name: string, data: Uint8Array): void {
    if (name.toLowerCase().endsWith(".stl")) {
      this.recording.meshes.set(name, data);
    } else if (name === "summary.json") {
      const summary = JSON.parse(new TextDecoder().decode(data)) as Record<string, unknown>;
      const outcome = String(summary.outcome ?? "");
      this.recording.outcome =
        summary.borne_out === false ? `${outcome}, in truth ${String(summary.true_end)}` : outcome;
    }
  }
  metadata(name: string, values: Map<string, string>): void {
    if (name === "limpet") {
      this.recording.scenario = values.get("scenario") ?? "";
    }
  }
  /** Tables and phases as far as messages have come. */
  built(): Recording {
    const { recording } = this;
    for (const [topic, builder] of this.tables) {
      recording.tables.set(topic, builder.table());
    }
    recording.damage =
      this.damages > 0 ? `${this.damages} damaged and left out, first: ${this.firstDamage}` : "";
    recording.phases = phasesOf(recording.tables.get("/guidance"), recording.duration);
    // A companion knows no truth: its vehicle is where it is estimated.
    if (this.estimated.time.length > 0 && !recording.frames.has(kVehicle)) {
      recording.frames.set(kVehicle, this.estimated);
    }
    return recording;
  }

  private taker(topic: string, definitions: Definitions): Take | undefined {
    const whole = <T>(of: (t: number, message: T) => void): Take => {
      const reader = new MessageReader<T>(definitions);
      return (t, bytes) => of(t, reader.readMessage(bytes));
    };
    const shaped = (plan: (shape: Shape) => TakeShaped): Take => {
      const shapes = new Shapes(definitions, plan);
      return (t, bytes) => shapes.take(t, bytes);
    };
    switch (topic) {
      case "/robot_description":
        return whole<{ data: string }>((_t, { data }) => {
          this.recording.urdf = data;
        });
      case "/events":
        return whole<EventMessage>((t, message) => this.event(t, message));
      case "/tf":
      case "/tf_static":
        return shaped((shape) => this.moves(shape));
      case "/scene":
        return shaped((shape) => this.marks(shape));
      default: {
        const wanted = this.columns.get(topic);
        if (wanted === undefined) {
          return undefined;
        }
        const builder = new TableBuilder(topic, wanted);
        this.tables.set(topic, builder);
        return shaped((shape) => {
          const take = builder.plan(shape);
          return topic === "/estimate/pose" ? this.alsoEstimated(shape, take) : take;
        });
      }
    }
  }
  private alsoEstimated(shape: Shape, take: TakeShaped): TakeShaped {
    const pose = poseOf(shape, "pose.position", "pose.orientation");
    return (t, view) => {
      take(t, view);
      this.estimated.push(t, pose(view));
    };
  }
  private moves(shape: Shape): TakeShaped {
    const all = Array.from({ length: shape.counts.get("transforms") ?? 0 }, (_, i) => {
      const path = `transforms[${i}]`;
      return {
        track: this.trackOf(
          shape.texts.get(`${path}.header.frame_id`) ?? "",
          shape.texts.get(`${path}.child_frame_id`) ?? "",
        ),
        pose: poseOf(shape, `${path}.transform.translation`, `${path}.transform.rotation`),
      };
    });
    return (t, view) => {
      for (const { track, pose } of all) {
        track.push(t, pose(view));
      }
    };
  }
  private trackOf(parent: string, child: string): Track {
    const { frames } = this.recording;
    const known = frames.get(child);
    if (known !== undefined && known !== this.estimated) {
      return known;
    }
    const track = new Track(parent);
    frames.set(child, track);
    return track;
  }
  private marks(shape: Shape): TakeShaped {
    const all = Array.from({ length: shape.counts.get("markers") ?? 0 }, (_, i) =>
      markerOf(shape, `markers[${i}]`),
    );
    return (t, view) => {
      for (const marker of all) {
        const key = `${marker.name} ${marker.id(view)}`;
        const track = this.recording.marks.get(key) ?? { time: [], marks: [] };
        this.recording.marks.set(key, track);
        track.time.push(t);
        track.marks.push(marker.mark(view));
      }
    };
  }
  private event(t: number, message: EventMessage): void {
    this.recording.events.push({
      time: t,
      station: message.station,
      name: message.name,
      reason: message.reason,
      values: message.value_names.map((name, i) => [name, message.values[i] as number]),
    });
  }
}

/** One of a message's markers, as all of its shape are. */
function markerOf(
  shape: Shape,
  path: string,
): { name: string; id: Spot; mark(view: DataView): Mark | null } {
  const kDelete = 2;
  const [id, type, action] = ["id", "type", "action"].map(
    (name) => shape.numbers.get(`${path}.${name}`) ?? kNothing,
  ) as [Spot, Spot, Spot];
  const pose = poseOf(shape, `${path}.pose.position`, `${path}.pose.orientation`);
  const scale = spotsOf(shape, `${path}.scale`, "xyz");
  const colour = spotsOf(shape, `${path}.color`, "rgba");
  const points = Array.from({ length: shape.counts.get(`${path}.points`) ?? 0 }, (_, i) =>
    spotsOf(shape, `${path}.points[${i}]`, "xyz"),
  );
  const name = shape.texts.get(`${path}.ns`) ?? "";
  const frame = shape.texts.get(`${path}.header.frame_id`) ?? "";
  const read = (view: DataView, spots: Spot[]): number[] => spots.map((spot) => spot(view));
  return {
    name,
    id,
    mark: (view) =>
      action(view) === kDelete
        ? null
        : {
            frame,
            name,
            type: type(view),
            pose: pose(view),
            scale: read(view, scale) as Mark["scale"],
            colour: read(view, colour) as Mark["colour"],
            points: points.map((point) => read(view, point) as [number, number, number]),
          },
  };
}

function phasesOf(guidance: Table | undefined, end: number): Phase[] {
  const states = guidance?.texts.get("state") ?? [];
  const phases: Phase[] = [];
  states.forEach((name, i) => {
    const from = guidance?.time[i] as number;
    const last = phases.at(-1);
    if (last?.name !== name) {
      if (last !== undefined) {
        last.to = from;
      }
      phases.push({ from, to: end, name });
    }
  });
  return phases;
}

/**
 * @param bytes    of an MCAP file, whole or as far as it was written
 * @param columns  numbers that are wanted; frames, marks and events always are
 * @throws NotARecording
 */
export function readRecording(name: string, bytes: Uint8Array, columns: Wanted): Recording {
  const builder = new Builder(name, columns);
  try {
    readMcap(bytes, builder);
  } catch (problem) {
    throw new NotARecording(`${name} is not an MCAP recording: ${String(problem)}`);
  }
  const recording = builder.built();
  if (recording.tables.size === 0) {
    throw new NotARecording(`${name} holds no messages that this page reads`);
  }
  return recording;
}
