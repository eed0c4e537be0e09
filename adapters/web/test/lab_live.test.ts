// SPDX-License-Identifier: Apache-2.0
// A flight in progress, watched in the lab's page.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import { callOf, liveAddress } from "../src/recording/live";
import { Builder } from "../src/recording/recording";
import { Flight, program } from "./flight";
import { page, picture, press, problems, shown, skip, tab, unreadable, useLab } from "./lab_page";

interface LiveShown {
  watching: boolean;
  messages: number;
  status: string;
  texts: string[];
  services: string[];
  parameters: Record<string, number>;
}
interface Shown {
  lab: { live: { outside(): LiveShown } };
}
const layouts = process.env.LIMPET_LAYOUTS ?? ""; // a folder next to the shipped vehicles
useLab("perch_concrete", ["ws://127.0.0.1:"]);
const live = (): Promise<LiveShown> =>
  page.evaluate(() => (window as unknown as Shown).lab.live.outside());
const until = (what: (live: LiveShown) => boolean): Promise<unknown> =>
  page.waitForFunction(
    `(${what.toString()})(window.lab.live.outside())`, // runs in the page
  );
async function watch(line: string): Promise<void> {
  await page.$eval(
    "#lab .live input",
    (input, text) => {
      input.value = text;
    },
    line,
  );
  await press("Watch");
}

test("an address is one of this machine; a call is a call", () => {
  const here = "ws://127.0.0.1:8765/?token=ab";
  assert.equal(liveAddress(`  live  ${here}  (limpet lab: Live)`).href, here);
  for (const other of [
    "",
    "ws://192.0.2.1:8765/",
    "wss://127.0.0.1:1/",
    "ws://localhost.example/",
  ]) {
    assert.throws(() => liveAddress(other), /as a flight of this machine prints it/);
  }
  assert.deepEqual(
    [...callOf(3, 258)],
    [2, 3, 0, 0, 0, 2, 1, 0, 0, 3, 0, 0, 0, 99, 100, 114, 0, 1, 0, 0, 0],
  );
});

