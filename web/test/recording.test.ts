// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Track } from "../src/recording/poses";
import { NotARecording, readRecording } from "../src/recording/recording";
import { indexAt, valueAt } from "../src/recording/series";

test("indexAt finds what holds at a time", () => {
  assert.equal(indexAt([0, 1, 2], -0.1), -1);
  assert.equal(indexAt([0, 1, 2], 0), 0);
  assert.equal(indexAt([0, 1, 2], 1.9), 1);
  assert.equal(indexAt([0, 1, 1, 2], 1), 2);
  assert.equal(indexAt([], 1), -1);
  assert.equal(valueAt([0, 1], [5, 6], 0.5), 5);
  assert.equal(valueAt([0, 1], [5, 6], -0.5), undefined);
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
    () => readRecording("x", new TextEncoder().encode("not a recording"), new Set()),
    NotARecording,
  );
});

const kColumns = new Set(["/guidance", "/cup", "/truth/vehicle"]);
const flown = process.env.LIMPET_RECORDING;
test("a flight is read", { skip: flown === undefined }, () => {
  const recording = readRecording("flight", readFileSync(flown as string), kColumns);
  assert.ok(recording.duration > 1);
  assert.ok(recording.urdf.includes("<robot"));
  assert.ok(recording.phases.length > 3);
  assert.ok(recording.events.length > 3);
  assert.deepEqual(new Set(recording.tables.keys()), kColumns);
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
