// SPDX-License-Identifier: Apache-2.0
// Where the runs of a campaign lie, by two of its numbers: a cell's ground is its share of success,
// a point's colour its outcome.
import { element } from "./element";

export type Value = number | string | null;
export interface Mark {
  run: number;
  x: Value;
  y: Value;
  outcome: string;
  success: boolean;
}
export interface AxisOf {
  name: string;
  /** Of a grid, in order: runs stand in columns. Empty: anywhere between the least and the most. */
  values: Value[];
}
interface Place {
  mark: Mark;
  x: number;
  y: number;
}

/** Okabe and Ito's colours, distinguishable with colour blindness; a success is round, the others are crosses. */
const kColours = new Map([
  ["released", "#0072b2"],
  ["perched", "#009e73"],
  ["failed_to_seal", "#e69f00"],
  ["release_aborted", "#cc79a7"],
  ["aborted", "#d55e00"],
  ["crashed", "#c00000"],
  ["timed_out", "#56b4e9"],
]);
export const colourOf = (outcome: string): string => kColours.get(outcome) ?? "#8a8a8a";

/** Where a value lies along an axis, 0 to 1, and how wide its column is there. */
export class Scale {
  private readonly least: number;
  private readonly most: number;
  constructor(
    readonly axis: AxisOf,
    present: Value[],
  ) {
    const numbers = present.filter((value): value is number => typeof value === "number");
    this.least = numbers.reduce((a, b) => Math.min(a, b), Number.POSITIVE_INFINITY);
    this.most = numbers.reduce((a, b) => Math.max(a, b), Number.NEGATIVE_INFINITY);
  }
  get columns(): number {
    return this.axis.values.length;
  }
  /** undefined: nowhere */
  at(value: Value): number | undefined {
    if (this.columns > 0) {
      const column = this.axis.values.indexOf(value);
      return column < 0 ? undefined : (column + 0.5) / this.columns;
    }
    if (typeof value !== "number") {
      return undefined;
    }
    const span = this.most - this.least;
    return span > 0 ? 0.04 + (0.92 * (value - this.least)) / span : 0.5;
  }
  ticks(): { at: number; text: string }[] {
    const values = this.columns > 0 ? this.axis.values : [this.least, this.most];
    const every = Math.ceil(values.length / 8);
    return values.flatMap((value, k) => {
      const at = this.at(value);
      const text = typeof value === "number" ? String(Number(value.toPrecision(4))) : `${value}`;
      return at === undefined || k % every !== 0 ? [] : [{ at, text }];
    });
  }
}

const kLeft = 62;
const kBottom = 40;
const kTop = 8;
const kRight = 10;
const kNear_px = 12;

