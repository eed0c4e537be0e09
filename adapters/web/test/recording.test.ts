// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import { McapStreamReader } from "@mcap/core";
import { decompress } from "fzstd";
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

test("one damaged byte of a chunk is told", { skip: flown === undefined }, () => {
  const bytes = new Uint8Array(readFileSync(flown as string));
  const within = Math.floor(0.6 * bytes.length); // not in a chunk's index, which nobody reads
  bytes[within] = (bytes[within] as number) ^ 0x10;
  assert.throws(() => readRecording("flight", bytes, kColumns), NotARecording);
});
