// SPDX-License-Identifier: Apache-2.0
// A flight in progress on this machine, in the page's scene and charts, with the services that it offers.
import { kColumns } from "../charts/panels";
import { LiveFlight, liveAddress } from "../recording/live";
import type { Recording } from "../recording/recording";
import { about, button, element, labelled, tools } from "./element";
import type { JobHost } from "./job";
import { Parameters } from "./live_parameters";

export interface LiveHost extends Pick<JobHost, "trying"> {
  /** Shows its latest state until another time is sought. */
  follow(recording: Recording): void;
  grown(recording: Recording): void;
}

const kEvery_ms = 250; // charts; the scene follows every picture
const kLines = 8;

const spoken = (service: string): string => {
  const text = service.replace(/^\//, "").replaceAll("_", " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
};

export class Live {
  readonly element = element("div", { className: "many live" });
  private readonly address = element("input", {
    type: "text",
    placeholder: "ws://127.0.0.1:8765/?token=...",
    spellcheck: false,
    autocomplete: "off",
  });
  private readonly end = button("Leave", "Watch it no more; it flies on", () => this.leave());
  private readonly now = button("Now", "Follow it again", () => this.follow());
  private readonly services = tools();
  private readonly parameters = new Parameters((name, value) => this.flight?.set(name, value));
  private readonly status = element("output", { className: "status" });
  private readonly lines = element("ul", { className: "diff", ariaLabel: "Lines of the flight" });
  private flight: LiveFlight | undefined;
  private timer: ReturnType<typeof setInterval> | undefined;
  private shown = 0; // messages, when charts were drawn
  private texts: string[] = [];

  constructor(private readonly host: LiveHost) {
    const watch = button("Watch", "Connect to this flight", () => this.watch());
    this.address.addEventListener("keydown", ({ key }) => {
      if (key === "Enter") {
        this.watch();
      }
    });
    this.element.append(
      about(
        "A flight in progress on this machine: fly, companion or sim-io with --live prints its address.",
      ),
      labelled("Address", this.address),
      tools(watch, this.now, this.end),
      this.status,
      this.services,
      this.lines,
      this.parameters.element,
    );
    this.state(false);
  }
  private state(watching: boolean): void {
    this.end.disabled = this.now.disabled = !watching;
    for (const one of this.services.querySelectorAll("button")) {
      one.disabled = !watching;
    }
    this.parameters.enable(watching);
  }
  private watch(): void {
    void this.host.trying(async () => {
      const address = liveAddress(this.address.value);
      this.leave();
      this.texts = [];
      this.shown = 0;
      this.services.replaceChildren();
      this.parameters.clear();
      this.lines.replaceChildren();
      this.status.textContent = "connecting";
      const flight = new LiveFlight(address, kColumns, {
        services: (names) =>
          this.services.replaceChildren(
            ...names.map((name) =>
              button(spoken(name), `Calls ${name}; the flight answers whether it is possible`, () =>
                flight.call(name),
              ),
            ),
          ),
        parameters: (changed) => this.parameters.take(changed),
        text: (text) => this.show(text),
        closed: (why) => this.closed(flight, why),
      });
      this.flight = flight;
      this.timer = setInterval(() => this.draw(), kEvery_ms);
      this.state(true);
    });
  }
  private leave(): void {
    this.flight?.close();
    this.stop("left");
  }
  private follow(): void {
    if (this.flight !== undefined && this.flight.messages > 0) {
      this.host.follow(this.flight.recording());
    }
  }
  private closed(flight: LiveFlight, why: string): void {
    if (this.flight === flight) {
      this.draw();
      this.stop(why);
    }
  }
  private stop(why: string): void {
    clearInterval(this.timer);
    if (this.flight !== undefined) {
      this.flight = undefined;
      this.status.textContent = why;
      this.state(false);
    }
  }
  private show(text: string): void {
    this.texts.push(text);
    this.lines.replaceChildren(...this.texts.slice(-kLines).map((line) => element("li", {}, line)));
  }
  private draw(): void {
    const { flight } = this;
    if (flight === undefined || flight.messages === this.shown) {
      return;
    }
    const first = this.shown === 0;
    this.shown = flight.messages;
    const recording = flight.recording();
    if (first) {
      this.host.follow(recording);
    } else {
      this.host.grown(recording);
    }
    const phase = recording.phases.at(-1)?.name.replaceAll("_", " ") ?? "";
    this.status.textContent = `${recording.scenario} · ${recording.duration.toFixed(1)} s · ${phase}`;
  }
  /** For tests and scripts. */
  outside(): Record<string, unknown> {
    return {
      watching: this.flight !== undefined,
      messages: this.shown,
      status: this.status.textContent,
      texts: [...this.texts],
      parameters: this.parameters.outside(),
      services: [...this.services.querySelectorAll("button")].map((one) => one.textContent),
    };
  }
}
