// SPDX-License-Identifier: Apache-2.0
import { Chart, type Range, savePicture } from "../charts/chart";
import { kColumns, kPanels } from "../charts/panels";
import { button, messageOf } from "../lab/element";
import { Lab } from "../lab/lab";
import { type Recording, readRecording } from "../recording/recording";
import { FlightView } from "../scene/flight";
import { kViews, Stage } from "../scene/stage";
import { Player } from "./player";
import { Timeline } from "./timeline";

function by<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (found === null) {
    throw new Error(`no #${id} in the page`);
  }
  return found as T;
}

/** Recordings that the page brought along, as base64 in script elements. */
async function embedded(): Promise<Recording[]> {
  const found = [...document.querySelectorAll<HTMLScriptElement>("script[data-recording]")];
  return Promise.all(
    found.map(async (script) => {
      const answer = await fetch(
        `data:application/octet-stream;base64,${script.textContent?.trim()}`,
      );
      const bytes = new Uint8Array(await answer.arrayBuffer());
      script.remove();
      return readRecording(script.dataset.recording ?? "recording", bytes, kColumns);
    }),
  );
}

class Page {
  private readonly stage = new Stage(by<HTMLCanvasElement>("picture"));
  private readonly player = new Player(
    () => this.show(),
    (took_ms) => this.stage.pace(took_ms),
  );
  private readonly timeline = new Timeline(by("timeline"), by("events"), (t) => this.seek(t));
  private readonly charts = kPanels.map(
    (panel) =>
      new Chart(panel, {
        seek: (t) => this.seek(t),
        zoomed: (range) => {
          this.range = range;
          for (const chart of this.charts) {
            chart.zoomTo(this.rangeNow());
          }
        },
      }),
  );
  private recordings: Recording[] = [];
  private flights: FlightView[] = [];
  private following = false; // a flight that is still flying
  private range: Range | undefined; // of the charts; all of the flight
  private shown = Number.NaN;
  private dirty = true;

