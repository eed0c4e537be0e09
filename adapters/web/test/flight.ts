// SPDX-License-Identifier: Apache-2.0
// A flight that waits to be watched, for tests: LIMPET_PROGRAM is the program.
import assert from "node:assert/strict";
import { type ChildProcess, spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after } from "node:test";

export const program = process.env.LIMPET_PROGRAM ?? "";
const folder = mkdtempSync(join(tmpdir(), "limpet_flights_"));
const flights: Flight[] = [];
after(() => {
  for (const flight of flights) {
    flight.kill();
  }
  rmSync(folder, { recursive: true, force: true });
});

export class Flight {
  private readonly process: ChildProcess;
  private readonly ended: Promise<number | null>;
  private errors = ""; // with --json all but the result is on standard error
  private result = "";

  constructor(speed: number, ...more: string[]) {
    this.process = spawn(program, [
      ...["fly", "perch_concrete", "--live", "0", "--live-wait", "--speed", `${speed}`, "--json"],
      ...["--out", join(folder, `${flights.length}`), ...more],
    ]);
    flights.push(this);
    this.process.stderr?.on("data", (text) => {
      this.errors += text;
    });
    this.process.stdout?.on("data", (text) => {
      this.result += text;
    });
    this.ended = new Promise((done) => {
      this.process.on("close", done);
    });
  }
  /** The line with its address. */
  async line(): Promise<string> {
    for (;;) {
      const found = /^.*ws:\/\/.*$/m.exec(this.errors);
      if (found !== null) {
        return found[0];
      }
      assert.equal(this.process.exitCode, null, this.errors);
      await new Promise((done) => setTimeout(done, 5));
    }
  }
  async address(): Promise<string> {
    return /ws:\/\/\S+/.exec(await this.line())?.[0] ?? "";
  }
  async end(): Promise<{ outcome: string; reason: string; hash: string }> {
    assert.equal(await this.ended, 0, this.errors);
    return JSON.parse(this.result);
  }
  kill(): void {
    this.process.kill("SIGKILL");
  }
  /** What it printed for a person. */
  get text(): string {
    return this.errors;
  }
}
