// SPDX-License-Identifier: Apache-2.0
// A flight that is flying (`--live`), by Foxglove's WebSocket protocol, into a recording that grows.
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { type Channel, secondsAt } from "./mcap";
import { Builder, type Recording, type Wanted } from "./recording";

export interface LiveNews {
  /** Services that may be called, by name. */
  services(names: string[]): void;
  /** What it flies with, as it is now: all of them, then those that change. */
  parameters(changed: Parameter[]): void;
  /** A line of the flight, or the answer to a call. */
  text(text: string): void;
  closed(why: string): void;
}

/** As in the protocol; range and `settable` are additions of this program. */
export interface Parameter {
  name: string;
  value: number;
  settable?: boolean;
  minimum?: number;
  maximum?: number;
}
interface Service {
  id: number;
  name: string;
}
type Sent =
  | { op: "serverInfo"; name: string; capabilities: string[] }
  | { op: "advertise"; channels: Channel[] }
  | { op: "advertiseServices"; services: Service[] }
  | { op: "parameterValues"; parameters: Parameter[] }
  | { op: "status"; message: string }
  | { op: "serviceCallFailure"; message: string }
  | { op: "other" };

const kSubprotocols = ["foxglove.sdk.v1", "foxglove.websocket.v1"];
const kMessage = 1; // bytes from a flight begin so
const kAnswer = 3;
const kAsset = 4;
const kCall = 2; // and to it
const kNothing = [0, 1, 0, 0, 0]; // a request without fields, as CDR

/** @throws Error in a line where it is no flight of this machine */
export function liveAddress(text: string): URL {
  const found = /wss?:\/\/\S+/.exec(text)?.[0];
  const url = found === undefined ? undefined : new URL(found);
  if (url?.protocol !== "ws:" || !["127.0.0.1", "localhost"].includes(url.hostname)) {
    throw new Error(
      "an address as a flight of this machine prints it: ws://127.0.0.1:8765/?token=...",
    );
  }
  return url;
}

/** @returns the bytes of a call of a service */
export function callOf(service: number, call: number): Uint8Array<ArrayBuffer> {
  const encoding = new TextEncoder().encode("cdr");
  const bytes = new Uint8Array(13 + encoding.length + kNothing.length);
  const view = new DataView(bytes.buffer);
  view.setUint8(0, kCall);
  view.setUint32(1, service, true);
  view.setUint32(5, call, true);
  view.setUint32(9, encoding.length, true);
  bytes.set(encoding, 13);
  bytes.set(kNothing, 13 + encoding.length);
  return bytes;
}

export class LiveFlight {
  private readonly socket: WebSocket;
  private readonly builder: Builder;
  private readonly services = new Map<string, number>();
  private readonly answers = new MessageReader<{ success: boolean; message: string }>(
    parse("bool success\nstring message", { ros2: true }),
  );
  private calls = 0;
  private readonly meshes: string[] = []; // requested; their place is the request's number
  private fetches = false;
  messages = 0;

  constructor(
    address: URL,
    columns: Wanted,
    private readonly news: LiveNews,
  ) {
    this.builder = new Builder("live", columns);
    this.socket = new WebSocket(address, kSubprotocols);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("message", ({ data }: MessageEvent<string | ArrayBuffer>) =>
      typeof data === "string" ? this.receive(JSON.parse(data) as Sent) : this.take(data),
    );
    this.socket.addEventListener("close", ({ code }) =>
      this.news.closed(
        this.messages > 0 || code !== 1006
          ? "the flight is no longer there"
          : "no flight answers there, or its token is another one",
      ),
    );
  }
  close(): void {
    this.socket.close();
  }
  /** As far as it has come. */
  recording(): Recording {
    return this.builder.built();
  }
  call(name: string): void {
    const service = this.services.get(name);
    if (service !== undefined && this.socket.readyState === WebSocket.OPEN) {
      this.calls += 1;
      this.socket.send(callOf(service, this.calls));
    }
  }

  /** The flight answers with the value that holds, and the reason where it is another one. */
  set(name: string, value: number): void {
    if (Number.isFinite(value)) {
      this.send({ op: "setParameters", parameters: [{ name, value }], id: "set" });
    }
  }
  private send(wish: object): void {
    if (this.socket.readyState === WebSocket.OPEN) {
      this.socket.send(JSON.stringify(wish));
    }
  }

  private receive(sent: Sent): void {
    switch (sent.op) {
      case "serverInfo":
        this.builder.recording.scenario = sent.name.replace(/^limpet: /, "");
        this.fetches = sent.capabilities.includes("assets");
        if (sent.capabilities.includes("parameters")) {
          this.send({ op: "getParameters", parameterNames: [], id: "all" });
          this.send({ op: "subscribeParameterUpdates", parameterNames: [] });
        }
        break;
      case "parameterValues":
        this.news.parameters(sent.parameters);
        break;
      case "advertise": {
        const wanted = sent.channels.filter((channel) => this.builder.channel(channel));
        const subscriptions = wanted.map(({ id }) => ({ id, channelId: id }));
        this.send({ op: "subscribe", subscriptions });
        break;
      }
      case "advertiseServices":
        for (const { id, name } of sent.services) {
          this.services.set(name, id);
        }
        this.news.services([...this.services.keys()]);
        break;
      case "status":
      case "serviceCallFailure":
        this.news.text(sent.message);
        break;
    }
  }
  private take(data: ArrayBuffer): void {
    const view = new DataView(data);
    switch (view.getUint8(0)) {
      case kMessage:
        this.messages += 1;
        this.builder.message(view.getUint32(1, true), secondsAt(view, 5), new Uint8Array(data, 13));
        this.fetchMeshes();
        break;
      case kAsset:
        this.takeMesh(view, new Uint8Array(data));
        break;
      case kAnswer: {
        const from = 13 + view.getUint32(9, true);
        const { message } = this.answers.readMessage(new Uint8Array(data, from));
        this.news.text(message);
        break;
      }
    }
  }
  /** Those that the vehicle's description names, once it has come. */
  private fetchMeshes(): void {
    const { urdf } = this.builder.recording;
    if (!this.fetches || urdf === "") {
      return;
    }
    this.fetches = false;
    for (const [, uri] of urdf.matchAll(/<mesh filename="([^"]+)"/g)) {
      if (uri !== undefined && !this.meshes.includes(uri)) {
        this.send({ op: "fetchAsset", requestId: this.meshes.length, uri });
        this.meshes.push(uri);
      }
    }
  }
  private takeMesh(view: DataView, bytes: Uint8Array): void {
    const from = 10 + view.getUint32(6, true);
    const name = this.meshes[view.getUint32(1, true)]?.split("/").at(-1);
    if (view.getUint8(5) !== 0) {
      this.news.text(new TextDecoder().decode(bytes.subarray(10, from)));
    } else if (name !== undefined) {
      this.builder.attachment(name, bytes.subarray(from));
    }
  }
}
