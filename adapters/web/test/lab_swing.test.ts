// SPDX-License-Identifier: Apache-2.0
// The lab's map of the swing on the cup, with the vehicle in it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { growthAt, shareAlong, valueAlong } from "../src/lab/growth";
import type { SwingState } from "../src/lab/server";
import {
  idle,
  lab,
  page,
  picture,
  press,
  problems,
  shown,
  skip,
  tab,
  unreadable,
  useLab,
} from "./lab_page";

type Seen = SwingState & { idle: boolean; place?: [number, number] };
interface Shown {
  lab: { swing: { outside(): Seen } };
}
useLab("slow_motors_metal");

const swing = (): Promise<Seen> =>
  page.evaluate(() => (window as unknown as Shown).lab.swing.outside());
const drawn = (): Promise<unknown> =>
  page.waitForFunction(() => (window as unknown as Shown).lab.swing.outside().idle);
const put = (panel: number, label: string, value: string): Promise<void> =>
  page.$$eval(
    `#lab .swing fieldset input[aria-label=${label}]`,
    (inputs, at, text) => {
      const input = inputs[at] as HTMLInputElement;
      input.value = text;
      input.dispatchEvent(new Event("change", { bubbles: true }));
    },
    panel,
    value,
  );

test("values lie on their columns, and a coarse map is a map", () => {
  const axis = { keys: ["a"], values: [0, 0.1, 0.2, 0.3], own: [0.1] };
  assert.equal(shareAlong(axis, 0), 0.125);
  assert.ok(Math.abs(valueAlong(axis, shareAlong(axis, 0.17)) - 0.17) < 1e-12);
  assert.equal(valueAlong(axis, 0), 0);
  const state = { across: axis, growth_1_s: [1, null, 2, null, null, null, null, 5] };
  assert.equal(growthAt(state as unknown as SwingState, 1, 0), 1);
  assert.equal(growthAt(state as unknown as SwingState, 3, 0), 2);
  assert.equal(growthAt(state as unknown as SwingState, 3, 1), 5);
  assert.equal(growthAt(state as unknown as SwingState, 0, 1), 1);
});

test("the swing on the cup: a map, and the vehicle in it", { skip }, async () => {
  await tab("Learn");
  for (const [panel, from, to, count] of [
    [0, "0.02", "0.08", "4"],
    [1, "0", "0.4", "3"],
  ] as const) {
    await put(panel, "from", from);
    await put(panel, "to", to);
    await put(panel, "values", count);
  }
  await press("Draw the map");
  await drawn();
  const map = await swing();
  assert.equal(map.done, 12);
  assert.deepEqual(map.across.own, [0.065, 0.065]);
  assert.deepEqual(map.up.own, [0.2]);
  const growth = map.growth_1_s as number[];
  assert.ok((growth[0] as number) < 0 && (growth[11] as number) > 0, JSON.stringify(growth));
  // Between its neighbours: slow motors at PX4's gains, 0.065 s between 0.06 and 0.08.
  const own = map.own.growth_1_s as number;
  assert.ok((growth[6] as number) < own && own < (growth[7] as number), JSON.stringify(map));
  const text = await page.$eval("#lab .swing .status", (e) => e.textContent);
  assert.match(text ?? "", /This vehicle: grows, \+0\.\d+ 1\/s at 0\.\d+ Hz/);
  await page.$eval("#lab .swing canvas", (canvas) => canvas.scrollIntoView({ block: "center" }));
  await picture("lab_swing.png");
  assert.deepEqual(await unreadable(), []);
});

test("a slider moves the vehicle, and it flies so", { skip }, async () => {
  const before = await swing();
  await page.$$eval("#lab .swing input[type=range]", (sliders) => {
    const slider = sliders[1] as HTMLInputElement;
    for (const [value, kind] of [
      [0.1, "input"],
      [0, "change"],
    ] as const) {
      slider.value = String(value);
      slider.dispatchEvent(new Event(kind, { bubbles: true }));
    }
  });
  await idle();
  await drawn();
  const now = await swing();
  assert.equal(now.id, before.id); // the map stands
  assert.deepEqual(now.up.own, [0]);
  assert.ok((now.own.growth_1_s ?? 1) < 0, JSON.stringify(now.own));
  assert.ok((now.place?.[1] ?? 0) > (before.place?.[1] ?? 0), "further down");
  assert.deepEqual((await lab()).changes, ["autopilot.MC_PITCHRATE_I=0"]);
  assert.equal((await shown()).recordings, 2); // over the one that stood
});

test("a click on the map turns both numbers; another number, another map", { skip }, async () => {
  const { place, id, growth_1_s } = await swing();
  const [x, y] = place ?? [0, 0];
  const canvas = await page.$("#lab .swing canvas");
  await canvas?.scrollIntoView();
  const box = await canvas?.boundingBox();
  await page.mouse.click((box?.x ?? 0) + x - 60, (box?.y ?? 0) + y - 60);
  await page.waitForFunction(
    () => (window as unknown as Shown).lab.swing.outside().up.own[0] !== 0,
  );
  await idle();
  await drawn();
  const clicked = await swing();
  assert.ok((clicked.across.own[0] as number) < 0.065);
  assert.equal(clicked.across.own[0], clicked.across.own[1]);
  assert.ok(Math.abs((clicked.place?.[0] ?? 0) - (x - 60)) < 1, JSON.stringify(clicked.place));
  assert.ok(Math.abs((clicked.place?.[1] ?? 0) - (y - 60)) < 1, JSON.stringify(clicked.place));

  // In the tab One, where the map is not seen: it follows when it is.
  await tab("One");
  await page.$eval('[data-key="autopilot.MC_PITCHRATE_P"] input[type=number]', (input) => {
    input.value = "0.2";
    input.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await idle();
  assert.equal((await swing()).id, id);
  await tab("Learn");
  await page.waitForFunction(
    (old) => (window as unknown as Shown).lab.swing.outside().id === old + 1,
    {},
    id,
  );
  await drawn();
  const other = await swing();
  assert.ok((other.growth_1_s[11] as number) < (growth_1_s[11] as number));
  assert.deepEqual(problems, []);
});
