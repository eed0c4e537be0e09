// SPDX-License-Identifier: Apache-2.0
import { Column, indexAt } from "./series";

/** x, y, z [m] and a unit quaternion x, y, z, w. */
export type Pose = [number, number, number, number, number, number, number];

/** Where a frame is in its parent, over time. */
export class Track {
  private readonly times = new Column();
  private readonly parts = Array.from({ length: 7 }, () => new Column());

  constructor(readonly parent: string) {}

  push(t: number, pose: Pose): void {
    this.times.push(t);
    for (let i = 0; i < 7; ++i) {
      (this.parts[i] as Column).push(pose[i] as number);
    }
  }
  get time(): Float64Array {
    return this.times.values;
  }
  private sample(k: number): Pose {
    return this.parts.map((part) => part.values[k] as number) as Pose;
  }
  /** Between samples straight on; before the first and after the last as there. */
  at(t: number): Pose {
    const time = this.times.values;
    const before = Math.max(0, indexAt(time, t));
    const after = Math.min(before + 1, time.length - 1);
    const a = this.sample(before);
    if (after === before) {
      return a;
    }
    const b = this.sample(after);
    const span = (time[after] as number) - (time[before] as number);
    const share = span > 0 ? Math.min(1, Math.max(0, (t - (time[before] as number)) / span)) : 0;
    return between(a, b, share);
  }
}

function between(a: Pose, b: Pose, share: number): Pose {
  const same = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0 ? -1 : 1;
  // Samples are hundredths of a second apart: a straight line and its length's correction will do.
  const mixed = a.map(
    (value, i) => (1 - share) * value + share * (i < 3 ? 1 : same) * (b[i] as number),
  );
  const size = Math.hypot(...mixed.slice(3));
  return mixed.map((value, i) => (i < 3 ? value : value / size)) as Pose;
}
