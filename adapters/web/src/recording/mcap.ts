// SPDX-License-Identifier: Apache-2.0
// The MCAP container, as far as a page needs it, without a copy of what is in it: @mcap/core copies each
// message, and a page took longer for that than for all else (tests hold what is read here against it).
// Source: https://mcap.dev/spec
import { crc32 } from "@foxglove/crc";
import { decompress } from "fzstd";
import { kLz4Magic, unpackLz4 } from "./lz4";

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
  /** A record that is passed over, what is in it too. */
  damaged(why: string): void;
}

const kMagic = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];
const kRecordHead = 9; // kind, length
const kMessageHead = 22; // channel, sequence, two times
const kMostChunk = 2 ** 28;
const kZstdMagic = 0xfd2fb528;
/** What a file may become: as limpet/mcap/reader.cpp has it. */
const allowance = (bytes: number): number => Math.min(256e6 + 100 * bytes, 4e9);
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
/** First times from here on are a clock's and count from the first message (limpet/core/time.hpp). */
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

  constructor(
    private readonly taker: McapTaker,
    private left: number, // bytes that may yet be unpacked
  ) {}

  /** All whole records of it; one that is damaged costs what is in it. */
  records(bytes: Uint8Array, from: number): void {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    for (let at = from; at + kRecordHead <= bytes.length; ) {
      const kind = bytes[at] as number;
      const begin = at + kRecordHead;
      const end = begin + wide(view, at + 1);
      if (end > bytes.length) {
        return; // of a run that died
      }
      try {
        if (kind !== Kind.message) {
          this.record(kind, bytes.subarray(begin, end));
        } else if (end - begin >= kMessageHead) {
          const body = bytes.subarray(begin + kMessageHead, end);
          const time_s = secondsAt(view, begin + 6);
          this.origin_s ??= time_s >= kClockBegins_s ? time_s : 0;
          this.taker.message(view.getUint16(begin, true), time_s - this.origin_s, body);
        }
      } catch (problem) {
        this.taker.damaged(problem instanceof Error ? problem.message : String(problem));
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
    const records = compression === "" ? stored : this.unpack(compression, stored, size);
    intact(records, crc, "a chunk");
    this.records(records, 0);
  }
  private unpack(compression: string, stored: Uint8Array, size: number): Uint8Array {
    if (size > kMostChunk) {
      throw new Error("a chunk is larger than 256 MiB");
    }
    if (size > this.left) {
      throw new Error("it unpacks to more than a recording of its size does");
    }
    this.left -= size;
    switch (compression) {
      case "zstd":
        return decompress(stored, new Uint8Array(size));
      case "lz4":
        return unpackLz4(stored, size, size);
    }
    throw new Error(`a chunk is compressed by ${compression}, which is not read here`);
  }
}

/** A file that is packed as a whole, .mcap.zstd or .mcap.lz4, unpacked. */
function unpacked(bytes: Uint8Array): Uint8Array {
  const kGuess = 4;
  const magic =
    bytes.length < 4 ? 0 : new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  return magic === kZstdMagic
    ? decompress(bytes)
    : magic === kLz4Magic
      ? unpackLz4(bytes, kGuess * bytes.length, Math.min(allowance(bytes.length), 1e9))
      : bytes;
}

function intact(bytes: Uint8Array, crc: number, what: string): void {
  if (crc !== 0 && crc32(bytes) !== crc) {
    throw new Error(`${what} is damaged`);
  }
}

/**
 * @param packed  bytes of a file, whole or as far as it was written
 * @throws Error where it is none
 */
export function readMcap(packed: Uint8Array, taker: McapTaker): void {
  const bytes = unpacked(packed);
  if (kMagic.some((byte, i) => bytes[i] !== byte)) {
    throw new Error("it does not begin as one");
  }
  new Reader(taker, allowance(packed.length)).records(bytes, kMagic.length);
}