/** A map that is drawn anew as its size or the colours change. */
export function mapCanvas(draw: () => void): HTMLCanvasElement {
  const canvas = element("canvas", { className: "map", role: "img" });
  new ResizeObserver(draw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  return canvas;
}

export class SuccessMap {
  readonly canvas = mapCanvas(() => this.draw());
  private places: Place[] = [];
  private marks: Mark[] = [];
  private axes: [AxisOf, AxisOf] | undefined;
  chosen: number | undefined;

  constructor(private readonly choose: (run: number) => void) {
    this.canvas.addEventListener("click", (event) => {
      const near = this.nearest(event.offsetX, event.offsetY);
      if (near !== undefined) {
        this.choose(near.mark.run);
      }
    });
    this.canvas.addEventListener("pointermove", (event) => {
      const near = this.nearest(event.offsetX, event.offsetY)?.mark;
      this.canvas.title =
        near === undefined ? "" : `run ${near.run}: ${near.outcome}\n${near.x}, ${near.y}`;
      this.canvas.style.cursor = near === undefined ? "default" : "pointer";
    });
  }
  show(axes: [AxisOf, AxisOf], marks: Mark[]): void {
    this.axes = axes;
    this.marks = marks;
    this.draw();
  }
  /** In pixels of the canvas, for tests and scripts. */
  placeOf(run: number): [number, number] | undefined {
    const found = this.places.find(({ mark }) => mark.run === run);
    return found && [found.x, found.y];
  }
  private nearest(x: number, y: number): Place | undefined {
    let near: Place | undefined;
    let least = kNear_px;
    for (const place of this.places) {
      const distance = Math.hypot(place.x - x, place.y - y);
      if (distance <= least) {
        least = distance;
        near = place;
      }
    }
    return near;
  }

  draw(): void {
    const drawing = drawingOn(this.canvas);
    if (this.axes === undefined || drawing === undefined) {
      return;
    }
    const { context, frame, style } = drawing;
    const x = new Scale(
      this.axes[0],
      this.marks.map((mark) => mark.x),
    );
    const y = new Scale(
      this.axes[1],
      this.marks.map((mark) => mark.y),
    );
    this.drawCells(context, x, y, frame);
    drawAxes(drawing, x, y);
    this.place(x, y, frame);
    for (const { mark, x, y } of this.places) {
      drawMark(context, mark, x, y);
      if (mark.run === this.chosen) {
        context.strokeStyle = style.getPropertyValue("--text");
        context.lineWidth = 2;
        context.beginPath();
        context.arc(x, y, 8, 0, 2 * Math.PI);
        context.stroke();
      }
    }
  }
  /** Runs of one cell side by side, in the order in which they ended. */
  private place(x: Scale, y: Scale, { toX, toY, wide, high }: Frame): void {
    const inCell = new Map<string, Mark[]>();
    for (const mark of this.marks) {
      const cell = `${x.columns > 0 ? mark.x : mark.run} ${y.columns > 0 ? mark.y : mark.run}`;
      const there = inCell.get(cell);
      if (there === undefined) {
        inCell.set(cell, [mark]);
      } else {
        there.push(mark);
      }
    }
    this.places = [];
    for (const marks of inCell.values()) {
      const side = Math.ceil(Math.sqrt(marks.length));
      const shift = (k: number): number => (0.8 * (k + 0.5)) / side - 0.4;
      marks.forEach((mark, k) => {
        const [u, v] = [x.at(mark.x), y.at(mark.y)];
        if (u !== undefined && v !== undefined) {
          this.places.push({
            mark,
            x: toX(u) + (x.columns > 0 ? (shift(k % side) * wide) / x.columns : 0),
            y: toY(v) + (y.columns > 0 ? (shift(Math.floor(k / side)) * high) / y.columns : 0),
          });
        }
      });
    }
  }
  private drawCells(context: CanvasRenderingContext2D, x: Scale, y: Scale, frame: Frame): void {
    if (x.columns === 0) {
      return;
    }
    const rows = Math.max(1, y.columns);
    const cells = new Map<string, { x: Value; y: Value; all: number; good: number }>();
    for (const mark of this.marks) {
      const name = `${mark.x} ${y.columns > 0 ? mark.y : ""}`;
      const cell = cells.get(name) ?? { x: mark.x, y: mark.y, all: 0, good: 0 };
      cells.set(name, cell);
      cell.all += 1;
      cell.good += mark.success ? 1 : 0;
    }
    const [w, h] = [frame.wide / x.columns, frame.high / rows];
    for (const cell of cells.values()) {
      const [u, v] = [x.at(cell.x), y.columns > 0 ? y.at(cell.y) : 0.5];
      if (u !== undefined && v !== undefined) {
        context.fillStyle = `rgb(0 114 178 / ${(0.45 * cell.good) / cell.all})`;
        context.fillRect(frame.toX(u) - w / 2 + 0.5, frame.toY(v) - h / 2 + 0.5, w - 1, h - 1);
      }
    }
  }
}

export interface Frame {
  toX: (share: number) => number;
  toY: (share: number) => number;
  wide: number;
  high: number;
}

export function drawMark(
  context: CanvasRenderingContext2D,
  { outcome, success }: { outcome: string; success: boolean },
  x: number,
  y: number,
): void {
  context.fillStyle = context.strokeStyle = colourOf(outcome);
  context.lineWidth = 2;
  context.beginPath();
  if (success) {
    context.arc(x, y, 3.5, 0, 2 * Math.PI);
    context.fill();
  } else {
    context.moveTo(x - 3, y - 3);
    context.lineTo(x + 3, y + 3);
    context.moveTo(x - 3, y + 3);
    context.lineTo(x + 3, y - 3);
    context.stroke();
  }
}

export interface Drawing {
  context: CanvasRenderingContext2D;
  frame: Frame;
  style: CSSStyleDeclaration;
}
/** Wiped, as large as it is seen; undefined while it is not. */
export function drawingOn(canvas: HTMLCanvasElement): Drawing | undefined {
  const { clientWidth, clientHeight } = canvas;
  const context = canvas.getContext("2d");
  if (clientWidth === 0 || context === null) {
    return undefined;
  }
  const ratio = window.devicePixelRatio;
  canvas.width = Math.round(clientWidth * ratio);
  canvas.height = Math.round(clientHeight * ratio);
  context.scale(ratio, ratio);
  const wide = clientWidth - kLeft - kRight;
  const high = clientHeight - kTop - kBottom;
  const toX = (share: number): number => kLeft + share * wide;
  const toY = (share: number): number => kTop + (1 - share) * high;
  return { context, frame: { toX, toY, wide, high }, style: getComputedStyle(canvas) };
}

export function drawAxes({ context, frame, style }: Drawing, x: Scale, y: Scale): void {
  const { toX, toY, wide, high } = frame;
  context.strokeStyle = style.getPropertyValue("--line");
  context.strokeRect(kLeft, kTop, wide, high);
  context.fillStyle = style.getPropertyValue("--text");
  context.font = "11px system-ui, sans-serif";
  context.textAlign = "center";
  for (const { at, text } of x.ticks()) {
    context.fillText(text, toX(at), kTop + high + 14, wide / Math.max(1, x.ticks().length));
  }
  context.fillText(x.axis.name, kLeft + wide / 2, kTop + high + 32, wide);
  context.textAlign = "right";
  for (const { at, text } of y.ticks()) {
    context.fillText(text, kLeft - 4, toY(at) + 4, kLeft - 22);
  }
  context.save();
  context.translate(11, kTop + high / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText(y.axis.name, 0, 0, high);
  context.restore();
}
