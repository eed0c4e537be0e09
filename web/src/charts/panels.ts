// SPDX-License-Identifier: Apache-2.0
// Which numbers of a recording are charted, in which units.
import type { Recording } from "../recording/recording";

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

/** @returns samples of a line, undefined when the recording has none */
export function samplesOf(
  recording: Recording,
  line: Line,
): { time: Float64Array; values: number[] } | undefined {
  const table = recording.tables.get(line.topic);
  const column = table?.columns.get(line.column);
  if (table === undefined || column === undefined || column.length === 0) {
    return undefined;
  }
  const scale = line.scale ?? 1;
  return {
    time: table.time,
    values: Array.from(column, (value) => (Number.isFinite(value) ? scale * value : Number.NaN)),
  };
}

/** What charts and scene ask of a recording. */
export const kColumns = new Set([
  "/guidance",
  "/truth/vehicle",
  "/cup",
  ...kPanels.flatMap((panel) => panel.lines.map((line) => line.topic)),
]);
