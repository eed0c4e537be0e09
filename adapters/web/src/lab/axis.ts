// SPDX-License-Identifier: Apache-2.0
// A number of the scenario to go along, from where to where, in how many values.
import { rounded, slide } from "./changes";
import { element, field, labelled } from "./element";
import type * as server from "./server";

/** Numbers that take one value together. */
export interface Together {
  name: string;
  keys: string[];
}
export interface AxisWishes {
  count: number;
  /** Chosen first, where it is there. */
  otherwise: string;
  /** There may be no number at all. */
  none?: boolean;
  together?: Together[];
}

export class AxisChoice {
  readonly element = element("fieldset", { className: "axis" });
  private readonly key = element("select", {});
  private readonly from = field("number", { ariaLabel: "from" });
  private readonly to = field("number", { ariaLabel: "to" });
  private readonly count = field("number", { min: 2, max: 100, step: "1", ariaLabel: "values" });
  private rows = new Map<string, server.Row>(); // by what stands for it in the list
  private filled: { key: string; value: number | undefined } | undefined;

  constructor(
    name: string,
    private readonly wishes: AxisWishes,
  ) {
    this.count.value = String(wishes.count);
    this.key.addEventListener("change", () => this.fill());
    this.element.append(
      labelled(name, this.key),
      element(
        "div",
        { className: "range" },
        this.from,
        " to ",
        this.to,
        " in ",
        this.count,
        " values",
      ),
    );
  }
  offer(sections: server.Section[]): void {
    const before = this.key.value;
    const { none, otherwise, together = [] } = this.wishes;
    this.rows = new Map(
      sections.flatMap(({ rows }) =>
        rows.filter(({ kind }) => kind !== "switch").map((row) => [row.key, row] as const),
      ),
    );
    const groups = together.filter(({ keys }) => keys.every((key) => this.rows.has(key)));
    this.key.replaceChildren(
      ...(none === true ? [element("option", { value: "" }, "none")] : []),
      ...groups.map(({ name, keys }) => element("option", { value: keys.join(" ") }, name)),
      ...sections.map(({ name, rows }) =>
        element(
          "optgroup",
          { label: name },
          ...rows
            .filter(({ key }) => this.rows.has(key))
            .map(({ key }) => element("option", { value: key }, key.slice(name.length + 1))),
        ),
      ),
    );
    for (const { keys } of groups) {
      this.rows.set(keys.join(" "), this.rows.get(keys[0] as string) as server.Row);
    }
    const wanted = before || otherwise;
    this.key.value = this.rows.has(wanted) ? wanted : "";
    const row = this.rows.get(this.key.value);
    if (this.filled?.key !== this.key.value || this.filled.value !== row?.value) {
      this.fill();
    }
  }
  /** About the value that ships. */
  private fill(): void {
    const row = this.rows.get(this.key.value);
    this.filled = { key: this.key.value, value: row?.value };
    if (row !== undefined) {
      const [from, to] = slide(row.value, row.minimum, row.maximum);
      this.from.value = String(rounded(from, from, to));
      this.to.value = String(rounded(to, from, to));
    }
  }
  get keys(): string[] {
    return this.key.value.split(" ").filter((key) => key !== "");
  }
  /** For people. */
  get name(): string {
    const unit = this.rows.get(this.key.value)?.unit ?? "";
    const option = this.key.selectedOptions[0]?.textContent ?? "";
    const name = this.keys.length > 1 ? option : this.key.value;
    return unit === "" ? name : `${name} [${unit}]`;
  }
  range(): { from: number; to: number; count: number } {
    return {
      from: Number(this.from.value),
      to: Number(this.to.value),
      count: Number(this.count.value),
    };
  }
  axis(): server.Axis[] {
    return this.key.value === "" ? [] : [{ key: this.key.value, ...this.range() }];
  }
}
