// SPDX-License-Identifier: Apache-2.0
// Which parameters a number of the flight depends on: each is changed alone, down and up.
import { about, button, element, field, labelled, options, tools } from "./element";
import { Job, type JobHost } from "./job";
import * as server from "./server";

const kBars = 15;
const kUsual = "impact_force_N";

interface Bar {
  key: string;
  less: number | undefined; // of the number, against the flight as it is
  more: number | undefined;
  row: server.LearnRow;
}

/** The parameters that move `metric` most, the strongest first. */
export function strongest(state: server.LearnState, metric: string, count: number): Bar[] {
  const at = state.metrics.indexOf(metric);
  const base = state.base?.metrics[at] ?? null;
  if (base === null) {
    return [];
  }
  const change = ({ metrics }: server.LearnFlight): number | undefined => {
    const value = metrics[at] ?? null;
    return value === null ? undefined : value - base;
  };
  const size = ({ less, more }: Bar): number => Math.max(Math.abs(less ?? 0), Math.abs(more ?? 0));
  return state.rows
    .map((row) => ({ key: row.key, less: change(row.less), more: change(row.more), row }))
    .filter((bar) => size(bar) > 0)
    .sort((a, b) => size(b) - size(a))
    .slice(0, count);
}

export class Learn {
  readonly element = element("div", { className: "many learn" });
  private readonly share = field("number", { min: 0.1, max: 90, value: 10 });
  private readonly metric = element("select", {});
  private readonly job: Job;
  private readonly bars = element("ol", { className: "bars" });
  private readonly broken = element("p", { className: "what" });
  private state: server.LearnState | undefined;

  constructor(private readonly host: JobHost) {
    this.job = new Job(host, "Flights flown", "Begin no more flights", server.learnStop);
    this.metric.addEventListener("change", () => this.draw());
    const fly = button("Turn them all", "Two flights for each number of the scenario", () =>
      this.begin(),
    );
    this.element.append(
      about(
        "The scenario above with its changes; each of its numbers turned alone, less and more, with the same random numbers.",
      ),
      labelled("Turned by", this.share, "%"),
      tools(fly, this.job.stop),
      this.job.bar,
      this.job.status,
      labelled("What it does to", this.metric),
      this.bars,
      this.broken,
    );
  }
  shown(): void {
    void this.follow();
  }
  private async begin(): Promise<void> {
    await this.host.trying(async () => {
      const share = Number(this.share.value) / 100;
      this.take(await server.learnBegin({ ...this.host.wish(), share }));
    });
    void this.follow();
  }
  private follow(): Promise<void> {
    return this.job.follow(async () => {
      this.take(await server.learnState());
      return this.state?.running === true;
    });
  }
  private take(state: server.LearnState): void {
    if (state.id === 0) {
      return;
    }
    this.state = state;
    this.job.show(state.running, state.flown, state.flights);
    if (this.metric.options.length === 0) {
      this.metric.replaceChildren(...options(state.metrics));
      this.metric.value = kUsual;
    }
    this.draw();
  }
  private draw(): void {
    const { state } = this;
    if (state === undefined) {
      return;
    }
    const metric = this.metric.value;
    const base = state.base?.metrics[state.metrics.indexOf(metric)] ?? null;
    const ended = !state.running && state.flown < state.flights ? ", stopped" : "";
    const now =
      base === null
        ? `${metric} did not come to pass in the flight as it is`
        : `${metric} of the flight as it is: ${text(base)}`;
    this.job.status.textContent = `${state.flown} of ${state.flights} flights${ended}\n${now}`;
    const bars = strongest(state, metric, kBars);
    const most = bars.reduce(
      (size, { less, more }) => Math.max(size, Math.abs(less ?? 0), Math.abs(more ?? 0)),
      0,
    );
    this.bars.replaceChildren(...bars.map((bar) => itemOf(bar, most)));
    const others = state.rows.flatMap(({ key, less, more }) =>
      [less, more]
        .filter(({ outcome }) => outcome !== state.base?.outcome)
        .map(({ outcome, value }) => `${key} = ${text(value)}: ${outcome}`),
    );
    this.broken.textContent =
      others.length === 0 ? "" : `Other endings than ${state.base?.outcome}: ${others.join("; ")}`;
  }
  /** For tests and scripts. */
  outside(): Record<string, unknown> {
    const bars = this.state === undefined ? [] : strongest(this.state, this.metric.value, kBars);
    return {
      running: this.state?.running ?? false,
      flown: this.state?.flown ?? 0,
      flights: this.state?.flights ?? 0,
      bars: bars.map(({ key, less, more }) => ({ key, less, more })),
    };
  }
}

const text = (value: number): string => String(Number(value.toPrecision(4)));

function itemOf({ key, less, more, row }: Bar, most: number): HTMLElement {
  const strip = (change: number | undefined, name: string): HTMLElement => {
    const part = element("i", { className: name });
    const width = (50 * Math.abs(change ?? 0)) / most;
    part.style.width = `${width}%`;
    part.style.left = `${(change ?? 0) < 0 ? 50 - width : 50}%`;
    return part;
  };
  const line = ({ value }: server.LearnFlight, change: number | undefined): string =>
    `${text(value)} ${row.unit}: ${change === undefined ? "none" : `${change > 0 ? "+" : ""}${text(change)}`}`;
  return element(
    "li",
    {},
    element("strong", {}, key),
    element("div", { className: "strip" }, strip(less, "less"), strip(more, "more")),
    element("small", {}, `${line(row.less, less)} · ${line(row.more, more)}`),
  );
}
