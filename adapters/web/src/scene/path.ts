// SPDX-License-Identifier: Apache-2.0
// The way that was flown: pieces of a recording's marks in one line, as far as it had come.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments } from "three";
import type { Mark } from "../recording/recording";
import { indexAt } from "../recording/series";
import { colourOf } from "./marks";

export interface Piece {
  time: number;
  mark: Mark;
}

export class Path {
  readonly line: LineSegments;
  private readonly time: number[] = []; // of each segment

  /** @param pieces  in their order; at least one */
  constructor(pieces: Piece[]) {
    const points: number[] = [];
    for (const { time, mark } of pieces) {
      for (let k = 1; k < mark.points.length; ++k) {
        points.push(...(mark.points[k - 1] ?? []), ...(mark.points[k] ?? []));
        this.time.push(time);
      }
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
    const [{ mark }] = pieces as [Piece];
    this.line = new LineSegments(
      geometry,
      new LineBasicMaterial({
        color: colourOf(mark),
        opacity: mark.colour[3],
        transparent: true,
      }),
    );
    this.line.frustumCulled = false; // what is drawn of it changes
  }
  show(t: number): void {
    this.line.geometry.setDrawRange(0, 2 * (indexAt(this.time, t) + 1));
  }
}
