// SPDX-License-Identifier: Apache-2.0
// One panel of numbers over time.
import uPlot from "uplot";
import type { Recording } from "../recording/recording";
import { valueAt } from "../recording/series";
import { type Line, type Panel, samplesOf } from "./panels";

export interface ChartHost {
  seek(t: number): void;
  /** All panels show the same stretch of time. */
  zoomed(from: number, to: number): void;
}

interface Drawn {
  line: Line;
  ghost: boolean; // of another flight than the first
  time: Float64Array;
  values: number[];
}

export class Chart {
  readonly element = document.createElement("section");
  private plot: uPlot | undefined;
  private readonly readout = document.createElement("p");
  private drawn: Drawn[] = [];
  private look = ""; // of the plot's lines
  private now = 0;

  constructor(
    readonly panel: Panel,
    private readonly host: ChartHost,
  ) {
    this.element.className = "chart";
    const title = document.createElement("h2");
    title.textContent = `${panel.title} [${panel.unit}]`;
    const save = document.createElement("button");
    save.type = "button";
    save.className = "save";
    save.textContent = "PNG";
    save.title = `Save "${panel.title}" as a picture`;
    save.setAttribute("aria-label", save.title);
    save.addEventListener("click", () => this.save());
    const head = document.createElement("header");
    this.readout.className = "readout";
    head.append(title, this.readout, save);
    this.element.append(head);
  }

  /**
   * The plot stays where its lines do, for a canvas costs more than what is drawn on it.
   * @returns whether there is anything to see
   */
  load(recordings: Recording[], colours: { text: string; grid: string }, width: number): boolean {
    this.drawn = recordings.flatMap((recording, k) =>
      this.panel.lines.flatMap((line) => {
        const samples = samplesOf(recording, line);
        return samples === undefined ? [] : [{ line, ghost: k > 0, ...samples }];
      }),
    );
    this.element.hidden = this.drawn.length === 0;
    const look = JSON.stringify([
      colours,
      this.drawn.map(({ line, ghost }) => [line.label, ghost]),
    ]);
    if (this.plot !== undefined && look === this.look) {
      this.plot.setData(this.joined(), false);
      return true;
    }
    this.look = look;
    this.plot?.destroy();
    this.plot = undefined;
    if (this.element.hidden) {
      return false;
    }
    const series: uPlot.Series[] = this.drawn.map(({ line, ghost }) => ({
      label: line.label,
      stroke: ghost ? `${line.colour}80` : line.colour,
      width: ghost ? 1 : 1.5,
      dash: ghost ? [2, 2] : line.dash,
      spanGaps: true,
    }));
    const axis: uPlot.Axis = {
      stroke: colours.text,
      grid: { stroke: colours.grid, width: 1 },
      ticks: { stroke: colours.grid, width: 1 },
      font: "11px system-ui, sans-serif",
    };
    const options: uPlot.Options = {
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
        draw: [(plot) => this.drawNow(plot, colours.text)],
        setSelect: [(plot) => this.zoom(plot)],
      },
    };
    this.plot = new uPlot(options, this.joined(), this.element);
    this.plot.over.addEventListener("click", (event) => {
      if (this.plot !== undefined && this.plot.select.width < 3) {
        this.host.seek(this.plot.posToVal(event.offsetX, "x"));
      }
    });
    this.plot.over.addEventListener("dblclick", () => this.host.zoomed(Number.NaN, Number.NaN));
    return true;
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
    this.plot?.redraw(false, false);
  }
  /** NaN: all of it. */
  range(from: number, to: number, end: number): void {
    this.plot?.setScale("x", Number.isNaN(from) ? { min: 0, max: end } : { min: from, max: to });
  }

  private joined(): uPlot.AlignedData {
    const tables: uPlot.AlignedData[] = this.drawn.map(({ time, values }) => [
      Array.from(time),
      values,
    ]);
    return tables.length === 1 ? (tables[0] as uPlot.AlignedData) : uPlot.join(tables);
  }
  private zoom(plot: uPlot): void {
    if (plot.select.width >= 3) {
      const from = plot.posToVal(plot.select.left, "x");
      const to = plot.posToVal(plot.select.left + plot.select.width, "x");
      plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      this.host.zoomed(from, to);
    }
  }
  private drawNow(plot: uPlot, colour: string): void {
    const x = Math.round(plot.valToPos(this.now, "x", true));
    if (x < plot.bbox.left || x > plot.bbox.left + plot.bbox.width) {
      return;
    }
    const { ctx } = plot;
    ctx.save();
    ctx.strokeStyle = colour;
    ctx.lineWidth = window.devicePixelRatio;
    ctx.setLineDash([]);
    ctx.beginPath();
    ctx.moveTo(x, plot.bbox.top);
    ctx.lineTo(x, plot.bbox.top + plot.bbox.height);
    ctx.stroke();
    ctx.restore();
  }
  private save(): void {
    const canvas = this.plot?.ctx.canvas;
    if (canvas !== undefined) {
      saveCanvas(canvas, `${this.panel.title.toLowerCase().replaceAll(" ", "_")}.png`);
    }
  }
}

const kHeight_px = 132;

function digits(value: number): number {
  return Math.abs(value) >= 100 ? 0 : Math.abs(value) >= 10 ? 1 : 2;
}

/** On white or on the page's dark, as it is seen. */
export function saveCanvas(canvas: HTMLCanvasElement, name: string): void {
  const copy = document.createElement("canvas");
  copy.width = canvas.width;
  copy.height = canvas.height;
  const context = copy.getContext("2d");
  if (context === null) {
    return;
  }
  context.fillStyle = getComputedStyle(document.body).backgroundColor;
  context.fillRect(0, 0, copy.width, copy.height);
  context.drawImage(canvas, 0, 0);
  const link = document.createElement("a");
  link.download = name;
  link.href = copy.toDataURL("image/png");
  link.click();
}
