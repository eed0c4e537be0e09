// SPDX-License-Identifier: Apache-2.0
// The page in a real browser, with a real flight: LIMPET_VIEW is a page that `limpet view` wrote,
// LIMPET_RECORDING the recording in it. LIMPET_PICTURES: a folder for what it looked like.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, ElementHandle, Page } from "puppeteer-core";
import { hasChromium, openChromium } from "./chromium";

const page_file = process.env.LIMPET_VIEW ?? "";
const recording_file = process.env.LIMPET_RECORDING ?? "";
const skip = page_file === "" ? "no LIMPET_VIEW" : !hasChromium ? "no Chromium" : false;

interface State {
  time: number;
  end: number;
  recordings: number;
  vehicle: { x: number; y: number; seen: boolean };
  charts: number;
  geometries: number;
  textures: number;
  pictures: number;
}
interface Shown {
  limpet: { state(): State; seek(t: number): void };
}

let browser: Browser;
let page: Page;
const problems: string[] = [];

before(async () => {
  if (skip !== false) {
    return;
  }
  browser = await openChromium();
  page = await browser.newPage();
  page.setDefaultTimeout(120000); // a busy machine without a graphics card
  page.on("console", (message) => {
    // The software renderer talks about its own speed.
    if (!/GPU stall|swiftshader|WebGL/i.test(message.text())) {
      problems.push(message.text());
    }
  });
  page.on("pageerror", (problem) => problems.push(String(problem)));
  page.on("request", (request) => {
    if (!/^(file|data|blob):/.test(request.url())) {
      problems.push(`requests ${request.url()}`);
    }
  });
  await page.setOfflineMode(true);
  await page.setViewport({ width: 1200, height: 800 });
  await page.goto(`file://${page_file}`);
  await loaded(1);
});
after(async () => {
  await browser?.close();
});

const state = (): Promise<State> =>
  page.evaluate(() => (window as unknown as Shown).limpet.state());
async function loaded(count: number): Promise<void> {
  await page.waitForFunction(
    (n) => (window as unknown as Shown).limpet?.state().recordings === n,
    {},
    count,
  );
}
async function seek(t: number): Promise<void> {
  const pictures = (await state()).pictures;
  await page.evaluate((to) => (window as unknown as Shown).limpet.seek(to), t);
  await page.waitForFunction(
    (n) => (window as unknown as Shown).limpet.state().pictures > n,
    {},
    pictures,
  );
}
/** How many colours the picture has, roughly: an empty scene has a few. */
const colours = (): Promise<number> =>
  page.evaluate(() => {
    const canvas = document.querySelector("#picture") as HTMLCanvasElement;
    const copy = document.createElement("canvas");
    copy.width = copy.height = 96;
    const context = copy.getContext("2d") as CanvasRenderingContext2D;
    context.drawImage(canvas, 0, 0, 96, 96);
    const { data } = context.getImageData(0, 0, 96, 96);
    const seen = new Set<number>();
    for (let i = 0; i < data.length; i += 4) {
      seen.add(
        (((data[i] as number) >> 4) << 8) |
          (((data[i + 1] as number) >> 4) << 4) |
          ((data[i + 2] as number) >> 4),
      );
    }
    return seen.size;
  });
async function photograph(name: string): Promise<void> {
  if (process.env.LIMPET_PICTURES !== undefined) {
    await page.screenshot({ path: join(process.env.LIMPET_PICTURES, name) });
  }
}
async function drop(name: string, bytes: Uint8Array): Promise<void> {
  await page.evaluate(
    async (file, base64) => {
      const answer = await fetch(`data:application/octet-stream;base64,${base64}`);
      const data = new DataTransfer();
      data.items.add(new File([await answer.blob()], file));
      document.dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
    },
    name,
    Buffer.from(bytes).toString("base64"),
  );
}

test("the vehicle is in every camera's picture, at every phase", { skip }, async () => {
  const { end, charts } = await state();
  assert.ok(end > 10);
  assert.ok(charts >= 6, `${charts} charts`);
  for (const view of ["side", "cup", "chase", "overview"]) {
    await page.click(`[data-view=${view}]`);
    for (const share of [0, 0.17, 0.5, 0.9]) {
      await seek(share * end);
      const { vehicle } = await state();
      assert.ok(vehicle.seen || view === "cup", `${view} at ${share}: ${JSON.stringify(vehicle)}`);
      assert.ok((await colours()) > 15, `${view} at ${share}`);
    }
    await photograph(`${view}.png`);
  }
});

