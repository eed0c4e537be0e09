// SPDX-License-Identifier: Apache-2.0
// A flight's recording as the page knows it: tables of numbers, where the frames are, marks, events.
import { parse as parseDefinition } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { McapStreamReader, type McapTypes } from "@mcap/core";
import { decompress } from "fzstd";
import { type Pose, Track } from "./poses";
import { Column, type Table } from "./series";

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
}

const kVehicle = "base_link";

export class NotARecording extends Error {}

interface Xyz {
  x: number;
  y: number;
  z: number;
}
interface Xyzw extends Xyz {
  w: number;
}
interface Header {
  frame_id: string;
}
interface Transforms {
  transforms: {
    header: Header;
    child_frame_id: string;
    transform: { translation: Xyz; rotation: Xyzw };
  }[];
}
interface Posed {
  pose: { position: Xyz; orientation: Xyzw };
}
interface Markers {
  markers: {
    header: Header;
    ns: string;
    id: number;
    type: number;
    action: number;
    pose: { position: Xyz; orientation: Xyzw };
    scale: Xyz;
    color: { r: number; g: number; b: number; a: number };
    points: Xyz[];
  }[];
}
interface EventMessage {
  station: string;
  name: string;
  reason: string;
  value_names: string[];
  values: Float64Array;
}

const seconds = (ns: bigint): number => Number(ns) * 1e-9;
const pose = (p: Xyz, q: Xyzw): Pose => [p.x, p.y, p.z, q.x, q.y, q.z, q.w];

/** Columns that are filled from messages of plain numbers and texts. */
class TableBuilder {
  private readonly time = new Column();
  private readonly columns = new Map<string, Column>();
  private readonly texts = new Map<string, string[]>();

  constructor(private readonly topic: string) {}

