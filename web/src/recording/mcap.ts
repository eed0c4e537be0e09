// SPDX-License-Identifier: Apache-2.0
// The MCAP container, as far as a page needs it, without a copy of what is in it: @mcap/core copies each
// message, and a page took longer for that than for all else (tests hold what is read here against it).
// Source: https://mcap.dev/spec
import { crc32 } from "@foxglove/crc";
import { decompress } from "fzstd";

export interface Channel {
  id: number;
  topic: string;
  encoding: string;
  schemaEncoding: string;
  schema: string;
}
export interface McapTaker {
  /** A file's summary names each once more. */
  channel(channel: Channel): void;
  /** @param bytes  a view of what is read */
  message(channel: number, time_s: number, bytes: Uint8Array): void;
  attachment(name: string, bytes: Uint8Array): void;
  metadata(name: string, values: Map<string, string>): void;
}

const kMagic = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];
const kRecordHead = 9; // kind, length
const kMessageHead = 22; // channel, sequence, two times
enum Kind {
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  attachment = 9,
  metadata = 12,
}
const kText = new TextDecoder();

/** Little endian, exact up to 2^53. */
const wide = (view: DataView, at: number): number =>
  view.getUint32(at, true) + 2 ** 32 * view.getUint32(at + 4, true);
/** @returns nanoseconds there in seconds */
export const secondsAt = (view: DataView, at: number): number => 1e-9 * wide(view, at);
/** First times from here on are a clock's and count from the first message (limpet/core/clock_origin.hpp). */
const kClockBegins_s = 1e5;

/** The fields of a record, in their order. */
class Fields {
  private at = 0;
  private readonly view: DataView;

  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }
  u16(): number {
    this.at += 2;
    return this.view.getUint16(this.at - 2, true);
  }
  u32(): number {
    this.at += 4;
    return this.view.getUint32(this.at - 4, true);
  }
  u64(): number {
    this.at += 8;
    return wide(this.view, this.at - 8);
  }
  take(length: number): Uint8Array {
    if (length > this.bytes.length - this.at) {
      throw new Error("a record ends within a field");
    }
    this.at += length;
    return this.bytes.subarray(this.at - length, this.at);
  }
  text(): string {
    return kText.decode(this.take(this.u32()));
  }
  map(): Map<string, string> {
    const all = new Map<string, string>();
    const end = this.u32() + this.at;
    while (this.at < end) {
      all.set(this.text(), this.text());
    }
    return all;
  }
  get before(): Uint8Array {
    return this.bytes.subarray(0, this.at);
  }
}

class Reader {
  private readonly schemas = new Map<number, { encoding: string; text: string }>();
  private origin_s: number | undefined;

  constructor(private readonly taker: McapTaker) {}

  /** All whole records of it. */
  records(bytes: Uint8Array, from: number): void {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    for (let at = from; at + kRecordHead <= bytes.length; ) {
      const kind = bytes[at] as number;
      const begin = at + kRecordHead;
      const end = begin + wide(view, at + 1);
      if (end > bytes.length) {
        return; // of a run that died
      }
      if (kind !== Kind.message) {
        this.record(kind, bytes.subarray(begin, end));
      } else if (end - begin >= kMessageHead) {
        const body = bytes.subarray(begin + kMessageHead, end);
        const time_s = secondsAt(view, begin + 6);
        this.origin_s ??= time_s >= kClockBegins_s ? time_s : 0;
        this.taker.message(view.getUint16(begin, true), time_s - this.origin_s, body);
      }
      at = end;
    }
  }
  private record(kind: number, bytes: Uint8Array): void {
    const fields = new Fields(bytes);
    switch (kind) {
      case Kind.schema: {
        const [id, , encoding, text] = [fields.u16(), fields.text(), fields.text(), fields.text()];
        this.schemas.set(id, { encoding, text });
        break;
      }
      case Kind.channel: {
        const [id, schema] = [fields.u16(), this.schemas.get(fields.u16())];
        const [topic, encoding] = [fields.text(), fields.text()];
        const { encoding: schemaEncoding, text } = schema ?? { encoding: "", text: "" };
        this.taker.channel({ id, topic, encoding, schemaEncoding, schema: text });
        break;
      }
      case Kind.chunk:
        this.chunk(fields);
        break;
      case Kind.attachment: {
        fields.take(16); // times
        const [name] = [fields.text(), fields.text()];
        const data = fields.take(fields.u64());
        intact(fields.before, fields.u32(), `attachment ${name}`);
        this.taker.attachment(name, data);
        break;
      }
      case Kind.metadata:
        this.taker.metadata(fields.text(), fields.map());
        break;
    }
  }
  private chunk(fields: Fields): void {
    fields.take(16); // times
    const size = fields.u64();
    const crc = fields.u32();
    const compression = fields.text();
    const stored = fields.take(fields.u64());
    if (compression !== "" && compression !== "zstd") {
      throw new Error(`it is compressed by ${compression}, which is not read here`);
    }
    const records = compression === "" ? stored : decompress(stored, new Uint8Array(size));
    intact(records, crc, "a chunk");
    this.records(records, 0);
  }
}

function intact(bytes: Uint8Array, crc: number, what: string): void {
  if (crc !== 0 && crc32(bytes) !== crc) {
    throw new Error(`${what} is damaged`);
  }
}

/**
 * @param bytes  of a file, whole or as far as it was written
 * @throws Error where it is none, or damaged
 */
export function readMcap(bytes: Uint8Array, taker: McapTaker): void {
  if (kMagic.some((byte, i) => bytes[i] !== byte)) {
    throw new Error("it does not begin as one");
  }
  new Reader(taker).records(bytes, kMagic.length);
}
