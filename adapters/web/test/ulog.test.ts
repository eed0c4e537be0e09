// SPDX-License-Identifier: Apache-2.0
// A PX4 log that `limpet ulog` wrote (LIMPET_ULOG), read by others' reader, against the recording
// that it was made of (LIMPET_RECORDING).
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { MessageType, ULog } from "@foxglove/ulog";
import { FileReader } from "@foxglove/ulog/node.js";
import { readRecording } from "../src/recording/recording";

const file = process.env.LIMPET_ULOG;
const recording_file = process.env.LIMPET_RECORDING;

test(
  "a PX4 log holds the flight",
  { skip: file === undefined || recording_file === undefined },
  async () => {
    const log = new ULog(new FileReader(file as string));
    await log.open();
    const rows = new Map<string, { timestamp: bigint; [field: string]: unknown }[]>();
    const texts: string[] = [];
    let last = 0n;
    for await (const message of log.readMessages()) {
      if (message.type === MessageType.Data) {
        const name = log.subscriptions.get(message.msgId)?.name ?? "";
        const row = message.value as { timestamp: bigint };
        assert.ok(row.timestamp >= last, `${name} goes back in time`);
        last = row.timestamp;
        const all = rows.get(name) ?? [];
        all.push(row);
        rows.set(name, all);
      } else if (message.type === MessageType.Log) {
        texts.push(message.message);
      }
    }
    const recording = readRecording(
      "flight",
      readFileSync(recording_file as string),
      new Map([
        ["/truth/pose", []],
        ["/cup", []],
      ]),
    );
    const pose = recording.tables.get("/truth/pose");
    const where = rows.get("vehicle_local_position_groundtruth") ?? [];
    assert.equal(where.length, pose?.time.length);
    for (const k of [0, Math.floor(where.length / 2), where.length - 1]) {
      // east-north-up there, north-east-down here
      const column = (name: string) => pose?.columns.get(`pose.position.${name}`)?.[k] as number;
      assert.ok(Math.abs((where[k]?.x as number) - column("y")) < 1e-5);
      assert.ok(Math.abs((where[k]?.y as number) - column("x")) < 1e-5);
      assert.ok(Math.abs((where[k]?.z as number) + column("z")) < 1e-5);
      assert.ok(Math.abs(Number(where[k]?.timestamp) * 1e-6 - (pose?.time[k] as number)) < 1e-6);
    }
    assert.equal(rows.get("limpet_cup")?.length, recording.tables.get("/cup")?.time.length);
    for (const name of [
      "vehicle_attitude",
      "sensor_combined",
      "distance_sensor",
      "battery_status",
      "vehicle_status",
      "actuator_motors",
    ]) {
      assert.ok((rows.get(name)?.length ?? 0) > 10, name);
    }
    assert.equal(texts.length, recording.events.length);
    assert.ok(texts.some((text) => text.includes("impact")));
  },
);
