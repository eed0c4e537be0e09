// SPDX-License-Identifier: Apache-2.0
// The layouts for other viewers (LIMPET_LAYOUTS, a folder) name what a recording (LIMPET_RECORDING) has.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { McapIndexedReader } from "@mcap/core";

type Definitions = ReturnType<typeof parse>;

const file = process.env.LIMPET_RECORDING;
const folder = process.env.LIMPET_LAYOUTS;
const skip = file === undefined || folder === undefined;

/** What each topic's messages are made of. */
async function topicsOf(path: string): Promise<Map<string, Definitions>> {
  const bytes = readFileSync(path);
  const reader = await McapIndexedReader.Initialize({
    readable: {
      size: async () => BigInt(bytes.length),
      read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
    },
    decompressHandlers: {},
  });
  const topics = new Map<string, Definitions>();
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    topics.set(channel.topic, parse(new TextDecoder().decode(schema?.data), { ros2: true }));
  }
  return topics;
}

/** Whether a message has this field: ["wrench", "force", "x"]. */
function has(definitions: Definitions, fields: string[]): boolean {
  let inside = definitions.find((one) => one.name === undefined) ?? definitions[0];
  for (const [k, field] of fields.entries()) {
    const found = inside?.definitions.find((one) => one.name === field && !one.isConstant);
    if (found === undefined) {
      return false;
    }
    if (!found.isComplex) {
      return k === fields.length - 1;
    }
    inside = definitions.find((one) => one.name === found.type);
  }
  return true;
}

/** Every text in it that names a topic. */
function namesIn(json: unknown): string[] {
  if (typeof json === "string") {
    return json.startsWith("/") ? [json] : [];
  }
  if (typeof json !== "object" || json === null) {
    return [];
  }
  const keys = Array.isArray(json) ? [] : Object.keys(json).filter((key) => key.startsWith("/"));
  return [...keys, ...Object.values(json).flatMap(namesIn)];
}

test("Foxglove's layout names what is there", { skip }, async () => {
  const topics = await topicsOf(file as string);
  const layout = JSON.parse(readFileSync(join(folder as string, "foxglove.json"), "utf8"));
  const names = namesIn(layout);
  assert.ok(names.length >= 10);
  for (const name of names) {
    const [topic, ...fields] = name.split(".");
    const definitions = topics.get(topic as string);
    assert.ok(definitions, name);
    assert.ok(has(definitions, fields), name);
  }
  for (const topic of ["/scene", "/robot_description"]) {
    assert.ok(names.includes(topic), topic);
  }
  // Every panel is placed, and every place has a panel.
  const placed = (node: unknown): string[] =>
    typeof node === "string"
      ? [node]
      : Object.values(node as { first: unknown; second: unknown })
          .filter((part) => typeof part === "object" || String(part).includes("!"))
          .flatMap(placed);
  assert.deepEqual(placed(layout.layout).sort(), Object.keys(layout.configById).sort());
});

test("PlotJuggler's layout names what is there", { skip }, async () => {
  const topics = await topicsOf(file as string);
  const layout = readFileSync(join(folder as string, "plotjuggler.xml"), "utf8");
  const curves = [...layout.matchAll(/<curve name="([^"]+)"/g)].map((found) => found[1] as string);
  assert.ok(curves.length >= 5);
  for (const curve of curves) {
    const topic = [...topics.keys()]
      .filter((name) => curve.startsWith(`${name}/`))
      .sort()
      .at(-1);
    assert.ok(topic, curve);
    const fields = curve.slice(topic.length + 1).split("/");
    assert.ok(has(topics.get(topic) as Definitions, fields), curve);
  }
  assert.equal(has(topics.get("/cup") as Definitions, ["pressure"]), false);
});
