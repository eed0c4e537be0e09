// SPDX-License-Identifier: Apache-2.0
// The swing on the cup while it waits for the release: its growth over two numbers of the scenario.
import { AxisChoice } from "./axis";
import { rounded } from "./changes";
import { button, element } from "./element";
import { GrowthMap } from "./growth";
import * as server from "./server";

export interface SwingHost {
  wish(): server.Wish;
  trying(does: () => Promise<void>): Promise<void>;
  /** Numbers of the scenario take these values, and it is flown. */
  turn(values: [string, number][], brief: boolean): void;
}

const kEvery_ms = 300;

export class Swing {
  readonly element = element("section", { className: "swing", ariaLabel: "The swing on the cup" });
  private readonly across = new AxisChoice("Across", {
    count: 16,
    otherwise: "vehicle.rotor.time_constant_up_s vehicle.rotor.time_constant_down_s",
    together: [
      {
        name: "motors' lag",
        keys: ["vehicle.rotor.time_constant_up_s", "vehicle.rotor.time_constant_down_s"],
      },
    ],
  });
  private readonly up = new AxisChoice("Up", { count: 12, otherwise: "autopilot.MC_PITCHRATE_I" });
  private readonly bar = element("progress", { ariaLabel: "Points of the map", value: 0 });
  private readonly told = element("output", { className: "status" });
  private readonly map = new GrowthMap((across, up) =>
    this.host.turn([...this.numbers(this.across, across), ...this.numbers(this.up, up)], false),
  );
  private readonly sliders = [this.across, this.up].map((axis) => {
    const slider = element("input", { type: "range", step: "any" });
    const slid = (brief: boolean): void =>
      this.host.turn(this.numbers(axis, Number(slider.value)), brief);
    slider.addEventListener("input", () => slid(true));
    slider.addEventListener("change", () => slid(false));
    return { axis, slider, name: element("span") };
  });
  private readonly found = element("div", { className: "found", hidden: true });
  private readonly stop = button("Stop", "Work out no more points", () => void this.end());
  private state: server.SwingState | undefined;
  private seen = false;
  private stale = false; // since the vehicle's point was asked for
  private asking = false;

  constructor(private readonly host: SwingHost) {
    this.stop.disabled = true;
    for (const axis of [this.across, this.up]) {
      axis.element.addEventListener("change", () => this.changed());
    }
    this.element.append(
      element("h2", {}, "The swing on the cup"),
      element(
        "p",
        { className: "what" },
        "While it waits for the release: growth of the pitch swing by the linearised loop, noise and gusts left out. Orange grows, blue decays; the ring is the vehicle as it is. A click on the map turns both numbers.",
      ),
      this.across.element,
      this.up.element,
      element(
        "div",
        { className: "tools" },
        button("Draw the map", "Growth at each of these values", () => this.begin()),
        this.stop,
      ),
      this.bar,
      this.told,
      this.found,
    );
    this.found.append(
      this.map.canvas,
      ...this.sliders.map(({ name, slider }) => element("label", {}, name, slider)),
    );
  }
  offer(sections: server.Section[]): void {
    this.across.offer(sections);
    this.up.offer(sections);
  }
  /** @param seen  the tab is */
  shown(seen: boolean): void {
    this.seen = seen;
    if (seen && this.stale) {
      this.begin();
    }
  }
  /** Numbers of the scenario have: a map that is there follows, once it is seen. */
  changed(): void {
    if (this.state === undefined) {
      return;
    }
    this.stale = true;
    if (this.seen) {
      this.begin();
    }
  }
  private begin(): void {
    this.stale = true;
    void this.follow();
  }
  private numbers(axis: AxisChoice, value: number): [string, number][] {
    const { from, to } = axis.range();
    return axis.keys.map((key) => [key, rounded(value, from, to)]);
  }
  private async end(): Promise<void> {
    await this.host.trying(() => server.swingStop());
  }
  /** The latest wish, then how far it is until all is there. */
  private async follow(): Promise<void> {
    if (this.asking) {
      return;
    }
    this.asking = true;
    await this.host.trying(async () => {
      for (let running = true; running || this.stale; ) {
        if (this.stale) {
          this.stale = false;
          const [across, up] = [this.across, this.up].map((axis) => ({
            keys: axis.keys,
            ...axis.range(),
          }));
          this.take(
            await server.swingBegin({
              ...this.host.wish(),
              across: across as server.SwingWishAxis,
              up: up as server.SwingWishAxis,
            }),
          );
        } else {
          await new Promise((passed) => setTimeout(passed, kEvery_ms));
          this.take(await server.swingState());
        }
        running = this.state?.running === true;
      }
    });
    this.asking = false;
  }
  private take(state: server.SwingState): void {
    this.state = state;
    this.stop.disabled = !state.running;
    this.bar.max = state.growth_1_s.length;
    this.bar.value = state.done;
    const none = state.growth_1_s.filter((growth) => growth === "none").length;
    const { growth_1_s, frequency_Hz } = state.own;
    const own =
      growth_1_s === null || frequency_Hz === null
        ? "This vehicle has no rest level on its cup, or no swing."
        : `This vehicle: ${growth_1_s > 0 ? "grows" : "decays"}, ${growth_1_s > 0 ? "+" : ""}${growth_1_s.toFixed(3)} 1/s at ${frequency_Hz.toFixed(2)} Hz.`;
    this.told.textContent = [
      own,
      `${state.done} of ${state.growth_1_s.length} points${none > 0 ? `, ${none} without a rest or a swing` : ""}`,
    ].join("\n");
    this.found.hidden = false;
    for (const { axis, slider, name } of this.sliders) {
      const { keys, values, own } = axis === this.across ? state.across : state.up;
      name.textContent = axis.name;
      if (keys.join() === axis.keys.join() && document.activeElement !== slider) {
        slider.min = String(values[0]);
        slider.max = String(values[values.length - 1]);
        slider.value = String((Math.min(...own) + Math.max(...own)) / 2);
      }
    }
    this.map.canvas.ariaLabel = `Growth over ${this.across.name} and ${this.up.name}. ${own}`;
    this.map.show(state, [this.across.name, this.up.name]);
  }
  /** For those who look at the page from outside. */
  outside(): Record<string, unknown> {
    return {
      idle: !this.asking,
      ...this.state,
      place: this.map.own(),
    };
  }
}
