// SPDX-License-Identifier: Apache-2.0
// The swing on the cup while it waits for the release: its growth over two numbers of the scenario.
import { AxisChoice } from "./axis";
import { rounded } from "./changes";
import { about, button, element, field, tools } from "./element";
import { GrowthMap } from "./growth";
import { Job, type JobHost } from "./job";
import * as server from "./server";

export interface SwingHost extends JobHost {
  /** Numbers of the scenario take these values, and it is flown. */
  turn(values: [string, number][], brief: boolean): void;
}

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
  private readonly job: Job;
  private readonly map = new GrowthMap((across, up) =>
    this.host.turn([...this.numbers(this.across, across), ...this.numbers(this.up, up)], false),
  );
  private readonly sliders = [this.across, this.up].map((axis) => {
    const slider = field("range");
    const slid = (brief: boolean): void =>
      this.host.turn(this.numbers(axis, Number(slider.value)), brief);
    slider.addEventListener("input", () => slid(true));
    slider.addEventListener("change", () => slid(false));
    return { axis, slider, name: element("span") };
  });
  private readonly found = element("div", { className: "found", hidden: true });
  private state: server.SwingState | undefined;
  private seen = false;
  private stale = false; // since the vehicle's point was requested

  constructor(private readonly host: SwingHost) {
    this.job = new Job(host, "Points of the map", "Compute no more points", server.swingStop);
    for (const axis of [this.across, this.up]) {
      axis.element.addEventListener("change", () => this.changed());
    }
    this.element.append(
      element("h2", {}, "The swing on the cup"),
      about(
        "While it waits for the release: growth of the pitch swing by the linearised loop, noise and gusts left out. Orange grows, blue decays; the ring is the vehicle as it is. A click on the map turns both numbers.",
      ),
      this.across.element,
      this.up.element,
      tools(
        button("Draw the map", "Growth at each of these values", () => this.begin()),
        this.job.stop,
      ),
      this.job.bar,
      this.job.status,
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
  /** The latest wish, then its state until all points are there. */
  private follow(): Promise<void> {
    const wanted = (axis: AxisChoice) => ({ keys: axis.keys, ...axis.range() });
    return this.job.follow(async () => {
      const { stale } = this;
      this.stale = false;
      this.take(
        stale
          ? await server.swingBegin({
              ...this.host.wish(),
              across: wanted(this.across),
              up: wanted(this.up),
            })
          : await server.swingState(),
      );
      return this.stale || this.state?.running === true;
    });
  }
  private take(state: server.SwingState): void {
    this.state = state;
    this.job.show(state.running, state.done, state.growth_1_s.length);
    const none = state.growth_1_s.filter((growth) => growth === "none").length;
    const { growth_1_s, frequency_Hz } = state.own;
    const own =
      growth_1_s === null || frequency_Hz === null
        ? "This vehicle has no rest level on its cup, or no swing."
        : `This vehicle: ${growth_1_s > 0 ? "grows" : "decays"}, ${growth_1_s > 0 ? "+" : ""}${growth_1_s.toFixed(3)} 1/s at ${frequency_Hz.toFixed(2)} Hz.`;
    this.job.status.textContent = [
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
  /** For tests and scripts. */
  outside(): Record<string, unknown> {
    return {
      idle: this.job.idle,
      ...this.state,
      place: this.map.own(),
    };
  }
}
