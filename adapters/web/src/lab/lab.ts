// SPDX-License-Identifier: Apache-2.0
// Every parameter of a scenario as a slider; the flight follows.
import type { Recording } from "../recording/recording";
import { Changes, rounded, slide } from "./changes";
import {
  button,
  choice,
  download,
  element,
  field,
  labelled,
  messageOf,
  tabs,
  tools,
} from "./element";
import { Learn } from "./learn";
import { Live } from "./live";
import { Many } from "./many";
import { Reflights } from "./reflights";
import * as server from "./server";
import { Swing } from "./swing";

export interface LabHost {
  /** The first is the flight, the second its ghost; camera and time stay. */
  refresh(recordings: Recording[], brief?: boolean): void;
  /** Nothing follows at once: in full detail. */
  calm(): void;
  /** What is to be shown stands there, by all that draws. */
  drawn(): Promise<void>;
  /** A flight that is still flying, at its latest time until another is sought. */
  follow(recording: Recording): void;
  /** It has more to show; nothing happens where another one is looked at. */
  grown(recording: Recording): void;
  /** Shows a problem; empty: there is none. */
  report(text: string): void;
}

const kCalm_ms = 150; // a hand that stands still

/** Sections that users change most; the others follow. */
const kFirst = ["guidance", "environment", "vehicle.cup", "vehicle.slider", "wall.surface"];

export class Lab {
  private changes = Changes.from(location.hash);
  private readonly sections = element("div", { className: "sections" });
  private readonly choices = element("div", { className: "choices" });
  private readonly diff = element("ul", { className: "diff" });
  private readonly status = element("output", { className: "status" });
  private readonly search = element("input", {
    type: "search",
    placeholder: "Find a parameter",
    ariaLabel: "Find a parameter",
  });
  private catalogue: server.Catalogue | undefined;
  private readonly reflights: Reflights;
  private reporting: ReturnType<typeof setTimeout> | undefined;
  private building = 0; // requested and not there yet
  readonly many: Many;
  readonly learn: Learn;
  readonly swing: Swing;
  readonly live: Live;

  constructor(
    place: HTMLElement,
    private readonly host: LabHost,
  ) {
    this.search.addEventListener("input", () => this.filter());
    this.reflights = new Reflights({
      wish: () => this.wish(),
      trying: (does) => this.trying(does),
      watch: (recording, brief) => this.watch(recording, brief),
      drawn: () => this.host.drawn(),
      reflown: (recording, delay_ms) => this.reflown(recording, delay_ms),
      over: (brief) => this.reportLater(brief ? kCalm_ms : 0),
    });
    const row = tools(
      button("As it ships", "Forget all changes", () => this.reset()),
      button("Save YAML", "The scenario with its changes, as a file", () => void this.save()),
      button("Copy command", "The command line that flies this", () => void this.copy()),
    );
    const one = element("div", {}, this.diff, row, this.search, this.sections);
    this.many = new Many(this);
    this.learn = new Learn(this);
    this.swing = new Swing(this);
    this.live = new Live({
      trying: (does) => this.trying(does),
      follow: (recording) => this.host.follow(recording),
      grown: (recording) => this.host.grown(recording),
    });
    this.learn.element.append(this.swing.element);
    const heads = tabs("What to do", [
      { name: "One", panel: one },
      { name: "Many", panel: this.many.element, shown: () => this.many.shown() },
      {
        name: "Learn",
        panel: this.learn.element,
        shown: () => this.learn.shown(),
        seen: (seen) => this.swing.shown(seen),
      },
      { name: "Live", panel: this.live.element },
    ]);
    const panels = [one, this.many.element, this.learn.element, this.live.element];
    place.append(this.choices, this.status, heads, ...panels);
    void this.begin();
  }

  /** Over the flight that stands. */
  watch(recording: Recording, brief = false): void {
    const { stands } = this.reflights;
    this.host.refresh(stands === undefined ? [recording] : [recording, stands], brief);
  }
  wish(): server.Wish {
    return { scenario: this.changes.scenario, set: this.changes.list() };
  }
  private async begin(): Promise<void> {
    await this.trying(async () => {
      this.catalogue = await server.catalogue();
      this.changes.scenario ||= this.catalogue.scenario;
      await this.build();
      this.refly(false);
    });
  }
  async trying(does: () => Promise<void>): Promise<void> {
    try {
      await does();
      this.host.report("");
    } catch (problem) {
      this.host.report(messageOf(problem));
    }
  }