test("plays, pauses, steps and jumps by keys", { skip }, async () => {
  await page.click("[data-view=side]");
  await page.focus("#picture");
  await page.keyboard.press("Home");
  assert.equal((await state()).time, 0);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => (window as unknown as Shown).limpet.state().time > 0.2);
  await page.keyboard.press("Space");
  const { time } = await state();
  await new Promise((resolve) => setTimeout(resolve, 200));
  assert.equal((await state()).time, time);
  await page.keyboard.press("ArrowRight");
  assert.ok(Math.abs((await state()).time - time - 0.05) < 1e-9);
  await page.keyboard.press("End");
  assert.equal((await state()).time, (await state()).end);
});

test("an event and a chart lead to their time", { skip }, async () => {
  const items = await page.$$("#events li button");
  assert.ok(items.length > 5);
  const wanted = await page.$$eval("#events li time", (all) =>
    Number.parseFloat(all[2]?.textContent ?? ""),
  );
  await (items[2] as ElementHandle<HTMLButtonElement>).click();
  assert.ok(Math.abs((await state()).time - wanted) < 1e-3);
  const chart = await page.$(".chart .u-over");
  const box = await chart?.boundingBox();
  assert.ok(box);
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  const { time, end } = await state();
  assert.ok(Math.abs(time / end - 0.5) < 0.02, `${time} of ${end}`);
});

test(
  "a chart is saved with its title, its numbers and the mark of the time",
  { skip },
  async () => {
    await seek((await state()).end / 2);
    await page.evaluate("globalThis.__name = (named) => named"); // what names functions is not in the page
    const saved = await page.evaluate(async () => {
      let href = "";
      const { click } = HTMLAnchorElement.prototype;
      HTMLAnchorElement.prototype.click = function () {
        href = this.href;
      };
      const chart = [...document.querySelectorAll(".chart:not([hidden])")][0] as Element;
      (chart.querySelector(".save") as HTMLElement).click();
      HTMLAnchorElement.prototype.click = click;
      const picture = await createImageBitmap(await (await fetch(href)).blob());
      const canvas = document.createElement("canvas");
      canvas.width = picture.width;
      canvas.height = picture.height;
      const context = canvas.getContext("2d", {
        willReadFrequently: true,
      }) as CanvasRenderingContext2D;
      context.drawImage(picture, 0, 0);
      const plot = chart.querySelector("canvas") as HTMLCanvasElement;
      const inked = (x: number, y: number, width: number, height: number): number => {
        const { data } = context.getImageData(x, y, width, height);
        const ground = context.getImageData(0, 0, 1, 1).data;
        let count = 0;
        for (let k = 0; k < data.length; k += 4) {
          count += Math.abs((data[k] as number) - (ground[0] as number)) > 60 ? 1 : 0;
        }
        return count;
      };
      const head = picture.height - plot.height;
      let whole = 0; // columns that are inked from top to bottom
      for (let x = Math.round(0.4 * picture.width); x < 0.7 * picture.width; ++x) {
        whole += inked(x, head + 24, 1, 70) === 70 ? 1 : 0;
      }
      return { href, head, whole, left: inked(0, 0, 300, head), width: picture.width };
    });
    if (process.env.LIMPET_PICTURES !== undefined) {
      const bytes = Buffer.from(saved.href.slice(saved.href.indexOf(",") + 1), "base64");
      writeFileSync(join(process.env.LIMPET_PICTURES, "chart.png"), bytes);
    }
    assert.ok(saved.head > 10 && saved.left > 50, JSON.stringify({ ...saved, href: "" }));
    assert.ok(saved.whole >= 1 && saved.whole <= 3, `${saved.whole} marks`);
  },
);

test("recordings dropped on it fly, rubbish is reported in one line", { skip }, async () => {
  const bytes = readFileSync(recording_file);
  await drop("rubbish.mcap", new TextEncoder().encode("no recording"));
  await page.waitForFunction(() => !(document.querySelector("#problem") as HTMLElement).hidden);
  assert.match(
    await page.$eval("#problem", (one) => one.textContent ?? ""),
    /rubbish\.mcap is not an MCAP/,
  );
  assert.equal((await state()).recordings, 1);
  // one that a run left behind, cut in the middle
  await drop("cut.mcap.part", bytes.subarray(0, Math.floor(0.6 * bytes.length)));
  await page.waitForFunction(() => (document.querySelector("#problem") as HTMLElement).hidden);
  assert.ok((await state()).end > 1);
  const { end } = await state();
  await drop("whole.mcap", bytes);
  await page.waitForFunction(
    (before) => (window as unknown as Shown).limpet.state().end > before,
    {},
    end,
  );
});

