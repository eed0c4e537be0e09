// SPDX-License-Identifier: Apache-2.0
// Messages of one channel are alike: where the numbers of one are found stand those of the next, too. Taken
// apart by the definition anew (MessageReader) a whole recording took some 0.5 s of a page's time.
import type { parse } from "@foxglove/rosmsg";

export type Definitions = ReturnType<typeof parse>;
type Field = Definitions[number]["definitions"][number];

/** Reads a number at a place of a message. */
export type Spot = (view: DataView) => number;
type Get = (view: DataView, at: number, little: boolean) => number;

const kSizes = new Map<string, [number, Get]>([
  ["bool", [1, (view, at) => view.getUint8(at)]],
  ["int8", [1, (view, at) => view.getInt8(at)]],
  ["uint8", [1, (view, at) => view.getUint8(at)]],
  ["int16", [2, (view, at, little) => view.getInt16(at, little)]],
  ["uint16", [2, (view, at, little) => view.getUint16(at, little)]],
  ["int32", [4, (view, at, little) => view.getInt32(at, little)]],
  ["uint32", [4, (view, at, little) => view.getUint32(at, little)]],
  ["int64", [8, (view, at, little) => Number(view.getBigInt64(at, little))]],
  ["uint64", [8, (view, at, little) => Number(view.getBigUint64(at, little))]],
  ["float32", [4, (view, at, little) => view.getFloat32(at, little)]],
  ["float64", [8, (view, at, little) => view.getFloat64(at, little)]],
]);
const kHead = 4; // bytes before a message, from which its fields are aligned
const kDecoder = new TextDecoder();

/** What all messages with the same texts and counts have in common. */
export interface Shape {
  /** By path: "pose.position.x", "points[2].y". */
  numbers: Map<string, Spot>;
  texts: Map<string, string>;
  counts: Map<string, number>;
  /** Where texts and counts stand, and what they are: begin, and bytes. */
  same: [number, Uint8Array][];
}

/** Takes a message in plain CDR apart. */
class Walk {
  readonly shape: Shape = { numbers: new Map(), texts: new Map(), counts: new Map(), same: [] };
  private at = kHead;
  private readonly view: DataView;
  private readonly little: boolean;

  constructor(
    private readonly bytes: Uint8Array,
    private readonly types: Map<string, Field[]>,
  ) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const kind = this.view.getUint8(1);
    if (kind > 1) {
      throw new Error(`messages encoded as ${kind} are not read here, plain CDR is`);
    }
    this.little = kind === 1;
    this.hold(0, kHead);
  }
  fields(path: string, fields: Field[]): void {
    const before = path === "" ? "" : `${path}.`;
    for (const field of fields.filter(({ isConstant }) => isConstant !== true)) {
      const name = before + field.name;
      if (field.isArray !== true) {
        this.one(name, field);
        continue;
      }
      const count = field.arrayLength ?? this.count();
      this.shape.counts.set(name, count);
      for (let i = 0; i < count; ++i) {
        this.one(`${name}[${i}]`, field);
      }
    }
  }
  private one(path: string, field: Field): void {
    const size = kSizes.get(field.type);
    if (field.isComplex === true) {
      const fields = this.types.get(field.type);
      if (fields === undefined) {
        throw new Error(`${path}: there is no definition of ${field.type}`);
      }
      // ROS 2 gives a message without fields a byte.
      const blank = fields.every(({ isConstant }) => isConstant === true);
      if (blank && this.skip(1) >= this.bytes.length) {
        throw new Error(`${path}: the message ends before it`);
      }
      this.fields(path, fields);
    } else if (size !== undefined) {
      const [bytes, get] = size;
      const { little } = this;
      const at = this.skip(bytes);
      if (at + bytes > this.bytes.length) {
        throw new Error(`${path}: the message ends before it`);
      }
      this.shape.numbers.set(path, (view) => get(view, at, little));
    } else if (field.type === "string") {
      const length = this.count();
      const text = this.hold(this.at, length);
      this.at += length;
      this.shape.texts.set(path, kDecoder.decode(text.subarray(0, Math.max(0, length - 1))));
    } else if (field.type === "time" || field.type === "duration") {
      this.skip(4);
      this.skip(4);
    } else {
      throw new Error(`${path}: ${field.type} is not read here`);
    }
  }
  /** @returns where a number of that size stands */
  private skip(size: number): number {
    const at = this.at + ((size - ((this.at - kHead) % size)) % size);
    this.at = at + size;
    return at;
  }
  private count(): number {
    const at = this.skip(4);
    this.hold(at, 4);
    return this.view.getUint32(at, this.little);
  }
  private hold(at: number, length: number): Uint8Array {
    if (at + length > this.bytes.length) {
      throw new Error("the message ends within a text");
    }
    const bytes = this.bytes.slice(at, at + length);
    this.shape.same.push([at, bytes]);
    return bytes;
  }
}

function fits({ same }: Shape, bytes: Uint8Array): boolean {
  for (const [from, wanted] of same) {
    for (let i = 0; i < wanted.length; ++i) {
      if (bytes[from + i] !== wanted[i]) {
        return false;
      }
    }
  }
  return true;
}

/** Takes a message [s] whose shape is known. */
export type TakeShaped = (t: number, view: DataView) => void;
interface Known {
  shape: Shape;
  length: number;
  take: TakeShaped;
}

/** The messages of a channel, by their few shapes. */
export class Shapes {
  private readonly root: Field[];
  private readonly types: Map<string, Field[]>;
  private readonly known: Known[] = [];

  /** @param plan  what is done with messages of a shape, once for each */
  constructor(
    definitions: Definitions,
    private readonly plan: (shape: Shape) => TakeShaped,
  ) {
    this.root = definitions[0]?.definitions ?? [];
    this.types = new Map(definitions.map(({ name, definitions }) => [name ?? "", definitions]));
  }
  /** @throws Error where it does not fit its definition */
  take(t: number, bytes: Uint8Array): void {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const at = this.known.findIndex(
      ({ shape, length }) => length === bytes.length && fits(shape, bytes),
    );
    const found = at < 0 ? this.learn(bytes) : (this.known[at] as Known);
    if (at > 0) {
      this.known.splice(at, 1);
      this.known.unshift(found);
    }
    found.take(t, view);
  }
  private learn(bytes: Uint8Array): Known {
    const walk = new Walk(bytes, this.types);
    walk.fields("", this.root);
    const made = { shape: walk.shape, length: bytes.length, take: this.plan(walk.shape) };
    const kMost = 16;
    this.known.unshift(made);
    this.known.splice(kMost);
    return made;
  }
}
