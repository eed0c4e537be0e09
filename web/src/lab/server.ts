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
}
export interface Wish {
  scenario: string;
  set: string[];
  brief?: boolean;
}

async function ask(path: string, wish?: Wish): Promise<Response> {
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
export const fly = async (wish: Wish): Promise<Uint8Array> =>
  new Uint8Array(await (await ask("/fly", wish)).arrayBuffer());
