// SPDX-License-Identifier: Apache-2.0
// Requests of the lab's page to its server (limpet/lab/lab.hpp). The address carries the token.

export interface Row {
  key: string;
  unit: string;
  minimum: number;
  maximum: number;
  value: number;
  kind: "number" | "count" | "switch";
  what: string;
  source: string;
}
export interface Named {
  name: string;
  description: string;
}
export interface Choice {
  key: string;
  names: Named[];
  chosen: string;
}
export interface Section {
  name: string;
  rows: Row[];
  choices: Choice[];
}
export interface Schema {
  sections: Section[];
  surface: string;
  seed: number;
}
export interface Catalogue {
  scenario: string;
  scenarios: Named[];
  surfaces: Named[];
  vehicles: Named[];
  campaigns: Named[];
}
export interface Wish {
  scenario: string;
  set: string[];
  brief?: boolean;
  topics?: string[]; // whose messages are wanted; none: all
}

/** Of limpet/lab/many.hpp */
export interface ManyRow {
  run: number;
  outcome: string;
  reason: string;
  true_end: string; // of limpet/core/signals/true_end.hpp
  success: boolean;
  values: (number | string)[];
  metrics: (number | null)[];
}
export interface ManyState {
  id: number; // 0: none has begun; then the rest but the rows is missing
  name: string;
  scenario: string;
  runs: number;
  finished: number;
  running: boolean;
  left_s: number;
  problem: string;
  folder: string;
  keys: { key: string; values: (number | string)[] }[];
  metrics: string[];
  points: number;
  success: { runs: number; outcomes: string[]; low: number; high: number };
  rows: ManyRow[];
}
export interface Axis {
  key: string;
  from: number;
  to: number;
  count: number;
}
export type ManyWish = { campaign: string } | (Wish & { axes: Axis[]; repeats: number });

async function ask(path: string, wish?: object): Promise<Response> {
  const answer = await fetch(
    `${path}${location.search}`,
    wish && { method: "POST", body: JSON.stringify(wish) },
  );
  if (!answer.ok) {
    throw new Error((await answer.text()).trim() || `the server answers ${answer.status}`);
  }
  return answer;
}

const json = async <T>(path: string, wish?: object): Promise<T> =>
  (await ask(path, wish)).json() as Promise<T>;
const done = async (path: string): Promise<void> => void (await ask(path, {}));
const bytesOf = async (answer: Response): Promise<Uint8Array> =>
  new Uint8Array(await answer.arrayBuffer());

export const catalogue = () => json<Catalogue>("/catalogue");
export const schema = (wish: Wish) => json<Schema>("/schema", wish);
export const yaml = async (wish: Wish): Promise<string> => (await ask("/yaml", wish)).text();
/** @returns the recording, and how long the server took for it [ms] */
export async function fly(wish: Wish): Promise<{ bytes: Uint8Array; flight: number }> {
  const answer = await ask("/fly", wish);
  const timing = /dur=([\d.]+)/.exec(answer.headers.get("Server-Timing") ?? "");
  return { bytes: await bytesOf(answer), flight: Number(timing?.[1] ?? 0) };
}

export const manyBegin = (wish: ManyWish) => json<ManyState>("/many/begin", wish);
export const manyRows = (from: number) => json<ManyState>("/many/rows", { from });
export const manyStop = () => done("/many/stop");
export const manyFlight = async (id: number, run: number): Promise<Uint8Array> =>
  bytesOf(await ask("/many/flight", { id, run }));

/** Of limpet/lab/learn.hpp */
export interface LearnFlight {
  value: number;
  outcome: string;
  metrics: (number | null)[];
}
export interface LearnRow {
  key: string;
  unit: string;
  less: LearnFlight;
  more: LearnFlight;
}
export interface LearnState {
  id: number; // 0: nothing has begun
  running: boolean;
  flights: number;
  flown: number;
  metrics: string[];
  base: LearnFlight | null;
  rows: LearnRow[];
}
export const learnBegin = (wish: Wish & { share: number }) =>
  json<LearnState>("/learn/begin", wish);
export const learnState = () => json<LearnState>("/learn");
export const learnStop = () => done("/learn/stop");

/** Of limpet/lab/swing.hpp */
export interface SwingAxis {
  keys: string[];
  values: number[];
  own: number[]; // of the vehicle, by key
}
export interface SwingState {
  id: number; // 0: nothing has begun
  running: boolean;
  done: number;
  across: SwingAxis;
  up: SwingAxis;
  growth_1_s: (number | "none" | null)[]; // up by up; null: not yet
  own: { growth_1_s: number | null; frequency_Hz: number | null };
}
export interface SwingWishAxis {
  keys: string[];
  from: number;
  to: number;
  count: number;
}
export const swingBegin = (wish: Wish & { across: SwingWishAxis; up: SwingWishAxis }) =>
  json<SwingState>("/swing/begin", wish);
export const swingState = () => json<SwingState>("/swing");
export const swingStop = () => done("/swing/stop");
