// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium as it is on a machine without a graphics card: WebGL by a renderer in software, all
// other drawing by itself (charts by that renderer too: 30 re-flights in the lab took 28 s, without 4).
import { existsSync } from "node:fs";
import puppeteer, { type Browser } from "puppeteer-core";

const program = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find((path) => existsSync(path));
export const hasChromium = program !== undefined;

export const openChromium = (): Promise<Browser> =>
  puppeteer.launch({
    executablePath: program as string,
    args: [
      "--no-sandbox",
      "--use-gl=angle",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-accelerated-2d-canvas",
    ],
  });
