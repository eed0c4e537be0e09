// SPDX-License-Identifier: Apache-2.0
// Work of the server that takes a while: it is begun, followed to its end, and can be stopped.
import { button, element } from "./element";
import type { Wish } from "./server";

export interface JobHost {
  /** The scenario with its changes. */
  wish(): Wish;
  /** Shows the message of an error. */
  trying(does: () => Promise<void>): Promise<void>;
}

const kEvery_ms = 300;

export class Job {
  readonly bar: HTMLProgressElement;
  readonly status = element("output", { className: "status" });
  readonly stop: HTMLButtonElement;
  private following = false;

  /**
   * @param name   of the bar
   * @param title  of the button that stops it
   */
  constructor(
    private readonly host: JobHost,
    name: string,
    title: string,
    stop: () => Promise<void>,
  ) {
    this.bar = element("progress", { ariaLabel: name, value: 0 });
    this.stop = button("Stop", title, () => void host.trying(stop));
    this.stop.disabled = true;
  }
  get idle(): boolean {
    return !this.following;
  }
  show(running: boolean, done: number, all: number): void {
    this.stop.disabled = !running;
    this.bar.max = all;
    this.bar.value = done;
  }
  /** @param next  fetches the state; @returns whether it goes on */
  async follow(next: () => Promise<boolean>): Promise<void> {
    if (this.following) {
      return;
    }
    this.following = true;
    await this.host.trying(async () => {
      while (await next()) {
        await new Promise((passed) => setTimeout(passed, kEvery_ms));
      }
    });
    this.following = false;
  }
}