  constructor() {
    by("charts").append(...this.charts.map((chart) => chart.element));
    this.viewButtons();
    by("play").addEventListener("click", () => this.toggle());
    by<HTMLSelectElement>("speed").addEventListener("change", (event) => {
      this.player.speed = Number((event.target as HTMLSelectElement).value);
    });
    by("save").addEventListener("click", () => {
      const { domElement } = this.stage.renderer;
      savePicture([domElement.width, domElement.height], "flight.png", (context) =>
        context.drawImage(domElement, 0, 0),
      );
    });
    by<HTMLInputElement>("file").addEventListener("change", (event) => {
      void this.open([...((event.target as HTMLInputElement).files ?? [])]);
    });
    document.addEventListener("keydown", (event) => this.key(event));
    document.addEventListener("dragover", (event) => event.preventDefault());
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      void this.open([...(event.dataTransfer?.files ?? [])]);
    });
    by("picture").addEventListener("pointermove", () => this.redraw());
    by("picture").addEventListener("wheel", () => this.redraw(), { passive: true });
    new ResizeObserver(() => this.resize()).observe(by("charts"));
    new ResizeObserver(() => this.redraw()).observe(by("picture"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.theme());
    this.theme();
  }

  /** The first is the flight, others are its ghosts. */
  load(recordings: Recording[]): void {
    this.player.seek(0);
    this.range = undefined;
    this.refresh(recordings);
    this.view(this.stage.currentView);
    this.report(
      recordings
        .filter(({ damage }) => damage !== "")
        .map(({ name, damage }) => `${name}: ${damage}`)
        .join("; "),
    );
  }
  /**
   * The same, seen from where one looks, at the same time.
   * @param brief  others follow at once: not in full detail
   */
  refresh(recordings: Recording[], brief = false): void {
    this.stage.brief = brief;
    this.following &&= recordings[0] === this.recordings[0];
    const anew = this.recordings.length === 0;
    this.recordings = recordings;
    const first = recordings[0];
    const there = first !== undefined;
    document.body.classList.toggle("empty", !there);
    if (!there) {
      return;
    }
    by("title").textContent = [first.scenario || first.name, first.outcome]
      .filter((part) => part !== "")
      .join(": ");
    document.title = `Limpet · ${first.scenario || first.name}`;
    by("names").textContent =
      recordings.length > 1 ? recordings.map((one) => one.name).join(", ") : "";
    this.player.end = first.duration;
    const stood = new Set(this.flights);
    this.flights = recordings.map((recording, k) => {
      const known = [...stood].find((flight) => flight.takes(recording, k > 0));
      if (known !== undefined) {
        stood.delete(known);
      }
      return known ?? new FlightView(recording, k > 0, this.stage.cut);
    });
    for (const flight of this.flights) {
      flight.show(this.player.time);
    }
    this.stage.setFlights(this.flights);
    this.stage.setFloor(Math.min(-0.5, (first.frames.get("base_link")?.at(0)[2] ?? 0) - 1.2));
    this.timeline.load(first);
    this.loadCharts();
    if (anew) {
      this.view(this.stage.currentView);
    }
    this.redraw();
  }
  /** Nothing follows at once: in full detail. */
  calm(): void {
    if (this.stage.brief) {
      this.stage.brief = false;
      this.redraw();
    }
  }
  /** What is to be shown stands there: drawn with the page's next picture, and by what draws for it. */
  async drawn(): Promise<void> {
    await Promise.resolve(); // charts gather what is new until then
    this.show();
    await new Promise((drawn) => requestAnimationFrame(drawn));
    this.stage.finish();
  }
  /** As it flies: at its latest time until another is sought. */
  follow(recording: Recording): void {
    this.player.playing = false;
    if (this.recordings[0] !== recording) {
      this.refresh([recording]);
      this.view(this.stage.currentView);
    }
    this.following = true; // also of another one than before
    this.player.wake();
  }
  grown(recording: Recording): void {
    if (this.recordings[0] !== recording) {
      return; // another one is looked at
    }
    if (this.flights.some((flight) => flight.outgrown)) {
      this.refresh(this.recordings);
    } else {
      this.player.end = recording.duration;
      this.timeline.grow();
      this.loadCharts();
    }
    this.redraw();
  }
  seek(t: number): void {
    this.following = false;
    this.player.seek(t);
    this.player.playing = false;
    this.redraw();
  }
  private toggle(): void {
    this.following = false;
    this.player.toggle();
  }
  async open(files: File[]): Promise<void> {
    try {
      const recordings: Recording[] = [];
      for (const file of files) {
        recordings.push(
          readRecording(file.name, new Uint8Array(await file.arrayBuffer()), kColumns),
        );
      }
      if (recordings.length > 0) {
        this.load(recordings);
      }
    } catch (problem) {
      this.report(messageOf(problem));
    }
  }
  report(text: string): void {
    by("problem").textContent = text;
    by("problem").hidden = text === "";
  }
  /** For tests and scripts: what it shows. */
  state(): Record<string, unknown> {
    return {
      time: this.player.time,
      end: this.player.end,
      recordings: this.recordings.length,
      following: this.following,
      vehicle: this.stage.vehicleInPicture(),
      charts: this.charts.filter((chart) => !chart.element.hidden).length,
      geometries: this.stage.renderer.info.memory.geometries,
      textures: this.stage.renderer.info.memory.textures,
      pictures: this.stage.renderer.info.render.frame,
    };
  }

  /** @returns whether it changes by itself */
  private show(): boolean {
    if (this.following) {
      this.player.end = this.recordings[0]?.duration ?? 0;
      this.player.seek(this.player.end);
    }
    const { playing } = this.player;
    by("play").textContent = playing ? "Pause" : "Play";
    this.dirty ||= this.stage.moving !== playing; // in full detail where it stands
    this.stage.moving = playing;
    if (this.recordings.length === 0 || (this.player.time === this.shown && !this.dirty)) {
      return this.following;
    }
    this.dirty = false;
    this.shown = this.player.time;
    by("time").textContent = `${this.shown.toFixed(2)} s`;
    this.stage.draw(this.recordings.map((recording) => Math.min(this.shown, recording.duration)));
    this.timeline.show(this.shown);
    for (const chart of this.charts) {
      chart.show(this.shown);
    }
    return this.following;
  }
  private redraw(): void {
    this.dirty = true;
    this.player.wake();
  }
  private view(name: (typeof kViews)[number][0]): void {
    this.stage.draw(
      this.recordings.map((recording) => Math.min(this.player.time, recording.duration)),
    );
    this.stage.look(name);
    for (const one of by("views").querySelectorAll("button")) {
      one.setAttribute("aria-pressed", String(one.dataset.view === name));
    }
    this.redraw();
  }
  private viewButtons(): void {
    by("views").append(
      ...kViews.map(([name, label], k) => {
        const made = button(label, `Camera: ${label} (key ${k + 1})`, () => this.view(name));
        made.dataset.view = name;
        return made;
      }),
    );
  }
  private key(event: KeyboardEvent): void {
    const inControl =
      event.target instanceof HTMLSelectElement || event.target instanceof HTMLInputElement;
    if (event.ctrlKey || event.metaKey || event.altKey || (inControl && event.key !== " ")) {
      return;
    }
    const kStep_s = event.shiftKey ? 1 : 0.05;
    const does = new Map<string, () => void>([
      ["ArrowRight", () => this.seek(this.player.time + kStep_s)],
      ["ArrowLeft", () => this.seek(this.player.time - kStep_s)],
      ["Home", () => this.seek(0)],
      ["End", () => this.seek(this.player.end)],
      ...kViews.map(([name], k): [string, () => void] => [`${k + 1}`, () => this.view(name)]),
    ]);
    if (!(event.target instanceof HTMLButtonElement)) {
      does.set(" ", () => this.toggle());
    }
    const act = does.get(event.key);
    if (act === undefined) {
      return;
    }
    act();
    event.preventDefault();
  }
  private theme(): void {
    this.stage.setDark(matchMedia("(prefers-color-scheme: dark)").matches);
    this.loadCharts();
    this.redraw();
  }
  private loadCharts(): void {
    const style = getComputedStyle(document.body);
    const colours = {
      text: style.getPropertyValue("--text"),
      grid: style.getPropertyValue("--line"),
    };
    const width = Math.max(200, by("charts").clientWidth - 16);
    for (const chart of this.charts) {
      chart.load(this.recordings, { colours, width }, this.rangeNow());
    }
  }
  private rangeNow(): Range {
    return this.range ?? { min: 0, max: this.player.end };
  }
  private resize(): void {
    for (const chart of this.charts) {
      chart.resize(Math.max(200, by("charts").clientWidth - 16));
    }
    this.redraw();
  }
}

const page = new Page();
const place = document.getElementById("lab");
const lab = place === null ? undefined : new Lab(place, page);
Object.assign(window, { limpet: page, lab });
embedded()
  .then((recordings) => page.load(recordings))
  .catch((problem: unknown) => page.report(messageOf(problem)));
