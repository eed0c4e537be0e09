// SPDX-License-Identifier: Apache-2.0
// The time of a flight: its phases as bars, its events as numbered marks, where we are.
import { element } from "../lab/element";
import type { FlightEvent, Recording } from "../recording/recording";

const kSvg = "http://www.w3.org/2000/svg";

function svg<K extends keyof SVGElementTagNameMap>(
  name: K,
  attributes: Record<string, string | number>,
): SVGElementTagNameMap[K] {
  const made = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, String(value));
  }
  return made;
}

const spoken = (name: string): string => name.replaceAll("_", " ");

/** Events that happened in guidance, cup or simulation, as a line a person reads. */
export function eventText(event: FlightEvent): string {
  const values = event.values
    .map(([name, value]) => `${name} ${Number(value.toPrecision(4))}`)
    .join(", ");
  return [spoken(event.name), event.reason, values].filter((part) => part !== "").join(" · ");
}

export class Timeline {
  readonly slider = element("input", {
    type: "range",
    min: "0",
    step: "0.001",
    ariaLabel: "Time of the flight in seconds",
  });
  private readonly bars = svg("svg", { class: "phases", role: "img", preserveAspectRatio: "none" });
  private readonly list = element("ol");
  private readonly phase = element("output", { className: "phase" });
  private items: HTMLLIElement[] = [];
  private recording: Recording | undefined;
  private current = -2;

  constructor(
    bars: HTMLElement,
    events: HTMLElement,
    private readonly seek: (t: number) => void,
  ) {
    this.slider.addEventListener("input", () => this.seek(Number(this.slider.value)));
    bars.append(this.bars, this.slider, this.phase);
    events.append(this.list);
  }

  load(recording: Recording): void {
    this.recording = recording;
    this.current = -2;
    this.items = [];
    this.list.replaceChildren();
    this.grow();
  }
  /** The recording has grown. */
  grow(): void {
    const { recording } = this;
    if (recording === undefined) {
      return;
    }
    this.slider.max = String(recording.duration);
    this.drawBars(recording);
    const more = recording.events.slice(this.items.length).map((event) => this.itemOf(event));
    this.items.push(...more);
    this.list.append(...more);
  }
  private itemOf(event: FlightEvent): HTMLLIElement {
    const go = element(
      "button",
      { type: "button" },
      element("time", {}, `${event.time.toFixed(3)} s`),
      ` ${eventText(event)}`,
    );
    go.addEventListener("click", () => this.seek(event.time));
    return element("li", {}, go);
  }

  show(t: number): void {
    this.slider.value = String(t);
    const phase = this.recording?.phases.findLast((one) => one.from <= t);
    this.phase.textContent = phase === undefined ? "" : spoken(phase.name);
    const latest = (this.recording?.events ?? []).findLastIndex((event) => event.time <= t);
    if (latest !== this.current) {
      this.items[this.current]?.removeAttribute("aria-current");
      this.items[latest]?.setAttribute("aria-current", "step");
      this.scrollTo(this.items[latest]);
      this.current = latest;
    }
  }

  /** Within the list alone: the page stays where the reader has it. */
  private scrollTo(item: HTMLLIElement | undefined): void {
    const box = this.list.parentElement;
    if (item !== undefined && box !== null) {
      const top = item.offsetTop - box.offsetTop;
      if (top < box.scrollTop || top + item.offsetHeight > box.scrollTop + box.clientHeight) {
        box.scrollTop = top - box.clientHeight / 2;
      }
    }
  }
  private drawBars(recording: Recording): void {
    const kWidth = 1000;
    const kHeight = 26;
    this.bars.setAttribute("viewBox", `0 0 ${kWidth} ${kHeight}`);
    this.bars.setAttribute(
      "aria-label",
      `${recording.phases.length} phases and ${recording.events.length} events`,
    );
    const x = (t: number): number => (kWidth * t) / Math.max(1e-9, recording.duration);
    const parts: SVGElement[] = recording.phases.map((phase, k) => {
      const bar = svg("rect", {
        x: x(phase.from),
        y: 8,
        width: Math.max(0, x(phase.to) - x(phase.from)),
        height: kHeight - 8,
        class: k % 2 === 0 ? "even" : "odd",
      });
      const title = svg("title", {});
      title.textContent = `${spoken(phase.name)}: ${phase.from.toFixed(2)} to ${phase.to.toFixed(2)} s`;
      bar.append(title);
      bar.addEventListener("click", () => this.seek(phase.from));
      return bar;
    });
    for (const event of recording.events) {
      parts.push(
        svg("line", { x1: x(event.time), x2: x(event.time), y1: 0, y2: kHeight, class: "event" }),
      );
    }
    this.bars.replaceChildren(...parts);
  }
}
