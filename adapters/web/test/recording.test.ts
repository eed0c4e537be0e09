// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import { McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
import { unpackLz4 } from "../src/recording/lz4";
import { Track } from "../src/recording/poses";
import { NotARecording, readRecording } from "../src/recording/recording";
import { between, indexAt, valueAt } from "../src/recording/series";
import { Shapes } from "../src/recording/shape";

test("indexAt finds what holds at a time", () => {
  assert.equal(indexAt([0, 1, 2], -0.1), -1);
  assert.equal(indexAt([0, 1, 2], 0), 0);
  assert.equal(indexAt([0, 1, 2], 1.9), 1);
  assert.equal(indexAt([0, 1, 1, 2], 1), 2);
  assert.equal(indexAt([], 1), -1);
  assert.equal(valueAt([0, 1], [5, 6], 0.5), 5);
  assert.equal(valueAt([0, 1], [5, 6], -0.5), undefined);
});

test("between samples lies the straight line, beyond them nothing", () => {
  const [time, values] = [
    [0, 1, 3],
    [2, 4, 0],
  ];
  assert.deepEqual(
    [0, 0.5, 1, 2, 3].map((t) => between(time, values, t)),
    [2, 3, 4, 2, 0],
  );
  assert.ok([-0.1, 3.1].every((t) => Number.isNaN(between(time, values, t))));
});

test("a track goes straight between its samples, the short way round", () => {
  const track = new Track("map");
  track.push(0, [0, 0, 0, 0, 0, 0, 1]);
  track.push(1, [2, 0, 0, 0, 0, -Math.SQRT1_2, -Math.SQRT1_2]); // a quarter about z, other sign
  const middle = track.at(0.5);
  assert.equal(middle[0], 1);
  assert.ok(Math.abs(middle[5] - Math.sin(Math.PI / 8)) < 1e-12, String(middle));
  assert.deepEqual(track.at(-1).slice(0, 3), [0, 0, 0]);
  assert.deepEqual(track.at(9).slice(0, 3), [2, 0, 0]);
});

test("what is no recording is refused", () => {
  assert.throws(
    () => readRecording("x", new TextEncoder().encode("not a recording"), new Map()),
    NotARecording,
  );
});

test("messages are read by their shape as by their definition", () => {
  const line = "=".repeat(80);
  const definitions = parse(
    `std_msgs/Header header
string state
bool yes
float64[2] pair
float32[] few
int16 small
uint64 large
part/Part[] parts
${line}
MSG: part/Part
string name
float64 x
${line}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
${line}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec`,
    { ros2: true },
  );
  const writer = new MessageWriter(definitions);
  const seen: unknown[] = [];
  let learnt = 0;
  const shapes = new Shapes(definitions, ({ numbers, texts, counts }) => {
    learnt += 1;
    return (_t, view) => {
      const at = (path: string) => numbers.get(path)?.(view);
      seen.push({
        state: texts.get("state"),
        numbers: ["yes", "pair[0]", "pair[1]", "small", "large"].map(at),
        few: Array.from({ length: counts.get("few") ?? 0 }, (_, i) => at(`few[${i}]`)),
        parts: Array.from({ length: counts.get("parts") ?? 0 }, (_, i) => [
          texts.get(`parts[${i}].name`),
          at(`parts[${i}].x`),
        ]),
      });
    };
  });
  const messages = [
    { state: "go", few: [1.5], parts: [{ name: "a", x: 1 }] },
    { state: "no", few: [2.5], parts: [{ name: "b", x: 2 }] }, // as long, other texts
    { state: "go", few: [3.5], parts: [{ name: "a", x: 3 }] },
    { state: "gone", few: [], parts: [] },
    { state: "go", few: [4.5, 5], parts: [{ name: "a", x: 4 }] },
  ];
  for (const [k, { state, few, parts }] of messages.entries()) {
    const header = { stamp: { sec: k, nanosec: 0 }, frame_id: "map" };
    const numbers = { yes: k % 2 === 0, pair: [k, 1 - k], small: 1 - k, large: BigInt(k) };
    shapes.take(k, writer.writeMessage({ header, state, few, parts, ...numbers }));
    assert.deepEqual(seen[k], {
      state,
      few,
      parts: parts.map(({ name, x }) => [name, x]),
      numbers: [k % 2 === 0 ? 1 : 0, k, 1 - k, 1 - k, k],
    });
  }
  assert.equal(learnt, 4, "the third is like the first");
  const whole = writer.writeMessage({ header: {}, ...messages[0], yes: true, pair: [0, 0] });
  for (let length = 4; length < whole.length; ++length) {
    const cut = new Shapes(definitions, () => () => {});
    assert.throws(() => cut.take(0, whole.subarray(0, length)), /the message ends/, `${length}`);
  }
});

