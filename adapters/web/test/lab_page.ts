// SPDX-License-Identifier: Apache-2.0
// `limpet lab` in a real browser, for the tests of one file: LIMPET_PROGRAM is the program.
// LIMPET_PICTURES: a folder for what it looked like.
import assert from "node:assert/strict";
import { type ChildProcess, spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before } from "node:test";
import type { Browser, Page } from "puppeteer-core";
import type { Delay } from "../src/lab/reflights";
import { hasChromium, openChromium } from "./chromium";
import { program } from "./flight";

export const skip = program === "" ? "no LIMPET_PROGRAM" : !hasChromium ? "no Chromium" : false;

export interface LabState {
  idle: boolean;
  changes: string[];
  command: string;
  delays: Delay[];
}
export interface PageState {
  recordings: number;
  end: number;
  time: number;
  geometries: number;
  charts: number;
  following: boolean;
  vehicle: { seen: boolean };
}
interface Shown {
  limpet: { state(): PageState };
  lab: { state(): LabState };
}

let served: ChildProcess;
let address = "";
export let browser: Browser;
export let page: Page;
/** Messages of the page, and requests that it should not make. */
export const problems: string[] = [];

/** @param mayAsk  beginnings of addresses other than its server that it may request */
export function useLab(scenario: string, mayAsk: string[] = []): void {
  before(async () => {
    if (skip === false) {
      await open(scenario, mayAsk);
    }
  });
  after(close);
}

async function open(scenario: string, mayAsk: string[]): Promise<void> {
  served = spawn(program, ["lab", scenario], { stdio: ["ignore", "pipe", "inherit"] });
  address = await new Promise((found, failed) => {
    let text = "";
    served.once("exit", () => failed(new Error(`limpet lab ended: ${text}`)));
    served.stdout?.on("data", (bytes: Buffer) => {
      text += bytes.toString();
      const here = /http:\S+/.exec(text);
      if (here !== null) {
        found(here[0]);
      }
    });
  });
  browser = await openChromium();
  page = await browser.newPage();
  page.setDefaultTimeout(120000);
  page.on("console", (message) => {
    if (!/GPU stall|swiftshader|WebGL|status of 400/i.test(message.text())) {
      problems.push(message.text());
    }
  });
  page.on("pageerror", (problem) => problems.push(String(problem)));
  page.on("request", (request) => {
    const may = [new URL(address).origin, "data:", "blob:", ...mayAsk];
    if (!may.some((beginning) => request.url().startsWith(beginning))) {
      problems.push(`requests ${request.url()}`);
    }
  });
  await page.setViewport({ width: 1400, height: 860 });
  await page.goto(address);
  await idle();
}
async function close(): Promise<void> {
  await browser?.close();
  if (served !== undefined) {
    const ended = new Promise((code) => served.once("exit", code));
    served.kill("SIGINT");
    assert.equal(await ended, 0);
  }
}

export const idle = (): Promise<unknown> =>
  page.waitForFunction(() => (window as unknown as Shown).lab?.state().idle === true);
export const lab = (): Promise<LabState> =>
  page.evaluate(() => (window as unknown as Shown).lab.state());
export const shown = (): Promise<PageState> =>
  page.evaluate(() => (window as unknown as Shown).limpet.state());
export async function picture(name: string): Promise<void> {
  if (process.env.LIMPET_PICTURES !== undefined) {
    writeFileSync(join(process.env.LIMPET_PICTURES, name), await page.screenshot());
  }
}
/** As a hand does it: some moves, then the release. */
export async function drag(key: string, values: number[]): Promise<void> {
  for (const [k, value] of values.entries()) {
    await page.evaluate(
      (row, to, last) => {
        const slider = document.querySelector<HTMLInputElement>(
          `[data-key="${row}"] input[type=range]`,
        ) as HTMLInputElement;
        slider.value = String(to);
        slider.dispatchEvent(new Event(last ? "change" : "input", { bubbles: true }));
      },
      key,
      value,
      k === values.length - 1,
    );
    await idle();
  }
}

export const tab = (name: string, on = page): Promise<void> =>
  on.evaluate((wanted) => {
    [...document.querySelectorAll<HTMLElement>("#lab [role=tab]")]
      .find((one) => one.textContent === wanted)
      ?.click();
  }, name);
export async function press(text: string): Promise<void> {
  const clicked = await page.evaluate((wanted) => {
    const found = [
      ...document.querySelectorAll<HTMLElement>("#lab .many:not([hidden]) button"),
    ].find((one) => one.textContent === wanted);
    found?.click();
    return found !== undefined;
  }, text);
  assert.ok(clicked, `no button ${text}`);
}
/** What axe-core finds that not everybody can read. */
export async function unreadable(): Promise<string[]> {
  await page.evaluate(
    readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"),
  );
  return page.evaluate(async () => {
    const found = await (
      window as unknown as {
        axe: { run(): Promise<{ violations: { id: string; nodes: { html: string }[] }[] }> };
      }
    ).axe.run();
    return found.violations.map((one) => `${one.id}: ${one.nodes[0]?.html}`);
  });
}
