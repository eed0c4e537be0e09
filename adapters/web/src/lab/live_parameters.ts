// SPDX-License-Identifier: Apache-2.0
// The parameters that a flight in progress lets viewers set. The flight checks each value; the page shows those that hold.
import type { Parameter } from "../recording/live";
import { element, field, labelled } from "./element";

interface Row {
  row: HTMLElement;
  input: HTMLInputElement;
}

export class Parameters {
  private readonly list = element("div");
  private readonly search = element("input", {
    type: "search",
    placeholder: "Find a parameter",
    ariaLabel: "Find a parameter of the flight",
  });
  readonly element = element(
    "details",
    { hidden: true },
    element("summary", {}, "Parameters"),
    this.search,
    this.list,
  );
  private readonly rows = new Map<string, Row>();

  constructor(private readonly set: (name: string, value: number) => void) {
    this.search.addEventListener("input", () => this.filter());
  }
  clear(): void {
    this.rows.clear();
    this.list.replaceChildren();
    this.element.hidden = true;
  }
  enable(enabled: boolean): void {
    for (const { input } of this.rows.values()) {
      input.disabled = !enabled;
    }
  }
  take(changed: Parameter[]): void {
    for (const parameter of changed.filter(({ settable }) => settable === true)) {
      const row = this.rows.get(parameter.name) ?? this.make(parameter);
      row.input.value = String(Number(parameter.value.toPrecision(6)));
    }
    this.element.hidden = this.rows.size === 0;
    this.filter();
  }
  private make({ name, minimum, maximum }: Parameter): Row {
    const input = field("number");
    input.addEventListener("change", () => this.set(name, Number(input.value)));
    const row = element(
      "div",
      { className: "row", title: `${minimum} to ${maximum}` },
      labelled(name, input),
    );
    this.list.append(row);
    const made = { row, input };
    this.rows.set(name, made);
    return made;
  }
  private filter(): void {
    const wanted = this.search.value.trim().toLowerCase();
    for (const [name, { row }] of this.rows) {
      row.hidden = !name.toLowerCase().includes(wanted);
    }
  }
  /** For tests and scripts. */
  outside(): Record<string, number> {
    return Object.fromEntries(
      [...this.rows].map(([name, { input }]) => [name, Number(input.value)]),
    );
  }
}