test("a vehicle without a truth is where it is estimated", () => {
  const numbers = (names: string): string =>
    names
      .split(" ")
      .map((name) => `float64 ${name}`)
      .join("\n");
  const line = "=".repeat(80);
  const schema = `geometry_msgs/Pose pose
${line}
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
${line}
MSG: geometry_msgs/Point
${numbers("x y z")}
${line}
MSG: geometry_msgs/Quaternion
${numbers("x y z w")}`;
  const writer = new MessageWriter(parse(schema, { ros2: true }));
  const builder = new Builder("live", new Map([["/estimate/pose", []]]));
  const channel = { id: 4, encoding: "cdr", schemaEncoding: "ros2msg", schema };
  assert.equal(builder.channel({ ...channel, topic: "/not/wanted" }), false);
  assert.equal(builder.channel({ ...channel, topic: "/estimate/pose" }), true);
  for (const x of [0, 1]) {
    const pose = { position: { x, y: 2, z: 3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
    builder.message(4, x, writer.writeMessage({ pose }));
  }
  const { frames, duration } = builder.built();
  assert.equal(duration, 1);
  assert.deepEqual(frames.get("base_link")?.at(0.5), [0.5, 2, 3, 0, 0, 0, 1]);
});

test("a flight is seen as it flies, and can be asked to stop", { skip }, async () => {
  await tab("Live");
  await watch("ws://192.0.2.1:8765/");
  const problem = await page.$eval("#problem", (e) => e.textContent);
  assert.match(problem ?? "", /as a flight of this machine prints it/);

  const flight = new Flight(0.1); // not on the wall before a slow page has paused it, and asked for a take-off
  await watch(await flight.line());
  await until(({ messages }) => messages > 500);
  assert.deepEqual((await live()).services, ["Pause", "Resume", "Take off", "Abort"]);
  const early = await shown();
  assert.equal(early.recordings, 1);
  assert.ok(early.following && early.vehicle.seen && early.charts >= 6, JSON.stringify(early));

  await press("Pause");
  await until(({ texts }) => texts.includes("paused"));
  await press("Pause");
  await until(({ texts }) => texts.includes("is paused already"));
  await press("Take off"); // guidance's own guard
  await until(({ texts }) => texts.includes("does not rest on the wall"));
  await new Promise((passed) => setTimeout(passed, 300));
  const held = await shown();
  assert.ok(held.time > early.time && held.time === held.end, JSON.stringify(held));
  assert.match((await live()).status, /^perch_concrete · \d+\.\d s · \w+/);
  await picture("lab_live.png");
  assert.deepEqual(await unreadable(), []);

  // What was is looked at while it flies on; then it is followed again.
  await page.$eval("#timeline input", (slider) => {
    (slider as HTMLInputElement).value = "0.25";
    slider.dispatchEvent(new Event("input"));
  });
  assert.equal((await shown()).following, false);
  await press("Resume");
  await page.waitForFunction(
    (end) =>
      (window as unknown as { limpet: { state(): { end: number } } }).limpet.state().end > end + 1,
    {},
    held.end,
  );
  assert.equal((await shown()).time, 0.25);
  await press("Now");
  const again = await shown();
  assert.ok(again.following && again.end > held.end);
  await press("Abort");
  const result = await flight.end();
  assert.equal(result.outcome, "aborted");
  await until(({ watching }) => !watching);
  const last = await live();
  assert.equal(last.status, "the flight is no longer there");
  // Where the vehicle is by then shows in the truth: it is not waited for.
  const how = /^aborted(, in truth \w+)?: a viewer asked for it$/;
  assert.ok(
    last.texts.some((line: string) => how.test(line)),
    JSON.stringify(last.texts),
  );
});

/** Types a value into a parameter's field. */
const type = (name: string, value: number): Promise<unknown> =>
  page.evaluate(
    (wanted, number) => {
      const row = [...document.querySelectorAll("#lab .live .row")].find(
        (one) => one.querySelector("span")?.textContent === wanted,
      );
      const input = row?.querySelector("input") as HTMLInputElement;
      input.value = String(number);
      input.dispatchEvent(new Event("change"));
    },
    name,
    value,
  );

test("its parameters are set, within what they may be", { skip }, async () => {
  const flight = new Flight(1);
  await watch(await flight.line());
  await until(({ parameters, messages }) => Object.keys(parameters).length > 20 && messages > 0);
  await press("Pause");
  await until(({ texts }) => texts.includes("paused"));
  const name = "autopilot.MC_PITCHRATE_P";
  const { parameters } = await live();
  assert.ok(Object.keys(parameters).every((key) => key.startsWith("autopilot.")));
  const before = parameters[name] as number;
  await type(name, 1.01 * before);
  await type(name, 1e9); // the flight's own guard; what holds stays
  await until(({ texts }) => texts.some((text) => text.includes("is out of range, allowed")));
  await page.waitForFunction(
    (key, value) =>
      Math.abs(((window as unknown as Shown).lab.live.outside().parameters[key] ?? 0) - value) <
      1e-9,
    {},
    name,
    1.01 * before,
  );
  await page.$eval("#lab .live details", (details) => {
    (details as HTMLDetailsElement).open = true;
  });
  await page.type("#lab .live input[type=search]", "pitchrate");
  const seen = await page.$$eval(
    "#lab .live .row",
    (rows) => rows.filter((row) => (row as HTMLElement).offsetParent !== null).length,
  );
  assert.ok(seen > 2 && seen < 12, `${seen} rows`);
  await picture("lab_live_parameters.png");
  assert.deepEqual(await unreadable(), []);
  await press("Resume");
  // It is an event of the flight, with its value.
  await page.waitForFunction(() =>
    [...document.querySelectorAll("#events li")].some(({ textContent }) =>
      /parameter set.*MC_PITCHRATE_P/.test(textContent ?? ""),
    ),
  );
  await press("Abort");
  assert.equal((await flight.end()).outcome, "aborted");
  await until(({ watching }) => !watching);
});

test("a vehicle from CAD has its meshes", { skip }, async () => {
  const flight = new Flight(
    1,
    "--set",
    `vehicle=${join(layouts, "../vehicles/cad_uav/cad_uav.yaml")}`,
  );
  await watch(await flight.line());
  await until(({ messages }) => messages > 100);
  await page.waitForFunction(() => {
    const [flight] = (
      window as unknown as {
        limpet: { recordings: { meshes: Map<string, unknown>; urdf: string }[] };
      }
    ).limpet.recordings;
    const named = new Set(
      [...(flight?.urdf.matchAll(/<mesh filename="[^"]*\/([^"]+)"/g) ?? [])].map(
        ([, name]) => name,
      ),
    );
    return named.size > 3 && [...named].every((name) => flight?.meshes.has(name as string));
  });
  const { vehicle } = await shown();
  assert.ok(vehicle.seen);
  await picture("lab_live_cad.png");
  await press("Abort");
  await until(({ watching }) => !watching);
});

test(
  "it is watched to its end, from the wall to the wall, and no other for it",
  { skip },
  async () => {
    const flight = new Flight(2);
    await watch(await flight.line());
    const { outcome, hash } = await flight.end();
    await until(({ watching }) => !watching);
    const { end } = await shown();
    const events = await page.$$eval("#events li", (all) =>
      all.map((one) => one.textContent ?? ""),
    );
    for (const wanted of ["attached", "perched"]) {
      assert.ok(
        events.some((text) => text.includes(wanted)),
        `${wanted}: ${events}`,
      );
    }
    const alone = spawn(program, ["fly", "perch_concrete", "--no-record", "--json"]);
    let text = "";
    alone.stdout.on("data", (part) => {
      text += part;
    });
    await new Promise((done) => alone.on("close", done));
    const plain = JSON.parse(text);
    assert.equal(outcome, plain.outcome);
    assert.equal(hash, plain.hash);
    assert.ok(Math.abs(end - plain.performance.simulated_s) < 0.1, `${end}`);
    await watch(await flight.line());
    await until(({ status }) => status === "no flight answers there, or its token is another one");
    assert.deepEqual(
      problems.filter((one) => !/WebSocket connection to/.test(one)),
      [],
    );
  },
);
