// SPDX-License-Identifier: Apache-2.0
// A hand moves a slider; the scenario is flown again and again, as fast as pictures come.
import { kColumns } from "../charts/panels";
import { kSceneTopics, type Recording, readRecording } from "../recording/recording";
import type { JobHost } from "./job";
import * as server from "./server";

/** Where the time goes from a hand to the picture [ms]. */
export interface Delay {
  all: number;
  waits: number; // until the flight before is there
  flight: number; // in the server: it is read, flown, recorded
  way: number; // the rest of the request
  reading: number;
  scene: number; // and charts
  picture: number; // until it has been drawn
}

export interface ReflightsHost extends JobHost {
  /** Over the flight that stands. @param brief  others follow at once */
  watch(recording: Recording, brief: boolean): void;
  /** What is watched stands there. */
  drawn(): Promise<void>;
  reflown(recording: Recording, delay_ms: number): void;
  /** A wish is over, whatever came of it. */
  over(brief: boolean): void;
}

export class Reflights {
  /** The flight that others are laid over. */
  stands: Recording | undefined;
  /** Of the latest re-flights. */
  readonly delays: Delay[] = [];
  private busy = false;
  private wanted: { brief: boolean; since: number } | undefined;

  constructor(private readonly host: ReflightsHost) {}

  get idle(): boolean {
    return !this.busy && this.wanted === undefined && this.stands !== undefined;
  }
  /**
   * The latest wish is flown when the last flight is there; what came between is not.
   * @param brief  a slider is moving: what a picture needs. Otherwise that first, then all.
   */
  wish(brief: boolean): void {
    this.wanted = { brief, since: this.wanted?.since ?? performance.now() };
    if (!this.busy) {
      void this.flyWanted();
    }
  }
  private async flyWanted(): Promise<void> {
    this.busy = true;
    while (this.wanted !== undefined) {
      const { brief, since } = this.wanted;
      this.wanted = undefined;
      await this.host.trying(async () => {
        const recording = await this.fly(true, since);
        this.host.reflown(recording, this.delays.at(-1)?.all ?? 0);
        if (!brief && this.wanted === undefined) {
          this.stands = await this.fly(false, since);
        }
      });
      this.host.over(brief);
    }
    this.busy = false;
  }
  /** @param since  the hand moved, on the page's clock [ms] */
  private async fly(brief: boolean, since: number): Promise<Recording> {
    const wish = this.host.wish();
    const sent = performance.now();
    const { bytes, flight } = await server.fly({
      ...wish,
      ...(brief ? { brief, topics: [...kSceneTopics, ...kColumns.keys()] } : {}),
    });
    const came = performance.now();
    const recording = readRecording(wish.scenario, bytes, kColumns);
    const read = performance.now();
    this.host.watch(recording, brief);
    const shown = performance.now();
    await this.host.drawn();
    if (brief) {
      const now = performance.now();
      this.delays.push({
        all: now - since,
        waits: sent - since,
        flight,
        way: came - sent - flight,
        reading: read - came,
        scene: shown - read,
        picture: now - shown,
      });
      this.delays.splice(0, this.delays.length - 500);
    }
    return recording;
  }
}
