// SPDX-License-Identifier: Apache-2.0
// What differs from the scenario as it ships: kept in the page's address, written as a command.

export class Changes {
  scenario = "";
  private readonly values = new Map<string, string>();

  /** Out of an address' "#scenario=...&set=key%3Dvalue&set=..." */
  static from(hash: string): Changes {
    const changes = new Changes();
    const all = new URLSearchParams(hash.replace(/^#/, ""));
    changes.scenario = all.get("scenario") ?? "";
    for (const text of all.getAll("set")) {
      const at = text.indexOf("=");
      if (at > 0) {
        changes.set(text.slice(0, at), text.slice(at + 1));
      }
    }
    return changes;
  }
  toHash(): string {
    const all = new URLSearchParams();
    all.set("scenario", this.scenario);
    for (const text of this.list()) {
      all.append("set", text);
    }
    return `#${all}`;
  }
  get(key: string): string | undefined {
    return this.values.get(key);
  }
  set(key: string, value: string): void {
    this.values.set(key, value);
  }
  drop(key: string): void {
    this.values.delete(key);
  }
  clear(): void {
    this.values.clear();
  }
  get size(): number {
    return this.values.size;
  }
  /** "key=value" each; what is chosen by name first, for numbers are set within it. */
  list(): string[] {
    const named = (key: string): number => (key === "vehicle" || key === "wall.surface" ? 0 : 1);
    return [...this.values]
      .sort(([a], [b]) => named(a) - named(b))
      .map(([key, value]) => `${key}=${value}`);
  }
  command(): string {
    const quoted = (text: string): string =>
      /^[\w.=+:/-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
    return [
      "limpet fly",
      this.scenario,
      ...this.list().map((text) => `--set ${quoted(text)}`),
    ].join(" ");
  }
}

/** Where a slider goes: the allowed range where it is narrow, else a quarter to four times. */
export function slide(value: number, minimum: number, maximum: number): [number, number] {
  const kWide = 20;
  const size = Math.abs(value);
  if (size === 0 || (maximum - minimum) / size <= kWide) {
    return value === 0 && maximum - minimum > kWide
      ? [Math.max(minimum, -kWide / 2), Math.min(maximum, kWide / 2)]
      : [minimum, maximum];
  }
  return value > 0
    ? [Math.max(minimum, value / 4), Math.min(maximum, value * 4)]
    : [Math.max(minimum, value * 4), Math.min(maximum, value / 4)];
}

/** Rounded to a thousandth of the slider's range, in as few digits as possible. */
export function rounded(value: number, from: number, to: number): number {
  const digits = Math.max(0, Math.min(12, 3 - Math.floor(Math.log10(to - from || 1))));
  return Number(value.toFixed(digits));
}