const kColumns = new Map<string, string[]>([
  ["/guidance", []],
  ["/cup", ["gap_m", "pull_n"]],
  ["/truth/vehicle", []],
]);
const flown = process.env.LIMPET_RECORDING;
test("a flight is read", { skip: flown === undefined }, () => {
  const recording = readRecording("flight", readFileSync(flown as string), kColumns);
  assert.ok(recording.duration > 1);
  assert.ok(recording.urdf.includes("<robot"));
  assert.ok(recording.phases.length > 3);
  assert.ok(recording.events.length > 3);
  assert.deepEqual(new Set(recording.tables.keys()), new Set(kColumns.keys()));
  // the tree of frames is whole at every time
  for (const [, track] of recording.frames) {
    assert.ok(track.parent === "map" || recording.frames.has(track.parent), track.parent);
    assert.ok(Math.abs(Math.hypot(...track.at(recording.duration / 2).slice(3)) - 1) < 1e-9);
  }
  const links = [...recording.urdf.matchAll(/<link name="([^"]+)"/g)].map((match) => match[1]);
  for (const link of links) {
    assert.ok(recording.frames.has(link as string), `${link} is in no /tf`);
  }
  for (const [, track] of recording.marks) {
    for (const mark of track.marks) {
      assert.ok(
        mark === null || mark.frame === "map" || recording.frames.has(mark.frame),
        mark?.frame,
      );
    }
  }
});

/** A number by its path in a message as MessageReader gives it. */
const within = (message: unknown, path: string): unknown =>
  path
    .split(/[.[\]]+/)
    .filter((name) => name !== "")
    .reduce((part, name) => (part as Record<string, unknown>)[name], message);

test("as the format's own library reads it", { skip: flown === undefined }, () => {
  const bytes = readFileSync(flown as string);
  const ours = readRecording("flight", bytes, kColumns);
  const reader = new McapStreamReader({
    decompressHandlers: {
      zstd: (data, size) => decompress(data, new Uint8Array(Number(size))),
    },
  });
  reader.append(bytes);
  const schemas = new Map<number, string>();
  const channels = new Map<number, { topic: string; reader: MessageReader }>();
  const count = new Map<string, number>();
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === "Schema") {
      schemas.set(record.id, new TextDecoder().decode(record.data));
    } else if (record.type === "Channel" && kColumns.has(record.topic)) {
      const definitions = parse(schemas.get(record.schemaId) ?? "", { ros2: true });
      channels.set(record.id, { topic: record.topic, reader: new MessageReader(definitions) });
    } else if (record.type === "Message") {
      const channel = channels.get(record.channelId);
      if (channel !== undefined) {
        const table = ours.tables.get(channel.topic);
        const k = count.get(channel.topic) ?? 0;
        count.set(channel.topic, k + 1);
        const message = channel.reader.readMessage(record.data);
        assert.ok(Math.abs((table?.time[k] ?? -1) - 1e-9 * Number(record.logTime)) < 1e-12);
        for (const [path, column] of table?.columns ?? []) {
          assert.equal(column[k], Number(within(message, path)), `${channel.topic} ${path}`);
        }
        for (const [path, texts] of table?.texts ?? []) {
          assert.equal(texts[k], within(message, path));
        }
      }
    }
  }
  for (const [topic, table] of ours.tables) {
    assert.equal(count.get(topic), table.time.length, topic);
    assert.ok(table.columns.size > 0 && table.time.length > 100, topic);
  }
  assert.deepEqual([...(ours.tables.get("/cup")?.columns.keys() ?? [])], ["pull_n", "gap_m"]);
});

