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

/** Takes a recording's records, in any order of channels, and makes a Recording of them. */
class Builder {
  private readonly readers = new Map<
    number,
    { topic: string; reader: MessageReader; take: Take }
  >();
  private readonly tables = new Map<string, TableBuilder>();
  private readonly schemas = new Map<number, McapTypes.TypedMcapRecords["Schema"]>();
  private last = 0;
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

  schema(schema: McapTypes.TypedMcapRecords["Schema"]): void {
    this.schemas.set(schema.id, schema);
  }
  channel(channel: McapTypes.TypedMcapRecords["Channel"]): void {
    const schema = this.schemas.get(channel.schemaId);
    if (
      this.readers.has(channel.id) || // the summary names all once more
      schema === undefined ||
      schema.encoding !== "ros2msg" ||
      channel.messageEncoding !== "cdr"
    ) {
      return;
    }
    const take = this.taker(channel.topic);
    if (take === undefined) {
      return;
    }
    const definition = parseDefinition(new TextDecoder().decode(schema.data), { ros2: true });
    this.readers.set(channel.id, {
      topic: channel.topic,
      reader: new MessageReader(definition),
      take,
    });
  }
  message(message: McapTypes.TypedMcapRecords["Message"]): void {
    const channel = this.readers.get(message.channelId);
    if (channel !== undefined) {
      const t = seconds(message.logTime);
      this.last = Math.max(this.last, t);
      channel.take(t, channel.reader.readMessage(message.data));
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
  finish(): Recording {
    for (const [topic, builder] of this.tables) {
      this.recording.tables.set(topic, builder.table());
    }
    this.recording.duration = this.last;
    this.recording.phases = phasesOf(this.recording.tables.get("/guidance"), this.last);
    if (this.recording.tables.size === 0) {
      throw new NotARecording(`${this.recording.name} holds no messages that this page reads`);
    }
    return this.recording;
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
        return (t, message) => builder.push(t, message);
      }
    }
  }
  private move(t: number, message: Transforms): void {
    for (const { header, child_frame_id, transform } of message.transforms) {
      let track = this.recording.frames.get(child_frame_id);
      if (track === undefined) {
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
  const reader = new McapStreamReader({ decompressHandlers });
  try {
    reader.append(bytes);
    for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
      switch (record.type) {
        case "Schema":
          builder.schema(record);
          break;
        case "Channel":
          builder.channel(record);
          break;
        case "Message":
          builder.message(record);
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
  return builder.finish();
}