  /** Rows and choices of the scenario as it ships, with what is chosen by name. */
  private async build(): Promise<void> {
    const named = ["vehicle", "wall.surface"].flatMap((key) => {
      const value = this.changes.get(key);
      return value === undefined ? [] : [`${key}=${value}`];
    });
    this.building += 1;
    const schema = await server
      .schema({ scenario: this.changes.scenario, set: named })
      .finally(() => {
        this.building -= 1;
      });
    this.buildChoices(schema);
    this.many.offer(schema.sections, this.catalogue?.campaigns ?? []);
    this.swing.offer(schema.sections);
    const rank = (section: server.Section): number =>
      (kFirst.indexOf(section.name) + kFirst.length + 1) % (kFirst.length + 1);
    this.sections.replaceChildren(
      ...[...schema.sections]
        .sort((a, b) => rank(a) - rank(b))
        .filter((section) => section.rows.length + section.choices.length > 0)
        .map((section) => this.sectionOf(section)),
    );
    this.filter();
    this.showChanges();
  }
  private buildChoices(schema: server.Schema): void {
    const { catalogue } = this;
    if (catalogue === undefined) {
      return;
    }
    /** @param name  empty: as in the scenario */
    const choose = (key: string) => (name: string) => {
      if (name === "") {
        this.changes.drop(key);
      } else {
        this.changes.set(key, name);
      }
      this.rebuild();
    };
    const begin = (name: string): void => {
      this.changes.clear();
      this.changes.scenario = name;
      this.reflights.stands = undefined;
      this.rebuild();
    };
    const value = this.changes.get("seed") ?? schema.seed;
    const seed = field("number", { min: 0, step: "1", value });
    seed.addEventListener("change", () => {
      this.changes.set("seed", String(Math.max(0, Math.round(Number(seed.value)))));
      this.refly(false);
    });
    const { scenarios, surfaces } = catalogue;
    const vehicles = [{ name: "", description: "that of the scenario" }, ...catalogue.vehicles];
    const vehicle = this.changes.get("vehicle") ?? "";
    const surface = choice(surfaces, schema.surface, choose("wall.surface"));
    this.choices.replaceChildren(
      labelled("Scenario", choice(scenarios, this.changes.scenario, begin)),
      ...(schema.surface === "" ? [] : [labelled("Surface", surface)]),
      labelled("Vehicle", choice(vehicles, vehicle, choose("vehicle"))),
      labelled("Seed", seed),
    );
  }

