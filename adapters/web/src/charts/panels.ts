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
  scale: number;
  colour: string;
  width?: number; // [px]
}
export interface Panel {
  title: string;
  unit: string;
  lines: Line[];
}

const kDegrees = 180 / Math.PI;
const blue = { colour: "#2f7ed8" };
const orange = { colour: "#e07b39" };
const green = { colour: "#3a9d5d" };
const grey = { colour: "#8a939c" };
/** Where two lines coincide nearly everywhere, both are seen. */
const under = { ...blue, width: 4 };
const over = { ...orange, width: 1 };

const line = (
  label: string,
  topic: string,
  column: string,
  look: Pick<Line, "colour" | "width">,
  scale = 1,
): Line => ({ label, topic, column, scale, ...look });
const kTruth = "/truth/vehicle";

export const kPanels: Panel[] = [
  {
    title: "Attitude",
    unit: "deg",
    lines: [
      line("pitch", kTruth, "pitch_rad", blue, kDegrees),
      line("roll", kTruth, "roll_rad", orange, kDegrees),
      line("cup on its joint", kTruth, "cup_pitch_rad", grey, kDegrees),
    ],
  },
  {
    title: "Pressure in the cup",
    unit: "hPa",
    lines: [
      line("true", "/cup", "pressure_pa", under, 0.01),
      line("measured", "/sensors/cup_pressure", "fluid_pressure", over, 0.01),
    ],
  },
  {
    title: "Force through the slider",
    unit: "N",
    lines: [
      line("true", kTruth, "slider_force_n", under),
      line("measured", "/sensors/force", "wrench.force.x", over),
    ],
  },
  {
    title: "Load on the lip",
    unit: "N",
    lines: [line("pull", "/cup", "pull_n", blue), line("shear", "/cup", "shear_n", orange)],
  },
  {
    title: "LiDARs",
    unit: "m",
    lines: [
      line("left", "/sensors/range_left", "range", blue),
      line("right", "/sensors/range_right", "range", orange),
    ],
  },
  {
    title: "Height",
    unit: "m",
    lines: [line("true", "/truth/pose", "pose.position.z", blue)],
  },
  {
    title: "Error of the estimate",
    unit: "mm",
    lines: [
      line("away from the wall", "/estimate/pose", "pose.position.x", blue, 1000),
      line("along the wall", "/estimate/pose", "pose.position.y", orange, 1000),
      line("up", "/estimate/pose", "pose.position.z", green, 1000),
    ].map((one) => ({ ...one, minus: "/truth/pose" })),
  },
  {
    title: "Thrust",
    unit: "N",
    lines: [line("sum of the rotors", kTruth, "thrust_n", green)],
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
  const { scale } = line;
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

/** The columns that charts and scene need, by topic. */
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
