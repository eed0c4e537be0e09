// SPDX-License-Identifier: Apache-2.0
// How fast the swing on the cup grows, over two numbers, and where the vehicle is in it.
import { drawAxes, drawingOn, type Frame, mapCanvas, Scale } from "./map";
import type { SwingAxis, SwingState } from "./server";

/** Beyond it colours are the same [1/s]; as on the paper's map. */
const kMost_1_s = 0.6;

/** Where a value lies between the values of its axis, which stand in columns. */
export function shareAlong({ values }: SwingAxis, value: number): number {
  const [first, last] = [values[0] as number, values[values.length - 1] as number];
  const place = ((value - first) / (last - first)) * (values.length - 1);
  return (place + 0.5) / values.length;
}
export function valueAlong({ values }: SwingAxis, share: number): number {
  const [first, last] = [values[0] as number, values[values.length - 1] as number];
  const place = Math.min(values.length - 1, Math.max(0, share * values.length - 0.5));
  return first + ((last - first) * place) / (values.length - 1);
}

/** Of a point that is not yet there the one of the coarser map that it will replace. */
export function growthAt({ across, growth_1_s }: SwingState, i: number, j: number) {
  for (const mask of [~0, ~1, ~3]) {
    const growth = growth_1_s[(j & mask) * across.values.length + (i & mask)] ?? null;
    if (growth !== null) {
      return growth;
    }
  }
  return null;
}

/** Orange grows, blue decays. */
function colourOf(growth: number): string {
  const strength = Math.min(1, Math.abs(growth) / kMost_1_s);
  const base = growth > 0 ? "213 94 0" : "0 114 178";
  return `rgb(${base} / ${(0.1 + 0.75 * strength).toFixed(3)})`;
}

export class GrowthMap {
  readonly canvas = mapCanvas(() => this.draw());
  private state: SwingState | undefined;
  private names: [string, string] = ["", ""];
  private frame: Frame | undefined;

  /** @param choose  a click: values of both axes */
  constructor(choose: (across: number, up: number) => void) {
    this.canvas.addEventListener("click", ({ offsetX, offsetY }) => {
      const { state, frame } = this;
      if (state !== undefined && frame !== undefined) {
        const u = (offsetX - frame.toX(0)) / frame.wide;
        const v = (frame.toY(0) - offsetY) / frame.high;
        choose(valueAlong(state.across, u), valueAlong(state.up, v));
      }
    });
  }
  show(state: SwingState, names: [string, string]): void {
    this.state = state;
    this.names = names;
    this.draw();
  }
  draw(): void {
    const { state } = this;
    const drawing = drawingOn(this.canvas);
    if (state === undefined || drawing === undefined) {
      return;
    }
    const { context, frame, style } = drawing;
    this.frame = frame;
    const { across, up } = state;
    const [columns, rows] = [across.values.length, up.values.length];
    const [toX, toY] = [frame.toX, frame.toY].map(
      (to) => (share: number) => Math.round(to(share)),
    ) as [Frame["toX"], Frame["toY"]];
    for (let j = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i) {
        const growth = growthAt(state, i, j);
        const [x, y] = [toX(i / columns), toY((j + 1) / rows)];
        const [w, h] = [toX((i + 1) / columns) - x, toY(j / rows) - y];
        if (typeof growth === "number") {
          context.fillStyle = colourOf(growth);
          context.fillRect(x, y, w, h);
        } else if (growth === "none") {
          context.fillStyle = style.getPropertyValue("--line");
          context.fillRect(x + w / 3, y + h / 3, w / 3, h / 3);
        }
      }
    }
    this.drawBorder(context, frame, state, style.getPropertyValue("--text"));
    drawAxes(
      drawing,
      new Scale({ name: this.names[0], values: across.values }, []),
      new Scale({ name: this.names[1], values: up.values }, []),
    );
    this.drawOwn(context, frame, state, style);
  }
  /** Between what grows and what decays. */
  private drawBorder(
    context: CanvasRenderingContext2D,
    { toX, toY }: Frame,
    state: SwingState,
    colour: string,
  ): void {
    const [columns, rows] = [state.across.values.length, state.up.values.length];
    const grows = (i: number, j: number): boolean | undefined => {
      const growth = i < columns && j < rows ? growthAt(state, i, j) : null;
      return typeof growth === "number" ? growth > 0 : undefined;
    };
    const line = (i: number, j: number, k: number, l: number): void => {
      context.moveTo(toX(i / columns), toY(j / rows));
      context.lineTo(toX(k / columns), toY(l / rows));
    };
    const differ = (a?: boolean, b?: boolean): boolean =>
      a !== undefined && b !== undefined && a !== b;
    context.strokeStyle = colour;
    context.lineWidth = 1.5;
    context.beginPath();
    for (let j = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i) {
        if (differ(grows(i, j), grows(i + 1, j))) {
          line(i + 1, j, i + 1, j + 1);
        }
        if (differ(grows(i, j), grows(i, j + 1))) {
          line(i, j + 1, i + 1, j + 1);
        }
      }
    }
    context.stroke();
  }
  /** A bar where numbers of one axis differ, as motors that spin up and down do. */
  private drawOwn(
    context: CanvasRenderingContext2D,
    { toX, toY }: Frame,
    state: SwingState,
    style: CSSStyleDeclaration,
  ): void {
    const [x, y] = this.ownShares(state).map((shares) => [
      Math.min(...shares),
      Math.max(...shares),
    ]);
    const [[left, right], [low, high]] = [x as [number, number], y as [number, number]];
    const centre: [number, number] = [toX((left + right) / 2), toY((low + high) / 2)];
    context.save();
    context.beginPath();
    context.rect(toX(0), toY(1), toX(1) - toX(0), toY(0) - toY(1));
    context.clip();
    for (const [colour, width] of [
      [style.getPropertyValue("--ground"), 5],
      [style.getPropertyValue("--text"), 2],
    ] as const) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      context.moveTo(toX(left), centre[1]);
      context.lineTo(toX(right), centre[1]);
      context.moveTo(centre[0], toY(low));
      context.lineTo(centre[0], toY(high));
      context.moveTo(centre[0] + 6, centre[1]);
      context.arc(centre[0], centre[1], 6, 0, 2 * Math.PI);
      context.stroke();
    }
    context.restore();
  }
  private ownShares(state: SwingState): [number[], number[]] {
    const of = (axis: SwingAxis): number[] => axis.own.map((value) => shareAlong(axis, value));
    return [of(state.across), of(state.up)];
  }
  /** Of the vehicle's point, from the canvas' left and top [px], for tests and scripts. */
  own(): [number, number] | undefined {
    if (this.state === undefined || this.frame === undefined) {
      return undefined;
    }
    const [x, y] = this.ownShares(this.state);
    const mean = (all: number[]): number => (Math.min(...all) + Math.max(...all)) / 2;
    return [this.frame.toX(mean(x)), this.frame.toY(mean(y))];
  }
}
