// SPDX-License-Identifier: Apache-2.0
// Which numbers of a recording are charted, in which units.
import type { Recording, Wanted } from "../recording/recording";

export interface Line {
  label: string;
  topic: string;
  column: string;
  scale?: number;
  colour: string;
  dash?: number[];
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
      {
        label: "measured",
        topic: "/sensors/cup_pressure",
        column: "fluid_pressure",
        scale: 0.01,
        colour: grey,
      },
      { label: "true", topic: "/cup", column: "pressure_pa", scale: 0.01, colour: blue },
    ],
  },
  {
    title: "Force through the slider",
    unit: "N",
    lines: [
      { label: "measured", topic: "/sensors/force", column: "wrench.force.x", colour: grey },
      { label: "true", topic: "/truth/vehicle", column: "slider_force_n", colour: blue },
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
    lines: [
      { label: "true", topic: "/truth/pose", column: "pose.position.z", colour: blue },
      {
        label: "estimated",
        topic: "/estimate/pose",
        column: "pose.position.z",
        colour: orange,
        dash: [4, 3],
      },
    ],
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
const known = new WeakMap<Float64Array, Samples>();

/** @returns samples of a line, undefined when the recording has none */
export function samplesOf(recording: Recording, line: Line): Samples | undefined {
  const table = recording.tables.get(line.topic);
  const column = table?.columns.get(line.column);
  if (table === undefined || column === undefined || column.length === 0) {
    return undefined;
  }
  const before = known.get(column);
  if (before !== undefined) {
    return before;
  }
  const scale = line.scale ?? 1;
  const values = column.map((value) => (Number.isFinite(value) ? scale * value : Number.NaN));
  const samples = { time: table.time, values };
  known.set(column, samples);
  return samples;
}

/** What charts and scene ask of a recording, by topic. */
export const kColumns: Wanted = (() => {
  const all = new Map<string, string[]>([
    ["/guidance", ["attempt"]],
    ["/truth/vehicle", ["rotor_speed_rad_s[0]"]],
    ["/cup", ["gap_m"]],
  ]);
  for (const { topic, column } of kPanels.flatMap(({ lines }) => lines)) {
    all.set(topic, [...(all.get(topic) ?? []), column]);
  }
  return all;
})();
