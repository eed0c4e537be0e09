// SPDX-License-Identifier: Apache-2.0
// Parts of a page, made in one expression.

export function element<K extends keyof HTMLElementTagNameMap>(
  name: K,
  properties: Partial<HTMLElementTagNameMap[K]> = {},
  ...inside: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...inside);
  return made;
}

export function button(text: string, title: string, does: () => void): HTMLButtonElement {
  const made = element("button", { type: "button", title }, text);
  made.addEventListener("click", does);
  return made;
}

/** A list to choose from. */
export function choice(
  names: { name: string; description: string }[],
  chosen: string,
  chose: (name: string) => void,
): HTMLSelectElement {
  const list = element(
    "select",
    {},
    ...names.map(({ name, description }) =>
      element("option", { value: name, title: description }, name || description),
    ),
  );
  list.value = chosen;
  list.addEventListener("change", () => chose(list.value));
  return list;
}

/** What an input takes, and what it holds. */
interface Field {
  min?: number;
  max?: number;
  step?: "any" | "1";
  value?: number | string;
  ariaLabel?: string;
}
export const field = (type: "number" | "range", takes: Field = {}): HTMLInputElement =>
  element("input", Object.assign({ type, step: "any" }, takes) as Partial<HTMLInputElement>);

export const options = (names: string[]): HTMLOptionElement[] =>
  names.map((name) => element("option", { value: name }, name));

/** A row of buttons. */
export const tools = (...inside: (Node | string)[]): HTMLElement =>
  element("div", { className: "tools" }, ...inside);

/** What a part of the page is for. */
export const about = (text: string): HTMLElement => element("p", { className: "what" }, text);

/** Saves a file under this name. */
export function download(name: string, address: string): void {
  element("a", { download: name, href: address }).click();
}

export const messageOf = (problem: unknown): string =>
  problem instanceof Error ? problem.message : String(problem);

/** A control with its name before it. */
export function labelled(name: string, ...controls: (Node | string)[]): HTMLLabelElement {
  return element("label", {}, element("span", {}, name), ...controls);
}

export interface Tab {
  name: string;
  panel: HTMLElement;
  shown?: () => void;
  /** At every choice: whether it is this one. */
  seen?: (seen: boolean) => void;
}
/** A row of tabs; the panels stay where they are, one is seen. Arrow keys go from tab to tab. */
export function tabs(name: string, all: Tab[]): HTMLElement {
  const list = element("div", { className: "tabs", role: "tablist", ariaLabel: name });
  const heads = all.map(({ name, panel }) => {
    panel.id = `tab_${name.toLowerCase()}`;
    panel.role = "tabpanel";
    panel.ariaLabel = name;
    const head = element("button", { type: "button", role: "tab" }, name);
    head.setAttribute("aria-controls", panel.id);
    return head;
  });
  const choose = (chosen: number): void => {
    all.forEach(({ panel, seen }, k) => {
      panel.hidden = k !== chosen;
      seen?.(k === chosen);
      heads[k]?.setAttribute("aria-selected", String(k === chosen));
      heads[k]?.setAttribute("tabindex", k === chosen ? "0" : "-1");
    });
    all[chosen]?.shown?.();
  };
  heads.forEach((head, k) => {
    head.addEventListener("click", () => choose(k));
    head.addEventListener("keydown", (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step !== undefined) {
        const next = (k + step + heads.length) % heads.length;
        choose(next);
        heads[next]?.focus();
        event.stopPropagation();
        event.preventDefault();
      }
    });
  });
  list.append(...heads);
  choose(0);
  return list;
}