test(
  "one damaged byte of a chunk costs that chunk and is reported",
  { skip: flown === undefined },
  () => {
    const bytes = new Uint8Array(readFileSync(flown as string));
    const whole = readRecording("flight", bytes, kColumns);
    assert.equal(whole.damage, "");
    const within = Math.floor(0.6 * bytes.length); // not in a chunk's index, which is not read
    bytes[within] = (bytes[within] as number) ^ 0x10;
    const most = readRecording("flight", bytes, kColumns);
    assert.match(most.damage, /^1 damaged and left out, first: /);
    assert.equal(most.duration, whole.duration);
    const rows = (recording: typeof whole) =>
      recording.tables.get("/truth/vehicle")?.time.length ?? 0;
    assert.ok(rows(most) > 0.3 * rows(whole) && rows(most) < rows(whole));
  },
);

test("a nested message without fields is a byte", () => {
  const line = "=".repeat(80);
  const text = `uint8 a\np/E e\nuint8 b\np/E[3] list\nfloat64 c\n${line}\nMSG: p/E\nuint8 KIND=3`;
  const seen: unknown[] = [];
  const shapes = new Shapes(parse(text, { ros2: true }), ({ numbers }) => (_t, view) => {
    seen.push(["a", "b", "c"].map((path) => numbers.get(path)?.(view)));
  });
  const message = new Uint8Array([0, 1, 0, 0, 7, 0, 8, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0x40]);
  shapes.take(0, message);
  assert.deepEqual(seen, [[7, 8, 2.5]]);
  assert.throws(() => shapes.take(0, message.subarray(0, 5)), /the message ends/);
});

// --- recordings of our own making: little-endian numbers, texts behind their length

const le = (value: number, bytes: number): number[] =>
  Array.from({ length: bytes }, (_, i) => Math.floor(value / 2 ** (8 * i)) % 256);
const text = (content: string): number[] => [...le(content.length, 4), ...Buffer.from(content)];
const record = (kind: number, content: number[]): number[] => [
  kind,
  ...le(content.length, 8),
  ...content,
];
const chunk = (compression: string, size: number, stored: number[]): number[] =>
  record(6, [
    ...le(0, 20 - 4),
    ...le(size, 8),
    ...le(0, 4),
    ...text(compression),
    ...le(stored.length, 8),
    ...stored,
  ]);
const recordingOf = (...records: number[][]): Uint8Array =>
  new Uint8Array([0x89, ...Buffer.from("MCAP0\r\n"), ...records.flat()]);
const channel = [
  ...record(3, [...le(1, 2), ...text("p/P"), ...text("ros2msg"), ...text("float64 x")]),
  ...record(4, [...le(1, 2), ...le(1, 2), ...text("/t"), ...text("cdr"), ...le(0, 4)]),
];
const message = (t_s: number): number[] =>
  record(5, [
    ...le(1, 2),
    ...le(0, 4),
    ...le(1e9 * t_s, 8),
    ...le(0, 8),
    0,
    1,
    0,
    0,
    ...le(0, 6),
    0xf0,
    0x3f,
  ]);
const kOne = new Map<string, string[]>([["/t", []]]);
const timesOf = (bytes: Uint8Array): number[] => [
  ...(readRecording("x", bytes, kOne).tables.get("/t")?.time ?? []),
];

