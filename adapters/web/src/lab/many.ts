// SPDX-License-Identifier: Apache-2.0
// A campaign flown from the page: its map fills while it flies, each point is a flight to look at.
import { kColumns } from "../charts/panels";
import { type Recording, readRecording } from "../recording/recording";
import { AxisChoice } from "./axis";
import { button, element, field, labelled, options, tools } from "./element";
import { Job, type JobHost } from "./job";
import { type AxisOf, drawMark, SuccessMap, type Value } from "./map";
import * as server from "./server";

export interface ManyHost extends JobHost {
  watch(recording: Recording): void;
}

const kOwn = ""; // not a campaign that ships: the scenario over axes

export class Many {
  readonly element = element("div", { className: "many" });
  private readonly campaign = element("select", {});
  private readonly about = element("p", { className: "what" });
  private readonly axes = [
    new AxisChoice("Along", { count: 6, otherwise: "guidance.dock_speed_m_s", none: true }),
    new AxisChoice("and along", { count: 6, otherwise: "", none: true }),
  ] as const;
  private readonly repeats = field("number", { min: 1, step: "1", value: 10 });
  private readonly own: HTMLElement;
  private readonly job: Job;
  private readonly across = element("select", { ariaLabel: "Across the map" });
  private readonly up = element("select", { ariaLabel: "Up the map" });
  private readonly legend = element("ul", { className: "legend" });
  private readonly map = new SuccessMap((run) => void this.look(run));
  private readonly run = field("number", { min: 0, step: "1", value: 0 });
  private readonly found = element("div", { className: "found", hidden: true });
  private campaigns: server.Named[] = [];
  private state: server.ManyState | undefined;
  private rows: server.ManyRow[] = [];
  private looked: { run: number; outcome: string; end: number } | undefined;

  constructor(private readonly host: ManyHost) {
    this.job = new Job(host, "Runs flown", "Begin no more flights", server.manyStop);
    this.own = element(
      "div",
      {},
      ...this.axes.map((axis) => axis.element),
      labelled("Runs at each", this.repeats),
    );
    this.campaign.addEventListener("change", () => this.describe());
    for (const select of [this.across, this.up]) {
      select.addEventListener("change", () => this.draw());
    }
    const fly = button("Fly them", "Begin this campaign", () => void this.begin());
    const look = button("Look", "Fly this run again and show it", () =>
      this.look(Number(this.run.value)),
    );
    this.found.append(
      tools(labelled("Across", this.across)),
      tools(labelled("Up", this.up)),
      this.map.canvas,
      this.legend,
      tools(labelled("Run", this.run), look),
    );
    this.element.append(
      labelled("Campaign", this.campaign),
      this.about,
      this.own,
      tools(fly, this.job.stop),
      this.job.bar,
      this.job.status,
      this.found,
    );
  }
  /** What can be flown. */
  offer(sections: server.Section[], campaigns: server.Named[]): void {
    const before = this.campaign.value;
    this.campaigns = campaigns;
    this.campaign.replaceChildren(
      element("option", { value: kOwn }, "this scenario over its parameters"),
      ...options(campaigns.map(({ name }) => name)),
    );
    this.campaign.value = before;
    for (const axis of this.axes) {
      axis.offer(sections);
    }
    this.describe();
  }
  /** The tab is seen: a campaign may have been flying since before the page was opened. */
  shown(): void {
    this.map.draw();
    void this.follow();
  }
  private describe(): void {
    const { value } = this.campaign;
    this.own.hidden = value !== kOwn;
    this.about.textContent =
      value === kOwn
        ? "The scenario above with the changes made to it."
        : (this.campaigns.find(({ name }) => name === value)?.description ?? "");
  }

