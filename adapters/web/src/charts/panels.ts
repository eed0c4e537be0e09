// SPDX-License-Identifier: Apache-2.0
// Which numbers of a recording are charted, in which units.
import type { Recording, Wanted } from "../recording/recording";
import { between } from "../recording/series";

export interface Line {
  label: string;
  topic: string;
  column: string;
  /** A topic whose column of the same name is taken off, at each of its times. */
  minus?: string;
  scale?: number;
  colour: string;
  width?: number; // [px]
}
export interface Panel {
  title: string;
  unit: string;
  lines: Line[];
}

const deg = 180 / Math.PI;
const blue = "#2f7ed8";
const orange = "#e07b39";
const green = "#3a9d5d";
const grey = "#8a939c";
/** Where two lines coincide nearly everywhere, both are seen. */
const under = { colour: blue, width: 4 };
const over = { colour: orange, width: 1 };

export const kPanels: Panel[] = [
  {
    title: "Attitude",
    unit: "deg",
    lines: [
      { label: "pitch", topic: "/truth/vehicle", column: "pitch_rad", scale: deg, colour: blue },
      { label: "roll", topic: "/truth/vehicle", column: "roll_rad", scale: deg, colour: orange },
      {
        label: "cup on its joint",
        topic: "/truth/vehicle",
        column: "cup_pitch_rad",
        scale: deg,
        colour: grey,
      },
    ],
  },
  {
    title: "Pressure in the cup",
    unit: "hPa",
    lines: [
      { label: "true", topic: "/cup", column: "pressure_pa", scale: 0.01, ...under },
      {
        label: "measured",
        topic: "/sensors/cup_pressure",
        column: "fluid_pressure",
        scale: 0.01,
        ...over,
      },
    ],
  },
  {
    title: "Force through the slider",
    unit: "N",
    lines: [
      { label: "true", topic: "/truth/vehicle", column: "slider_force_n", ...under },
      { label: "measured", topic: "/sensors/force", column: "wrench.force.x", ...over },
    ],
  },
  {
    title: "Load on the lip",
    unit: "N",
    lines: [
      { label: "pull", topic: "/cup", column: "pull_n", colour: blue },
      { label: "shear", topic: "/cup", column: "shear_n", colour: orange },
    ],
  },
  {
    title: "LiDARs",
    unit: "m",
    lines: [
      { label: "left", topic: "/sensors/range_left", column: "range", colour: blue },
      { label: "right", topic: "/sensors/range_right", column: "range", colour: orange },
    ],
  },
  {
    title: "Height",
    unit: "m",
    lines: [{ label: "true", topic: "/truth/pose", column: "pose.position.z", colour: blue }],
  },
  {
    title: "Error of the estimate",
    unit: "mm",
    lines: (["x", "y", "z"] as const).map((axis, k) => ({
      label: ["away from the wall", "along the wall", "up"][k] as string,
      topic: "/estimate/pose",
      column: `pose.position.${axis}`,
      minus: "/truth/pose",
      scale: 1000,
      colour: [blue, orange, green][k] as string,
    })),
  },
  {
    title: "Thrust",
    unit: "N",
    lines: [
      { label: "sum of the rotors", topic: "/truth/vehicle", column: "thrust_n", colour: green },
    ],
  },
];

export interface Samples {
  time: Float64Array;
  values: Float64Array;
}
/** In a panel's units, as they have been worked out, of recordings that do not grow. */
const known = new WeakMap<Float64Array, Map<string, Samples>>();

/** @returns samples of a line, undefined when the recording has none */
export function samplesOf(recording: Recording, line: Line): Samples | undefined {
  const table = recording.tables.get(line.topic);
  const column = table?.columns.get(line.column);
  if (table === undefined || column === undefined || column.length === 0) {
    return undefined;
  }
  const other = line.minus === undefined ? undefined : recording.tables.get(line.minus);
  const taken = other?.columns.get(line.column);
  if (line.minus !== undefined && (other === undefined || taken === undefined)) {
    return undefined;
  }
  const scale = line.scale ?? 1;
  const of = known.get(column) ?? new Map<string, Samples>();
  const key = `${scale} ${line.minus}`;
  const before = of.get(key);
  if (before !== undefined) {
    return before;
  }
  const values = column.map((value, k) => {
    const off = other && taken ? between(other.time, taken, table.time[k] as number) : 0;
    return Number.isFinite(value) ? scale * (value - off) : Number.NaN;
  });
  const samples = { time: table.time, values };
  known.set(column, of.set(key, samples));
  return samples;
}

/** What charts and scene ask of a recording, by topic. */
export const kColumns: Wanted = (() => {
  const all = new Map<string, string[]>([
    ["/guidance", ["attempt"]],
    ["/truth/vehicle", ["rotor_speed_rad_s[0]"]],
    ["/cup", ["gap_m"]],
  ]);
  for (const { topic, column, minus } of kPanels.flatMap(({ lines }) => lines)) {
    for (const one of [topic, minus ?? topic]) {
      all.set(one, [...new Set([...(all.get(one) ?? []), column])]);
    }
  }
  return all;
})();
