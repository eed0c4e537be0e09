// SPDX-License-Identifier: Apache-2.0
// One panel of numbers over time.
import uPlot from "uplot";
import { button, download, element } from "../lab/element";
import type { Recording } from "../recording/recording";
import { valueAt } from "../recording/series";
import { type Line, type Panel, type Samples, samplesOf } from "./panels";

export interface ChartHost {
  seek(t: number): void;
  /** All panels show the same stretch of time. @param range  undefined: all of it */
  zoomed(range: Range | undefined): void;
}

/** A stretch of time [s]. */
export interface Range {
  min: number;
  max: number;
}
export interface Look {
  colours: { text: string; grid: string };
  width: number; // [px]
}

interface Drawn extends Samples {
  line: Line;
  ghost: boolean; // of another flight than the first
}

export class Chart {
  readonly element: HTMLElement;
  private plot: uPlot | undefined;
  private readonly readout = element("p", { className: "readout" });
  private readonly mark = element("i", { className: "now" });
  private drawn: Drawn[] = [];
  private lines = ""; // that the plot has, and their look
  private range: Range = { min: 0, max: 1 };
  private seen = true;
  private stale = false; // not drawn since it was not seen
  private now = 0;

  constructor(
    readonly panel: Panel,
    private readonly host: ChartHost,
  ) {
    const save = button("PNG", `Save "${panel.title}" as a picture`, () => this.save());
    save.className = "save";
    save.ariaLabel = save.title;
    const title = element("h2", {}, `${panel.title} [${panel.unit}]`);
    this.element = element(
      "section",
      { className: "chart" },
      element("header", {}, title, this.readout, save),
    );
    new IntersectionObserver(([entry]) => {
      this.seen = entry?.isIntersecting ?? true;
      if (this.seen && this.stale) {
        this.draw();
      }
    }).observe(this.element);
  }

  /**
   * The plot stays where its lines do, for a canvas costs more than what is drawn on it.
   * @param range  of time
   */
  load(recordings: Recording[], look: Look, range: Range): void {
    this.range = range;
    this.drawn = recordings.flatMap((recording, k) =>
      this.panel.lines.flatMap((line) => {
        const samples = samplesOf(recording, line);
        return samples === undefined ? [] : [{ line, ghost: k > 0, ...samples }];
      }),
    );
    // Nothing to draw, for example a pendulum's thrust.
    this.element.hidden = this.drawn.every(({ values }) => values.every((value) => value === 0));
    const lines = JSON.stringify([
      look.colours,
      this.drawn.map(({ line, ghost }) => [line.label, ghost]),
    ]);
    if (this.plot === undefined || lines !== this.lines) {
      this.lines = lines;
      this.plot?.destroy();
      this.plot = this.element.hidden ? undefined : this.make(look);
    } else {
      this.draw();
    }
  }
  private make({ colours, width }: Look): uPlot {
    const series: uPlot.Series[] = this.drawn.map(({ line, ghost }) => ({
      label: line.label,
      stroke: ghost ? `${line.colour}80` : line.colour,
      width: ghost ? 1 : (line.width ?? 1.5),
      dash: ghost ? [2, 2] : undefined,
      spanGaps: true,
      points: { show: false },
      facets: [
        { scale: "x", auto: true },
        { scale: "y", auto: true },
      ],
    }));
    const axis: uPlot.Axis = {
      stroke: colours.text,
      grid: { stroke: colours.grid, width: 1 },
      ticks: { stroke: colours.grid, width: 1 },
      font: "11px system-ui, sans-serif",
    };
    const options: uPlot.Options = {
      mode: 2, // each line has its times
      width,
      height: kHeight_px,
      legend: { show: false },
      cursor: { sync: { key: "flight" }, drag: { x: true, y: false }, points: { show: false } },
      scales: { x: { time: false } },
      axes: [
        { ...axis, size: 24 },
        { ...axis, size: 54, space: 22 },
      ],
      series: [{}, ...series],
      hooks: {
        draw: [() => this.placeNow()],
        setSelect: [(plot) => this.zoom(plot)],
      },
    };
    const plot = new uPlot(options, this.data(), this.element);
    plot.over.append(this.mark);
    plot.over.addEventListener("click", (event) => {
      if (plot.select.width < 3) {
        this.host.seek(plot.posToVal(event.offsetX, "x"));
      }
    });
    plot.over.addEventListener("dblclick", () => this.host.zoomed(undefined));
    plot.setScale("x", this.range);
    return plot;
  }
  resize(width: number): void {
    this.plot?.setSize({ width, height: kHeight_px });
  }
  show(t: number): void {
    this.now = t;
    this.readout.textContent = this.drawn
      .slice(0, this.panel.lines.length)
      .map(({ line, time, values }) => {
        const value = valueAt(time, values, t);
        return `${line.label} ${value === undefined || Number.isNaN(value) ? "–" : value.toFixed(digits(value))}`;
      })
      .join("  ");
    this.placeNow();
  }
  zoomTo(range: Range): void {
    this.range = range;
    this.plot?.setScale("x", range);
  }