  private async begin(): Promise<void> {
    await this.host.trying(async () => {
      const { value } = this.campaign;
      this.take(
        await server.manyBegin(
          value !== kOwn
            ? { campaign: value }
            : {
                ...this.host.wish(),
                axes: this.axes.flatMap((axis) => axis.axis()),
                repeats: Math.round(Number(this.repeats.value)),
              },
        ),
        0,
      );
    });
    void this.follow();
  }
  /** Until the campaign has ended and all its rows are here. */
  private follow(): Promise<void> {
    return this.job.follow(async () => {
      const from = this.rows.length;
      this.take(await server.manyRows(from), from);
      return this.state?.running === true || this.rows.length < (this.state?.finished ?? 0);
    });
  }
  /** @param from  how many of its rows were here at the request */
  private take(state: server.ManyState, from: number): void {
    if (state.id === 0) {
      return;
    }
    const another = state.id !== this.state?.id;
    if (another) {
      this.rows = [];
    }
    this.state = state;
    const fits = from === this.rows.length; // else it is requested again
    if (fits) {
      this.rows.push(...state.rows);
    }
    if (another) {
      this.offerAxes(state);
      this.map.chosen = undefined;
      this.looked = undefined;
    }
    this.found.hidden = false;
    this.job.show(state.running, state.finished, state.runs);
    if (another || (fits && state.rows.length > 0)) {
      this.draw();
    }
    this.report(state);
  }
  private report(state: server.ManyState): void {
    const { success } = state;
    const left = state.running ? `, ${Math.ceil(state.left_s)} s left` : "";
    const ended = !state.running && state.finished < state.runs ? ", stopped" : "";
    this.job.status.textContent = [
      `${state.name}, ${state.scenario}: ${state.finished} of ${state.runs} runs${left}${ended}`,
      `${success.outcomes.join(" or ")}: ${success.runs} of ${state.finished}, probability ${success.low.toFixed(2)} to ${success.high.toFixed(2)} (95 %)`,
      ...(state.folder === "" ? [] : [`kept in ${state.folder}`]),
      ...(state.problem === "" ? [] : [state.problem]),
    ].join("\n");
  }
  private offerAxes(state: server.ManyState): void {
    const names = [...state.keys.map(({ key }) => key), "repeat", ...state.metrics];
    for (const select of [this.across, this.up]) {
      select.replaceChildren(...options(names));
    }
    this.across.value = names[0] ?? "repeat";
    this.up.value = names[1] ?? "repeat";
  }
  private axisOf(name: string): [AxisOf, (row: server.ManyRow) => Value] {
    const { state } = this;
    const key = state?.keys.findIndex((one) => one.key === name) ?? -1;
    if (key >= 0) {
      return [{ name, values: state?.keys[key]?.values ?? [] }, (row) => row.values[key] ?? null];
    }
    const metric = state?.metrics.indexOf(name) ?? -1;
    return metric >= 0
      ? [{ name, values: [] }, (row) => row.metrics[metric] ?? null]
      : [{ name, values: [] }, (row) => Math.floor(row.run / (state?.points ?? 1))];
  }
  private draw(): void {
    const [x, xOf] = this.axisOf(this.across.value);
    const [y, yOf] = this.axisOf(this.up.value);
    this.map.show(
      [x, y],
      this.rows.map((row) => ({ ...row, x: xOf(row), y: yOf(row) })),
    );
    const counts = new Map<
      string,
      { outcome: string; name: string; success: boolean; runs: number }
    >();
    for (const { outcome, success } of this.rows) {
      const untrue = !success && (this.state?.success.outcomes.includes(outcome) ?? false);
      const name = untrue ? `${outcome}, but not in truth` : outcome;
      const count = counts.get(name) ?? { outcome, name, success, runs: 0 };
      count.runs += 1;
      counts.set(name, count);
    }
    this.legend.replaceChildren(
      ...[...counts.values()]
        .sort((a, b) => b.runs - a.runs)
        .map((count) => {
          const sign = element("canvas", { width: 12, height: 12, ariaHidden: "true" });
          const context = sign.getContext("2d");
          if (context !== null) {
            drawMark(context, count, 6, 6);
          }
          return element("li", {}, sign, ` ${count.name} ${count.runs}`);
        }),
    );
    this.map.canvas.ariaLabel = `${this.rows.length} runs, ${x.name} across, ${y.name} up: ${[
      ...counts.values(),
    ]
      .map(({ name, runs }) => `${runs} ${name}`)
      .join(", ")}`;
  }
  /** The server flies it to the state hash of its row, or reports that it cannot. */
  private async look(run: number): Promise<void> {
    const { state } = this;
    await this.host.trying(async () => {
      const row = this.rows.find((one) => one.run === run);
      if (state === undefined || row === undefined) {
        throw new Error(`run ${run} is not there (yet)`);
      }
      const bytes = await server.manyFlight(state.id, run);
      const recording = readRecording(`run ${run}`, bytes, kColumns);
      this.host.watch(recording);
      this.run.value = String(run);
      this.map.chosen = run;
      this.map.draw();
      this.looked = { run, outcome: recording.outcome, end: recording.duration };
      this.job.status.textContent = [
        `run ${run}: ${row.outcome}${row.reason === "" ? "" : `, ${row.reason}`}; in truth ${row.true_end}`,
        ...state.keys.map(({ key }, k) => `${key} = ${row.values[k]}`),
      ].join("\n");
    });
  }
  /** For tests and scripts. */
  outside(): Record<string, unknown> {
    return {
      id: this.state?.id ?? 0,
      running: this.state?.running ?? false,
      runs: this.state?.runs ?? 0,
      rows: this.rows,
      looked: this.looked,
      places: this.rows.map(({ run }) => this.map.placeOf(run)),
    };
  }
}
