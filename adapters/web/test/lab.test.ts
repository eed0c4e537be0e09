// SPDX-License-Identifier: Apache-2.0
// The lab's page: one flight, many, what a number depends on.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { Changes, rounded, slide } from "../src/lab/changes";
import type { Delay } from "../src/lab/reflights";
import { program } from "./flight";
import {
  browser,
  drag,
  idle,
  type LabState,
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

interface Shown {
  lab: { state(): LabState; many: { outside(): ManyShown }; learn: { outside(): LearnShown } };
}
interface LearnShown {
  running: boolean;
  flown: number;
  flights: number;
  bars: { key: string; less?: number; more?: number }[];
}
interface ManyShown {
  running: boolean;
  runs: number;
  rows: { run: number; outcome: string; values: number[] }[];
  looked?: { run: number; outcome: string; end: number };
  places: [number, number][];
}

const kFlat_bytes = 1e6; // a flight that were kept is of that size
const kFlatNodes = 20;
const folder = mkdtempSync(join(tmpdir(), "limpet_lab_test_"));
useLab("perch_metal_valve");
after(() => rmSync(folder, { recursive: true, force: true }));

test("changes go into an address and a command, and back", () => {
  const changes = new Changes();
  changes.scenario = "hover";
  changes.set("guidance.hold_s", "0.6");
  changes.set("wall.surface", "metal");
  assert.equal(
    changes.command(),
    "limpet fly hover --set wall.surface=metal --set guidance.hold_s=0.6",
  );
  assert.deepEqual(Changes.from(changes.toHash()).list(), changes.list());
});

test("a slider goes where it makes sense", () => {
  assert.deepEqual(slide(1.1, 0.01, 3), [0.01, 3]);
  assert.deepEqual(slide(0.5, 0.05, 100), [0.125, 2]);
  assert.deepEqual(slide(0, -30, 30), [-10, 10]);
  assert.equal(rounded(0.123456, 0, 2), 0.123);
});

test("what is dragged is flown, over the flight that stood", { skip }, async () => {
  assert.equal((await shown()).recordings, 1);
  const before = await shown();
  await drag("guidance.rest_s", [5, 3]);
  const now = await shown();
  assert.equal(now.recordings, 2);
  assert.ok(Math.abs(before.end - now.end - 4) < 0.3, `${before.end} then ${now.end}`);
  assert.deepEqual((await lab()).changes, ["guidance.rest_s=3"]);
  assert.match(page.url(), /set=guidance.rest_s%3D3/);
  await picture("lab.png");
});

test("the address alone brings it back", { skip }, async () => {
  const other = await browser.newPage();
  await other.goto(page.url());
  await other.waitForFunction(() => (window as unknown as Shown).lab?.state().idle === true);
  const state = await other.evaluate(() => (window as unknown as Shown).lab.state());
  assert.deepEqual(state.changes, ["guidance.rest_s=3"]);
  await other.close();
});

test("the command it copies flies the same", { skip }, async () => {
  const { command } = await lab();
  const words = command.split(" ").slice(1);
  const flown = spawnSync(program, [...words, "--no-record", "--json"], { encoding: "utf8" });
  assert.equal(flown.status, 0, flown.stderr);
  const { end } = await shown();
  assert.ok(Math.abs(JSON.parse(flown.stdout).performance.simulated_s - end) < 0.05);
});

test("what is saved is a scenario", { skip }, async () => {
  const session = await page.createCDPSession();
  await session.send("Page.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
  await page.evaluate(() => {
    [...document.querySelectorAll("button")].find((b) => b.textContent === "Save YAML")?.click();
  });
  const file = join(folder, "perch_metal_valve_changed.yaml");
  for (let waited = 0; waited < 100 && !existsSync(file); ++waited) {
    await new Promise((passed) => setTimeout(passed, 50));
  }
  assert.match(readFileSync(file, "utf8"), /rest_s: 3/);
  assert.equal(spawnSync(program, ["check", file]).status, 0);
});

test("what cannot be is reported, and the last flight stays", { skip }, async () => {
  await page.evaluate(() => {
    const number = document.querySelector<HTMLInputElement>(
      '[data-key="guidance.rest_s"] input[type=number]',
    ) as HTMLInputElement;
    number.value = "-1";
    number.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await idle();
  const text = await page.$eval("#problem", (e) => e.textContent);
  assert.match(text ?? "", /guidance.rest_s=-1: -1 is out of range, allowed 0..86400 s/);
  assert.ok((await shown()).recordings > 0);
  await drag("guidance.rest_s", [3]);
  assert.equal(await page.$eval("#problem", (e) => (e as HTMLElement).hidden), true);
});

test("another surface, another scenario, found parameters", { skip }, async () => {
  await choose("hover");
  await page.type("#lab input[type=search]", "gust");
  const found = await page.$$eval(
    "#lab .row",
    (rows) => rows.filter((row) => (row as HTMLElement).offsetParent !== null).length,
  );
  assert.ok(found > 0 && found < 10, `${found} rows`);
  await page.$eval("#lab input[type=search]", (input) => {
    input.value = "";
    input.dispatchEvent(new Event("input", { bubbles: true }));
  });
});

const many = (): Promise<ManyShown> =>
  page.evaluate(() => (window as unknown as Shown).lab.many.outside());
/** Landed runs, at least so many. */
const landed = (count: number): Promise<unknown> =>
  page.waitForFunction(
    (wanted) => (window as unknown as Shown).lab.many.outside().rows.length >= wanted,
    {},
    count,
  );

test("many fly; a point is a flight to look at", { skip }, async () => {
  await choose("perch_concrete");
  await drag("guidance.attempts", [1]);
  await tab("Many");
  await page.$eval("#lab .many input[aria-label=from]", (input) => {
    input.value = "0.6";
  });
  await page.$eval("#lab .many input[aria-label=to]", (input) => {
    input.value = "1.2";
  });
  await page.$eval("#lab .many input[aria-label=values]", (input) => {
    input.value = "4";
  });
  await press("Fly them");
  await landed(2); // live
  await landed(40);
  await page.waitForFunction(() => !(window as unknown as Shown).lab.many.outside().running);
  const { rows, places } = await many();
  assert.equal(rows.length, 40);
  assert.deepEqual([...new Set(rows.map(({ values }) => values[0]))].sort(), [0.6, 0.8, 1, 1.2]);
  const of = (speed: number): string[] =>
    rows.filter(({ values }) => values[0] === speed).map(({ outcome }) => outcome);
  assert.ok(
    of(0.6).filter((outcome) => outcome === "released").length <
      of(1.2).filter((outcome) => outcome === "released").length,
    JSON.stringify(rows),
  );
  // Each failure and each success: a click on its point shows how that very run went.
  for (const wanted of ["released", "failed_to_seal"]) {
    const k = rows.findIndex(({ outcome }) => outcome === wanted);
    const [x, y] = places[k] ?? [0, 0];
    const canvas = await page.$("#lab canvas.map");
    await canvas?.scrollIntoView();
    const box = await canvas?.boundingBox();
    await page.mouse.click((box?.x ?? 0) + x, (box?.y ?? 0) + y);
    await page.waitForFunction(
      (run) => (window as unknown as Shown).lab.many.outside().looked?.run === run,
      {},
      rows[k]?.run,
    );
    const { looked } = await many();
    assert.equal(looked?.outcome, wanted);
    assert.equal((await shown()).end, looked?.end);
  }
  await picture("lab_many.png");
});

test("a campaign that ships is stopped, and found again by another page", { skip }, async () => {
  await page.select("#lab .many select", "faults");
  await press("Fly them");
  await page.waitForFunction(() => (window as unknown as Shown).lab.many.outside().runs > 2000);
  await landed(3);
  await press("Stop");
  await page.waitForFunction(() => !(window as unknown as Shown).lab.many.outside().running);
  const { rows, runs } = await many();
  assert.ok(rows.length < runs, `${rows.length} rows of ${runs}`);
  const other = await browser.newPage();
  try {
    await other.goto(page.url());
    await other.waitForSelector("#lab [role=tab]");
    await tab("Many", other);
    await other.waitForFunction(
      (there) => (window as unknown as Shown).lab.many.outside().rows.length === there,
      {},
      rows.length,
    );
  } finally {
    await other.close(); // a page behind another one draws nothing
  }
  await tab("One");
});

test("what a number depends on: each parameter changed alone", { skip }, async () => {
  await choose("hover");
  await tab("Learn");
  await press("Turn them all");
  await page.waitForFunction(() => {
    const { flown, flights } = (window as unknown as Shown).lab.learn.outside();
    return flights > 200 && flown === flights;
  });
  await page.select("#lab .learn select", "energy_flying_Wh");
  const { bars } = await page.evaluate(() => (window as unknown as Shown).lab.learn.outside());
  assert.equal(bars.length, 15);
  assert.equal((await page.$$("#lab .bars li")).length, 15);
  const efficient = bars.find(({ key }) => key === "vehicle.battery.drive_efficiency");
  assert.ok((efficient?.less ?? 0) > 0 && (efficient?.more ?? 0) < 0, JSON.stringify(bars));
  await picture("lab_learn.png");
  await tab("One");
});

async function choose(scenario: string): Promise<void> {
  await page.select("#lab select", scenario);
  await page.waitForFunction(
    (name) => (window as unknown as Shown).lab.state().command === `limpet fly ${name}`,
    {},
    scenario,
  );
  await idle();
}
/** As a hand does it that waits for each picture, within the page; now and then it lets go. */
const reflown = (key: string, values: number[]): Promise<Delay[]> =>
  page.evaluate(
    async (row, moves) => {
      const { lab } = window as unknown as Shown;
      const slider = document.querySelector<HTMLInputElement>(
        `[data-key="${row}"] input[type=range]`,
      ) as HTMLInputElement;
      const delays: Delay[] = [];
      for (const [k, value] of moves.entries()) {
        slider.value = String(value);
        slider.dispatchEvent(new Event(k % 20 === 19 ? "change" : "input", { bubbles: true }));
        do {
          await new Promise((passed) => setTimeout(passed, 5));
        } while (!lab.state().idle);
        delays.push(lab.state().delays.at(-1) as Delay);
      }
      return delays;
    },
    key,
    values,
  );
const along = (count: number, from: number, step: number): number[] =>
  Array.from({ length: count }, (_, k) => from + step * (k % 10));
function report(what: string, delays: Delay[]): void {
  const at = (part: keyof Delay, share: number): string => {
    const sorted = delays.map((delay) => delay[part]).sort((a, b) => a - b);
    return (sorted[Math.floor(sorted.length * share)] ?? Number.NaN).toFixed(0);
  };
  const parts = (["flight", "way", "reading", "scene", "picture"] as const)
    .map((part) => `${part} ${at(part, 0.5)}`)
    .join(", ");
  console.log(
    `      slider to picture, ${what}: ${at("all", 0.5)} ms in the median (${parts}), ${at("all", 0.9)} ms at 90 %, ${delays.length} times`,
  );
}
/** What is held once garbage has been collected. */
async function held(): Promise<Record<"heap" | "nodes" | "listeners" | "geometries", number>> {
  const session = await page.createCDPSession();
  await session.send("HeapProfiler.enable");
  await session.send("HeapProfiler.collectGarbage");
  await session.detach();
  const { JSHeapUsedSize = 0, Nodes = 0, JSEventListeners = 0 } = await page.metrics();
  const { geometries } = await shown();
  return { heap: JSHeapUsedSize, nodes: Nodes, listeners: JSEventListeners, geometries };
}

test("how long a hand waits; 200 re-flights leave the memory flat", { skip }, async () => {
  await choose("perch_concrete");
  await reflown("guidance.dock_speed_m_s", [1, 1.1]);
  report(
    "perch_concrete, 1400 x 860 (software renderer)",
    await reflown("guidance.dock_speed_m_s", along(9, 0.8, 0.05)),
  );
  await choose("hover");
  await page.setViewport({ width: 640, height: 480 }); // this is not about the renderer
  await reflown("simulation.hover_s", along(20, 0.5, 0.05));
  const early = await held();
  report("hover, 640 x 480", await reflown("simulation.hover_s", along(200, 0.5, 0.05)));
  const late = await held();
  await page.setViewport({ width: 1400, height: 860 });
  console.log(
    `      held after garbage: heap ${(early.heap / 1e6).toFixed(2)} then ${(late.heap / 1e6).toFixed(2)} MB, ${early.nodes} then ${late.nodes} nodes`,
  );
  const text = JSON.stringify({ early, late });
  assert.ok(late.heap < early.heap + kFlat_bytes, text);
  assert.ok(late.nodes <= early.nodes + kFlatNodes, text);
  assert.ok(late.listeners <= early.listeners + kFlatNodes, text);
  assert.equal(late.geometries, early.geometries, text);
});

test("readable for everybody, also on a phone", { skip }, async () => {
  for (const name of ["One", "Many", "Learn", "Live"]) {
    await tab(name);
    for (const scheme of ["light", "dark"]) {
      await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
      const wrong = await unreadable();
      assert.deepEqual(wrong, [], `${name}, ${scheme}`);
      await picture(`lab_${name.toLowerCase()}_${scheme}.png`);
    }
  }
  await page.setViewport({ width: 400, height: 800 });
  for (const name of ["Live", "Learn", "Many", "One"]) {
    await tab(name);
    // once the charts have followed
    await page.waitForFunction(() => document.documentElement.scrollWidth <= 400);
    await picture(`lab_${name.toLowerCase()}_phone.png`);
  }
  assert.deepEqual(problems, []);
});