  push(t: number, message: unknown): void {
    this.time.push(t);
    this.take("", message);
  }
  private take(path: string, value: unknown): void {
    if (typeof value === "number" || typeof value === "boolean") {
      let column = this.columns.get(path);
      if (column === undefined) {
        column = new Column();
        this.columns.set(path, column);
      }
      column.push(Number(value));
    } else if (typeof value === "string") {
      const texts = this.texts.get(path) ?? [];
      texts.push(value);
      this.texts.set(path, texts);
    } else if (ArrayBuffer.isView(value) || Array.isArray(value)) {
      const all = value as unknown as ArrayLike<unknown>;
      for (let i = 0; i < all.length; ++i) {
        this.take(`${path}[${i}]`, all[i]);
      }
    } else if (typeof value === "object" && value !== null) {
      for (const [name, part] of Object.entries(value)) {
        if (name !== "header" && name !== "stamp") {
          this.take(path === "" ? name : `${path}.${name}`, part);
        }
      }
    }
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

type Take = (t: number, message: unknown) => void;

/** What a channel's messages are; of others than ROS 2's nothing is taken. */
export interface ChannelOf {
  id: number;
  topic: string;
  encoding: string;
  schemaEncoding: string;
  schema: string;
}

/** Takes channels and messages, in any order of channels, and makes a Recording of them. */
export class Builder {
  private readonly readers = new Map<number, { reader: MessageReader; take: Take }>();
  private readonly tables = new Map<string, TableBuilder>();
  private readonly estimated = new Track("map"); // where the vehicle believes to be
  readonly recording: Recording;

  constructor(
    name: string,
    private readonly columns: Set<string>,
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
    };
  }

  /** @returns whether its messages are wanted */
  channel({ id, topic, encoding, schemaEncoding, schema }: ChannelOf): boolean {
    if (this.readers.has(id)) {
      return true; // a file's summary names all once more
    }
    const take = encoding === "cdr" && schemaEncoding === "ros2msg" ? this.taker(topic) : undefined;
    if (take !== undefined) {
      const reader = new MessageReader(parseDefinition(schema, { ros2: true }));
      this.readers.set(id, { reader, take });
    }
    return take !== undefined;
  }
  message(channel: number, time_ns: bigint, data: Uint8Array): void {
    const of = this.readers.get(channel);
    if (of !== undefined) {
      const t = seconds(time_ns);
      this.recording.duration = Math.max(this.recording.duration, t);
      of.take(t, of.reader.readMessage(data));
    }
  }
  attachment(name: string, data: Uint8Array): void {
    if (name.toLowerCase().endsWith(".stl")) {
      this.recording.meshes.set(name, data);
    } else if (name === "summary.json") {
      const summary: unknown = JSON.parse(new TextDecoder().decode(data));
      this.recording.outcome = String((summary as { outcome?: unknown }).outcome ?? "");
    }
  }
  metadata(name: string, values: Map<string, string>): void {
    if (name === "limpet") {
      this.recording.scenario = values.get("scenario") ?? "";
    }
  }
  /** Tables and phases as far as messages have come. */
  tell(): Recording {
    const { recording } = this;
    for (const [topic, builder] of this.tables) {
      recording.tables.set(topic, builder.table());
    }
    recording.phases = phasesOf(recording.tables.get("/guidance"), recording.duration);
    // A companion knows no truth: its vehicle is where it is estimated.
    if (this.estimated.time.length > 0 && !recording.frames.has(kVehicle)) {
      recording.frames.set(kVehicle, this.estimated);
    }
    return recording;
  }

  private taker(topic: string): Take | undefined {
    switch (topic) {
      case "/robot_description":
        return (_t, message) => {
          this.recording.urdf = (message as { data: string }).data;
        };
      case "/tf":
      case "/tf_static":
        return (t, message) => this.move(t, message as Transforms);
      case "/scene":
        return (t, message) => this.mark(t, message as Markers);
      case "/events":
        return (t, message) => this.event(t, message as EventMessage);
      default: {
        if (!this.columns.has(topic)) {
          return undefined;
        }
        const builder = new TableBuilder(topic);
        this.tables.set(topic, builder);
        return topic === "/estimate/pose"
          ? (t, message) => {
              builder.push(t, message);
              const { position, orientation } = (message as Posed).pose;
              this.estimated.push(t, pose(position, orientation));
            }
          : (t, message) => builder.push(t, message);
      }
    }
  }
  private move(t: number, message: Transforms): void {
    for (const { header, child_frame_id, transform } of message.transforms) {
      let track = this.recording.frames.get(child_frame_id);
      if (track === undefined || track === this.estimated) {
        track = new Track(header.frame_id);
        this.recording.frames.set(child_frame_id, track);
      }
      track.push(t, pose(transform.translation, transform.rotation));
    }
  }
  private mark(t: number, message: Markers): void {
    const kDelete = 2;
    for (const marker of message.markers) {
      const key = `${marker.ns} ${marker.id}`;
      const track = this.recording.marks.get(key) ?? { time: [], marks: [] };
      this.recording.marks.set(key, track);
      track.time.push(t);
      track.marks.push(
        marker.action === kDelete
          ? null
          : {
              frame: marker.header.frame_id,
              name: marker.ns,
              type: marker.type,
              pose: pose(marker.pose.position, marker.pose.orientation),
              scale: [marker.scale.x, marker.scale.y, marker.scale.z],
              colour: [marker.color.r, marker.color.g, marker.color.b, marker.color.a],
              points: marker.points.map((p) => [p.x, p.y, p.z]),
            },
      );
    }
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

const decompressHandlers = {
  zstd: (bytes: Uint8Array, size: bigint) => decompress(bytes, new Uint8Array(Number(size))),
};

/**
 * @param bytes    of an MCAP file, whole or as far as it was written
 * @param columns  topics whose numbers are wanted; frames, marks and events always are
 * @throws NotARecording
 */
export function readRecording(name: string, bytes: Uint8Array, columns: Set<string>): Recording {
  const builder = new Builder(name, columns);
  const schemas = new Map<number, McapTypes.TypedMcapRecords["Schema"]>();
  const reader = new McapStreamReader({ decompressHandlers });
  try {
    reader.append(bytes);
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
      switch (record.type) {
        case "Schema":
          schemas.set(record.id, record);
          break;
        case "Channel": {
          const schema = schemas.get(record.schemaId);
          builder.channel({
            id: record.id,
            topic: record.topic,
            encoding: record.messageEncoding,
            schemaEncoding: schema?.encoding ?? "",
            schema: new TextDecoder().decode(schema?.data),
          });
          break;
        }
        case "Message":
          builder.message(record.channelId, record.logTime, record.data);
          break;
        case "Attachment":
          builder.attachment(record.name, record.data);
          break;
        case "Metadata":
          builder.metadata(record.name, record.metadata);
          break;
      }
    }
  } catch (problem) {
    throw new NotARecording(`${name} is not an MCAP recording: ${String(problem)}`);
  }
  const recording = builder.tell();
  if (recording.tables.size === 0) {
    throw new NotARecording(`${name} holds no messages that this page reads`);
  }
  return recording;
}