test("a phone shows all of it, in the dark too", { skip }, async () => {
  await page.setViewport({ width: 375, height: 700 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }]);
  await seek(6);
  const wider = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
  assert.ok(wider <= 0, `${wider} px wider than the phone`);
  assert.ok((await colours()) > 15);
  await photograph("phone.png");
  await page.emulateMediaFeatures([]);
  await page.setViewport({ width: 1200, height: 800 });
});

test("accessible, as far as a machine can tell", { skip }, async () => {
  const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  const found = await page.evaluate(async (source) => {
    new Function(source)();
    const run = (
      window as unknown as {
        axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };
      }
    ).axe;
    return (await run.run()).violations.map(
      (one) => `${one.id}: ${one.nodes.map((node) => node.html).join(" ")}`,
    );
  }, axe);
  assert.deepEqual(found, []);
});

test("shapes do not pile up while it plays", { skip }, async () => {
  const { end } = await state();
  const sweep = async (): Promise<number> => {
    for (let t = 0; t <= end; t += end / 15) {
      await seek(t);
    }
    await seek(end / 2);
    return (await state()).geometries;
  };
  const first = await sweep();
  assert.ok((await sweep()) <= first, `${first} shapes, then more`);
});

test("opened again and again it holds no more than once", { skip }, async () => {
  const bytes = readFileSync(recording_file);
  const again = async (): Promise<State> => {
    const before = await page.evaluate(() => {
      const shown = window as unknown as Shown & { flight?: unknown };
      const now = shown.limpet as unknown as { recordings: unknown[] };
      shown.flight = now.recordings[0];
      return shown.limpet.state().pictures;
    });
    await drop("again.mcap", bytes);
    await page.waitForFunction(
      (n) => {
        const shown = window as unknown as Shown & { flight?: unknown };
        const now = shown.limpet as unknown as { recordings: unknown[] };
        return now.recordings[0] !== shown.flight && shown.limpet.state().pictures > n;
      },
      {},
      before,
    );
    await seek(6);
    return state();
  };
  const heap = async (): Promise<number> => {
    await page.evaluate(() => {
      (window as unknown as { flight?: unknown }).flight = undefined;
    });
    const session = await page.createCDPSession();
    await session.send("HeapProfiler.collectGarbage");
    const { usedSize } = await session.send("Runtime.getHeapUsage");
    await session.detach();
    return usedSize / 1e6;
  };
  const first = await again();
  const first_MB = await heap();
  let last = first;
  for (let i = 0; i < 19; ++i) {
    last = await again();
  }
  const last_MB = await heap();
  console.log(
    `opened 20 times: ${first.geometries} shapes and ${first_MB.toFixed(1)} MB of scripts' memory, ` +
      `then ${last.geometries} and ${last_MB.toFixed(1)} MB`,
  );
  assert.equal(last.geometries, first.geometries);
  assert.equal(last.textures, first.textures);
  assert.ok(last_MB < 1.2 * first_MB + 5, `${first_MB} MB, then ${last_MB} MB`);
});

test("says how many pictures a second it makes, and stands in full detail", { skip }, async () => {
  await page.click("[data-view=side]");
  await page.focus("#picture");
  await page.keyboard.press("Home");
  const { end } = await state();
  const drawn = async (count: number): Promise<void> => {
    const { pictures: from } = await state();
    await page.waitForFunction(
      (until) => {
        const { pictures, time } = (window as unknown as Shown).limpet.state();
        return pictures >= until || time > 20;
      },
      {},
      from + count,
    );
  };
  const dots = (): Promise<number> =>
    page.$eval("#picture", (canvas) => (canvas as HTMLCanvasElement).width / canvas.clientWidth);
  await page.keyboard.press("Space");
  await drawn(20); // until it has found out how many dots it has time for
  const { pictures: before } = await state();
  const { ScriptDuration: script_s = 0 } = await page.metrics();
  const began_ms = performance.now();
  await drawn(40);
  const { pictures, time } = await state();
  const past_s = 1e-3 * (performance.now() - began_ms);
  const { ScriptDuration: then_s = 0 } = await page.metrics();
  const moving = await dots();
  await page.keyboard.press("Space");
  await page.waitForFunction(() => {
    const canvas = document.querySelector("#picture") as HTMLCanvasElement;
    return canvas.width === canvas.clientWidth;
  });
  const made = pictures - before;
  console.log(
    `${(made / past_s).toFixed(1)} pictures a second of a flight of ${end.toFixed(0)} s, ` +
      `1200 px wide, drawn by software with ${moving.toFixed(2)} of the dots each way; ` +
      `${((1e3 * (then_s - script_s)) / made).toFixed(1)} ms of scripts a picture`,
  );
  assert.ok(time > 0 && made > 0);
});

test("it reported nothing and requested nothing", { skip }, () => {
  assert.deepEqual(problems, []);
});
