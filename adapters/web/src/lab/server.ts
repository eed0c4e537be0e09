// SPDX-License-Identifier: Apache-2.0
// What the lab's page asks its server for (limpet/lab/lab.hpp). The address carries the token.

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
    throw new Error((await answer.text()).trim() || `the server says ${answer.status}`);
  }
  return answer;
}

export const catalogue = async (): Promise<Catalogue> =>
  (await ask("/catalogue")).json() as Promise<Catalogue>;
export const schema = async (wish: Wish): Promise<Schema> =>
  (await ask("/schema", wish)).json() as Promise<Schema>;
export const yaml = async (wish: Wish): Promise<string> => (await ask("/yaml", wish)).text();
/** @returns the recording, and how long the server took for it [ms] */
export async function fly(wish: Wish): Promise<{ bytes: Uint8Array; flight: number }> {
  const answer = await ask("/fly", wish);
  const told = /dur=([\d.]+)/.exec(answer.headers.get("Server-Timing") ?? "");
  return { bytes: new Uint8Array(await answer.arrayBuffer()), flight: Number(told?.[1] ?? 0) };
}

const state = async (path: string, wish: object): Promise<ManyState> =>
  (await ask(path, wish)).json() as Promise<ManyState>;
export const manyBegin = (wish: ManyWish): Promise<ManyState> => state("/many/begin", wish);
export const manyRows = (from: number): Promise<ManyState> => state("/many/rows", { from });
export const manyStop = async (): Promise<void> => void (await ask("/many/stop", {}));
export const manyFlight = async (id: number, run: number): Promise<Uint8Array> =>
  new Uint8Array(await (await ask("/many/flight", { id, run })).arrayBuffer());

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
export const learnBegin = async (wish: Wish & { share: number }): Promise<LearnState> =>
  (await ask("/learn/begin", wish)).json() as Promise<LearnState>;
export const learnState = async (): Promise<LearnState> =>
  (await ask("/learn")).json() as Promise<LearnState>;
export const learnStop = async (): Promise<void> => void (await ask("/learn/stop", {}));

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
export const swingBegin = async (
  wish: Wish & { across: SwingWishAxis; up: SwingWishAxis },
): Promise<SwingState> => (await ask("/swing/begin", wish)).json() as Promise<SwingState>;
export const swingState = async (): Promise<SwingState> =>
  (await ask("/swing")).json() as Promise<SwingState>;
export const swingStop = async (): Promise<void> => void (await ask("/swing/stop", {}));