/** A frame of one block; stored as it is where it is not packed. */
const frame = (block: number[], packed = false): number[] => [
  ...[0x04, 0x22, 0x4d, 0x18, 0x60, 0x40, 0x82],
  ...le(block.length + (packed ? 0 : 2 ** 31), 4),
  ...block,
  ...le(0, 4),
];
/** As one sequence: its bytes, without a match. */
const literals = (bytes: number[]): number[] => {
  const kMost = 15;
  assert.ok(bytes.length >= kMost && bytes.length < kMost + 255);
  return [0xf0, bytes.length - kMost, ...bytes];
};

test("Unix times count from the first message; times of a flight stay", () => {
  const read = (from_s: number): number[] => {
    const messages = [0, 0.25, 2].map((t) => message(from_s + t));
    // each in a chunk: the first message is that of the recording
    const chunks = messages.map((bytes) => chunk("", bytes.length, bytes));
    const whole = timesOf(recordingOf(channel, ...messages));
    assert.deepEqual(timesOf(recordingOf(channel, ...chunks)), whole);
    const recording = readRecording("x", recordingOf(channel, ...messages), kOne);
    assert.equal(recording.duration, whole.at(-1));
    assert.equal(recording.damage, "");
    return whole.map((time) => Number(time.toFixed(6)));
  };
  assert.deepEqual(read(1.79e9), [0, 0.25, 2]); // of the year 2026
  assert.deepEqual(read(1e5), [0, 0.25, 2]); // the first that is a clock's
  assert.deepEqual(read(99999), [99999, 99999.25, 100001]);
  assert.deepEqual(read(5), [5, 5.25, 7]);
});

test("chunks of LZ4 are read, packed and not", () => {
  const records = [...channel, ...message(1)];
  assert.deepEqual(timesOf(recordingOf(chunk("lz4", records.length, frame(records)))), [1]);
  assert.deepEqual(
    timesOf(recordingOf(chunk("lz4", records.length, frame(literals(records), true)))),
    [1],
  );
  // 3 literals, 9 bytes from 3 before, which run into what is written, and a last literal
  const packed = [0x35, 97, 98, 99, 3, 0, 0x10, 122];
  const out = unpackLz4(new Uint8Array(frame(packed, true)), 0, 100);
  assert.equal(Buffer.from(out).toString(), "abcabcabcabcz");
  assert.throws(
    () => unpackLz4(new Uint8Array(frame(packed, true)), 0, 12),
    /more than its declared size/,
  );
  assert.throws(() => unpackLz4(new Uint8Array(frame([0x05, 1, 0], true)), 9, 9), /not there/);
  for (let length = 1; length < packed.length; ++length) {
    const cut = new Uint8Array(frame(packed, true)).subarray(0, 11 + length);
    assert.throws(() => unpackLz4(cut, 0, 100), Error, String(length));
  }
});

test("a file that is packed as a whole is read", () => {
  const bytes = [...recordingOf([...channel, ...message(2)])];
  assert.deepEqual(
    timesOf(new Uint8Array([...frame(bytes.slice(0, 50)), ...frame(bytes.slice(50))])),
    [2],
  );
  // zstd with its size in a byte and one block as it is: RFC 8878, 3.1.1
  assert.ok(bytes.length < 256);
  const head = [0x28, 0xb5, 0x2f, 0xfd, 0x20, bytes.length];
  assert.deepEqual(
    timesOf(new Uint8Array([...head, ...le(1 + 8 * bytes.length, 3), ...bytes])),
    [2],
  );
});

test("a chunk that claims terabytes costs that chunk alone", () => {
  const good = [...channel, ...message(1)];
  for (const [compression, size] of [
    ["zstd", 2 ** 40],
    ["lz4", 2 ** 40],
    ["zstd", 2 ** 27],
    ["rle", 8],
  ] as const) {
    const bytes = recordingOf(
      chunk("", good.length, good),
      chunk(compression, size, [1, 2, 3, 4]),
      chunk("", message(3).length, message(3)),
    );
    assert.deepEqual(timesOf(bytes), [1, 3]);
    assert.match(readRecording("x", bytes, kOne).damage, /^1 damaged and left out, first: /);
  }
});