  private sectionOf(section: server.Section): HTMLElement {
    const open = kFirst.slice(0, 1).includes(section.name);
    return element(
      "details",
      { open },
      element("summary", {}, section.name),
      ...section.choices.map((choice) => this.choiceOf(choice)),
      ...section.rows.map((row) => this.rowOf(row)),
    );
  }
  private choiceOf({ key, names, chosen }: server.Choice): HTMLElement {
    const list = choice(names, this.changes.get(key) ?? chosen, (name) =>
      this.change(key, name, chosen, false),
    );
    const made = element("div", { className: "row" });
    made.dataset.key = key;
    made.append(labelled(key.split(".").pop() ?? "", list));
    return made;
  }
  private rowOf(row: server.Row): HTMLElement {
    const name = row.key.split(".").pop() ?? row.key;
    const made = element("div", { className: "row", title: `${row.what}\n[${row.source}]` });
    made.dataset.key = row.key;
    const now = this.changes.get(row.key);
    if (row.kind === "switch") {
      const box = element("input", {
        type: "checkbox",
        checked: now === undefined ? row.value === 1 : now === "true",
      });
      const ships = row.value === 1 ? "true" : "false";
      box.addEventListener("change", () => this.change(row.key, String(box.checked), ships, false));
      made.append(element("label", {}, box, element("span", {}, name)));
    } else {
      const value = now === undefined ? row.value : Number(now);
      const [from, to] = slide(row.value, row.minimum, row.maximum);
      const step = row.kind === "count" ? "1" : "any";
      const ariaLabel = `${row.key}, slider`;
      const slider = field("range", { min: from, max: to, step, value, ariaLabel });
      const number = field("number", { min: row.minimum, max: row.maximum, step, value });
      const ships = String(row.value);
      const slid = (brief: boolean): void => {
        const to_take = rounded(Number(slider.value), from, to);
        number.value = String(to_take);
        this.change(row.key, number.value, ships, brief);
      };
      slider.addEventListener("input", () => slid(true));
      slider.addEventListener("change", () => slid(false));
      number.addEventListener("change", () => {
        slider.value = number.value;
        this.change(row.key, number.value, ships, false);
      });
      made.append(
        labelled(name, number, element("small", {}, row.unit)),
        slider,
        element("small", { className: "what" }, `${row.what} · ${row.minimum} to ${row.maximum}`),
      );
    }
    return made;
  }
  private filter(): void {
    const wanted = this.search.value.trim().toLowerCase();
    for (const details of this.sections.querySelectorAll("details")) {
      let any = false;
      for (const row of details.querySelectorAll<HTMLElement>(".row")) {
        const text = `${row.dataset.key} ${row.title}`.toLowerCase();
        row.hidden = wanted !== "" && !text.includes(wanted);
        any ||= !row.hidden;
      }
      details.hidden = !any;
      if (wanted !== "") {
        details.open = true;
      }
    }
  }

  private change(key: string, value: string, ships: string, brief: boolean): void {
    if (value === ships) {
      this.changes.drop(key);
    } else {
      this.changes.set(key, value);
    }
    this.refly(brief);
  }
  /** @param brief  a slider is moving: the others follow when it is let go */
  turn(values: [string, number][], brief: boolean): void {
    for (const [key, value] of values) {
      this.changes.set(key, String(value));
    }
    void this.trying(async () => {
      if (!brief) {
        await this.build();
      }
      this.refly(brief);
    });
  }
  private reset(): void {
    this.changes.clear();
    this.rebuild();
  }
  private rebuild(): void {
    void this.trying(() => this.build().then(() => this.refly(false)));
  }
  /** Not while a slider moves: an address that changes costs as much as a picture. */
  private reportLater(later_ms: number): void {
    clearTimeout(this.reporting);
    const report = (): void => {
      this.host.calm();
      this.showChanges();
      this.swing.changed();
    };
    if (later_ms > 0) {
      this.reporting = setTimeout(report, later_ms);
    } else {
      report();
    }
  }
  /** The changes, in the page's address and in a list. */
  private showChanges(): void {
    history.replaceState(
      null,
      "",
      `${location.pathname}${location.search}${this.changes.toHash()}`,
    );
    this.diff.replaceChildren(
      ...this.changes.list().map((text) => {
        const forget = button("×", `Forget ${text}`, () => {
          this.changes.drop(text.slice(0, text.indexOf("=")));
          this.rebuild();
        });
        return element("li", {}, text, forget);
      }),
    );
  }

  private refly(brief: boolean): void {
    clearTimeout(this.reporting);
    this.reflights.wish(brief);
  }
  private reflown({ outcome, duration }: Recording, delay_ms: number): void {
    this.status.textContent = `${outcome} after ${duration.toFixed(1)} s; re-flown in ${delay_ms.toFixed(0)} ms`;
  }

  private async save(): Promise<void> {
    await this.trying(async () => {
      const text = await server.yaml(this.wish());
      const file = URL.createObjectURL(new Blob([text], { type: "application/yaml" }));
      download(`${this.changes.scenario}_changed.yaml`, file);
      URL.revokeObjectURL(file);
    });
  }
  private async copy(): Promise<void> {
    await this.trying(() => navigator.clipboard.writeText(this.changes.command()));
    this.status.textContent = this.changes.command();
  }
  /** For tests and scripts. */
  state(): Record<string, unknown> {
    return {
      idle: this.reflights.idle && this.building === 0,
      changes: this.changes.list(),
      command: this.changes.command(),
      delays: [...this.reflights.delays],
    };
  }
}
