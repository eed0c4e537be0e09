// SPDX-License-Identifier: Apache-2.0
// Numbers over time, as a recording holds them.

/** A column that grows: twice the space whenever it is full. */
export class Column {
  private numbers = new Float64Array(256);
  private used = 0;

  push(value: number): void {
    if (this.used === this.numbers.length) {
      const more = new Float64Array(2 * this.used);
      more.set(this.numbers);
      this.numbers = more;
    }
    this.numbers[this.used++] = value;
  }
  get values(): Float64Array {
    return this.numbers.subarray(0, this.used);
  }
}

/** Samples of one channel: `columns[k]` is as long as `time`, times [s] never fall. */
export interface Table {
  topic: string;
  time: Float64Array;
  columns: Map<string, Float64Array>;
  texts: Map<string, string[]>;
}

/** @returns the last index whose time is not after `t`; -1 before the first */
export function indexAt(time: ArrayLike<number>, t: number): number {
  let low = 0;
  let high = time.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((time[middle] as number) <= t) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low - 1;
}

/** On the straight line between the samples around it; NaN outside of them. */
export function between(time: ArrayLike<number>, values: ArrayLike<number>, t: number): number {
  const at = indexAt(time, t);
  const [t0, v0] = [time[at] ?? Number.NaN, values[at] ?? Number.NaN];
  const [t1, v1] = [time[at + 1], values[at + 1]];
  if (t0 === t || t1 === undefined || v1 === undefined) {
    return t0 === t ? v0 : Number.NaN;
  }
  return v0 + ((v1 - v0) * (t - t0)) / (t1 - t0);
}

/** @returns the sample that holds at `t`, undefined before the first */
export function valueAt(
  time: ArrayLike<number>,
  values: ArrayLike<number>,
  t: number,
): number | undefined {
  const at = indexAt(time, t);
  return at < 0 ? undefined : values[at];
}