  private data(): uPlot.AlignedData {
    const tables = this.drawn.map(({ time, values }) => [time, values]);
    return [null, ...tables] as unknown as uPlot.AlignedData; // its types know one time alone
  }
  /** Once it is seen: drawing all of them takes longer than a flight. */
  private draw(): void {
    this.stale = !this.seen;
    if (this.seen && this.plot !== undefined) {
      this.plot.setData(this.data(), false);
      this.plot.setScale("x", this.range);
    }
  }
  private zoom(plot: uPlot): void {
    if (plot.select.width >= 3) {
      const from = plot.posToVal(plot.select.left, "x");
      const to = plot.posToVal(plot.select.left + plot.select.width, "x");
      plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      this.host.zoomed({ min: from, max: to });
    }
  }
  /** The mark of the time that is shown: above the plot, which is not drawn again for it. */
  private placeNow(): void {
    if (this.plot !== undefined) {
      const x = this.plot.valToPos(this.now, "x");
      this.mark.hidden = !(x >= 0 && x <= this.plot.bbox.width / window.devicePixelRatio);
      this.mark.style.transform = `translateX(${x.toFixed(1)}px)`;
    }
  }
  /** As it is seen: with its title, the numbers at the mark, and the mark. */
  private save(): void {
    const { plot } = this;
    if (plot === undefined) {
      return;
    }
    const scale = window.devicePixelRatio;
    const head = kHead_px * scale;
    const { canvas } = plot.ctx;
    savePicture(
      [canvas.width, canvas.height + head],
      `${this.panel.title.toLowerCase().replaceAll(" ", "_")}.png`,
      (context) => {
        context.drawImage(canvas, 0, head);
        const texts = [this.element.querySelector("h2") as HTMLElement, this.readout];
        for (const [k, text] of texts.entries()) {
          const { color, fontFamily } = getComputedStyle(text);
          context.fillStyle = color;
          context.font = `${k === 0 ? "bold " : ""}${12 * scale}px ${fontFamily}`;
          context.textAlign = k === 0 ? "left" : "right";
          const x = k === 0 ? plot.bbox.left : plot.bbox.left + plot.bbox.width;
          context.fillText(text.innerText, x, 0.7 * head, plot.bbox.width);
        }
        if (!this.mark.hidden) {
          context.fillStyle = getComputedStyle(this.mark).backgroundColor;
          const x = plot.bbox.left + plot.valToPos(this.now, "x") * scale;
          context.fillRect(x, head + plot.bbox.top, scale, plot.bbox.height);
        }
      },
    );
  }
}

const kHeight_px = 132;
const kHead_px = 24; // above it, in a picture that is saved

function digits(value: number): number {
  return Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : Math.abs(value) >= 1 ? 2 : 3;
}

/** On white or on the page's dark, as it is seen. @param draw  onto that ground */
export function savePicture(
  [width, height]: [number, number],
  name: string,
  draw: (context: CanvasRenderingContext2D) => void,
): void {
  const copy = element("canvas", { width, height });
  const context = copy.getContext("2d");
  if (context === null) {
    return;
  }
  context.fillStyle = getComputedStyle(document.body).backgroundColor;
  context.fillRect(0, 0, width, height);
  draw(context);
  download(name, copy.toDataURL("image/png"));
}
