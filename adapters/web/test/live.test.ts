// SPDX-License-Identifier: Apache-2.0
// A flight that is watched while it flies (LIMPET_PROGRAM), by the client of the protocol's authors.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { test } from "node:test";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import type {
  Channel,
  FetchAssetResponse,
  FoxgloveClient,
  MessageData,
  Parameter,
  ServerInfo,
  Service,
} from "@foxglove/ws-protocol";
import protocol from "@foxglove/ws-protocol"; // CommonJS: no names of its own
import { WebSocket } from "ws";
import { Flight, program } from "./flight";

const skip = program === "";

type Message = { topic: string; time_ns: bigint; value: Record<string, unknown> };

/** A viewer, with all that it received. */
class Viewer {
  readonly socket: WebSocket;
  readonly client: FoxgloveClient;
  info?: ServerInfo;
  channels = new Map<string, Channel>();
  services = new Map<string, Service>();
  messages: Message[] = [];
  texts: string[] = [];
  time_ns = 0n;
  answers: { success: boolean; text: string }[] = [];
  values: { id?: string; parameters: Parameter[] }[] = [];
  closed = false;
  private readonly readers = new Map<number, { topic: string; reader: MessageReader }>();
  private wakes: (() => void)[] = [];

  constructor(address: string, subprotocol: string) {
    this.socket = new WebSocket(address, [subprotocol]);
    // biome-ignore lint/suspicious/noExplicitAny: two libraries' types of the same thing
    this.client = new protocol.FoxgloveClient({ ws: this.socket as any });
    const received = (take: () => void) => {
      take();
      for (const wake of this.wakes.splice(0)) {
        wake();
      }
    };
    this.client.on("error", (error) => {
      throw error;
    });
    this.client.on("close", () =>
      received(() => {
        this.closed = true;
      }),
    );
    this.client.on("serverInfo", (info) =>
      received(() => {
        this.info = info;
      }),
    );
    this.client.on("advertise", (channels) =>
      received(() => {
        for (const channel of channels) {
          this.channels.set(channel.topic, channel);
        }
      }),
    );
    this.client.on("advertiseServices", (services) =>
      received(() => {
        for (const service of services) {
          this.services.set(service.name, service);
        }
      }),
    );
    this.client.on("status", (status) => received(() => this.texts.push(status.message)));
    this.client.on("parameterValues", (values) => received(() => this.values.push(values)));
    this.client.on("time", (time) =>
      received(() => {
        assert.ok(time.timestamp >= this.time_ns);
        this.time_ns = time.timestamp;
      }),
    );
    this.client.on("message", (message) => received(() => this.take(message)));
    this.client.on("serviceCallResponse", (response) =>
      received(() => {
        const reader = new MessageReader(parse("bool success\nstring message", { ros2: true }));
        const { success, message } = reader.readMessage<{ success: boolean; message: string }>(
          response.data,
        );
        this.answers.push({ success, text: message });
      }),
    );
  }
  private take({ subscriptionId, timestamp, data }: MessageData) {
    const of = this.readers.get(subscriptionId);
    assert.ok(of);
    this.messages.push({
      topic: of.topic,
      time_ns: timestamp,
      value: of.reader.readMessage(data),
    });
  }
  async until(so: () => boolean): Promise<void> {
    while (!so()) {
      assert.ok(!this.closed, "the flight has ended");
      await new Promise<void>((wake) => this.wakes.push(wake));
    }
  }
  subscribe(topic: string) {
    const channel = this.channels.get(topic);
    assert.ok(channel, topic);
    assert.equal(channel.encoding, "cdr");
    assert.equal(channel.schemaEncoding, "ros2msg");
    const reader = new MessageReader(parse(channel.schema, { ros2: true }));
    this.readers.set(this.client.subscribe(channel.id), { topic, reader });
  }
  unsubscribe() {
    for (const subscription of this.readers.keys()) {
      this.client.unsubscribe(subscription);
    }
  }
  of(topic: string): Message[] {
    return this.messages.filter((message) => message.topic === topic);
  }
  async call(service: string): Promise<{ success: boolean; text: string }> {
    const before = this.answers.length;
    const serviceId = this.services.get(service)?.id as number;
    const data = new Uint8Array([0, 1, 0, 0, 0]);
    this.client.sendServiceCallRequest({ serviceId, callId: 7, encoding: "cdr", data });
    await this.until(() => this.answers.length > before);
    return this.answers[before] as { success: boolean; text: string };
  }
}

const plain = () =>
  JSON.parse(
    execFileSync(program, ["fly", "perch_concrete", "--no-record", "--json"], {
      stdio: ["ignore", "pipe", "ignore"],
    }).toString(),
  );

type Transforms = {
  transforms: { header: { frame_id: string }; child_frame_id: string }[];
};

test("a flight is watched, and no other for it", { skip, timeout: 60_000 }, async () => {
  const flight = new Flight(4);
  const address = await flight.address();
  const viewer = new Viewer(address, "foxglove.sdk.v1");
  await viewer.until(() => viewer.channels.size >= 23);
  assert.equal(viewer.socket.protocol, "foxglove.sdk.v1");
  assert.equal(viewer.info?.name, "limpet: perch_concrete");
  for (const topic of viewer.channels.keys()) {
    viewer.subscribe(topic);
  }
  const late = new Viewer(address, "foxglove.websocket.v1");
  await late.until(() => late.channels.size === viewer.channels.size);
  await viewer.until(() => viewer.of("/truth/pose").length >= 100);

  // Poses: decoded, in their order, within 10 m.
  let before_ns = -1n;
  for (const { time_ns, value } of viewer.of("/truth/pose")) {
    const { header, pose } = value as {
      header: { frame_id: string; stamp: { sec: number; nsec?: number; nanosec?: number } };
      pose: { position: { x: number; y: number; z: number } };
    };
    assert.equal(header.frame_id, "map");
    assert.ok(time_ns > before_ns);
    before_ns = time_ns;
    assert.ok(Math.hypot(pose.position.x, pose.position.y, pose.position.z) < 10);
  }
  // Every frame that a message names, and every link, hangs on the map.
  const parent = new Map<string, string>();
  for (const topic of ["/tf", "/tf_static"]) {
    for (const { value } of viewer.of(topic)) {
      for (const transform of (value as Transforms).transforms) {
        parent.set(transform.child_frame_id, transform.header.frame_id);
      }
    }
  }
  const named = new Set<string>();
  for (const { value } of viewer.messages) {
    const frame = (value as { header?: { frame_id: string } }).header?.frame_id;
    if (frame) {
      named.add(frame);
    }
  }
  const description = viewer.of("/robot_description")[0]?.value as { data: string };
  for (const link of description.data.matchAll(/<link name="([^"]+)"/g)) {
    named.add(link[1] as string);
  }
  assert.ok(named.size > 3);
  for (const frame of named) {
    let top = frame;
    for (let steps = 0; parent.has(top) && steps < 20; ++steps) {
      top = parent.get(top) as string;
    }
    assert.equal(top, "map", frame);
  }

  // A late viewer gets the static messages.
  for (const topic of ["/robot_description", "/tf_static", "/scene"]) {
    late.subscribe(topic);
  }
  await late.until(() => late.of("/scene").length > 0 && late.of("/tf_static").length > 0);
  assert.deepEqual(late.of("/robot_description")[0]?.value, description);
  const { markers } = late.of("/scene")[0]?.value as { markers: { ns: string }[] };
  assert.match(markers[0]?.ns ?? "", /^wall\//);
  assert.ok(late.time_ns > 0n);

  // One vanishes, the other unsubscribes, and sees the end.
  late.socket.terminate();
  viewer.unsubscribe();
  await viewer.until(() => viewer.texts.length > 0);
  const result = await flight.end();
  const last_ns = viewer.messages.at(-1)?.time_ns ?? 0n;
  assert.ok(viewer.time_ns > last_ns, "nothing comes any more, and time goes on");
  const alone = plain();
  assert.deepEqual(viewer.texts, [`${alone.outcome}: ${alone.reason}`]);
  assert.equal(result.outcome, alone.outcome);
  assert.equal(result.hash, alone.hash);
  assert.match(flight.text, /2 came to watch/);
});

test("parameters and services", { skip, timeout: 60_000 }, async () => {
  const flight = new Flight(20);
  const viewer = new Viewer(await flight.address(), "foxglove.websocket.v1");
  await viewer.until(() => viewer.services.size === 4 && viewer.channels.size >= 23);
  assert.deepEqual(viewer.info?.capabilities, [
    "time",
    "assets",
    "parameters",
    "parametersSubscribe",
    "services",
  ]);
  const get = async (names: string[]) => {
    const before = viewer.values.length;
    viewer.client.getParameters(names, "got");
    await viewer.until(() => viewer.values.length > before);
    const { id, parameters } = viewer.values[before] as { id?: string; parameters: Parameter[] };
    assert.equal(id, "got");
    return new Map(parameters.map(({ name, value }) => [name, value]));
  };
  const set = async (name: string, value: Parameter["value"]) => {
    const before = viewer.values.length;
    viewer.client.setParameters([{ name, value }], "set");
    await viewer.until(() => viewer.values.length > before);
  };
  const rate = "autopilot.MC_PITCHRATE_P";
  const speed = "guidance.dock_speed_m_s";
  const all = await get([]);
  assert.ok(all.size > 100);
  assert.ok(typeof all.get(rate) === "number" && typeof all.get(speed) === "number");

  // It waits for a viewer; now it flies, and comes to a stop.
  viewer.subscribe("/events");
  assert.deepEqual(await viewer.call("/pause"), { success: true, text: "paused" });
  assert.equal((await viewer.call("/pause")).success, false);
  assert.equal((await viewer.call("/take_off")).text, "does not rest on the wall");

  const wanted = (all.get(rate) as number) * 1.01;
  await set(rate, wanted);
  assert.equal((await get([rate])).get(rate), wanted);
  await set(speed, 0.5);
  assert.equal((await get([speed])).get(speed), all.get(speed));
  await set(rate, 1e9);
  await set("guidance.nothing", 1);
  assert.equal(viewer.texts.length, 3);
  assert.match(viewer.texts[0] ?? "", /dock_speed_m_s cannot be changed in flight/);
  assert.match(viewer.texts[1] ?? "", /out of range, allowed/);
  assert.match(viewer.texts[2] ?? "", /no parameter guidance.nothing/);
  viewer.socket.send("no JSON");
  viewer.socket.send('{"op": "dance"}');
  await viewer.until(() => viewer.texts.length === 5);

  // What was set is an event of the flight.
  assert.equal((await viewer.call("/resume")).success, true);
  const events = () => viewer.of("/events").map(({ value }) => value.name as string);
  await viewer.until(() => events().includes("parameter_set"));
  assert.equal((await viewer.call("/abort")).success, true);
  const result = await flight.end();
  assert.equal(result.outcome, "aborted");
  assert.equal(result.reason, "a viewer asked for it");
});

// The layouts' folder is next to the vehicles'.
const cad = join(process.env.LIMPET_LAYOUTS ?? "", "../vehicles/cad_uav/cad_uav.yaml");
test("the meshes of a vehicle from CAD are fetched", { skip, timeout: 60_000 }, async () => {
  const flight = new Flight(20, "--set", `vehicle=${cad}`);
  const viewer = new Viewer(await flight.address(), "foxglove.sdk.v1");
  await viewer.until(() => viewer.channels.size >= 23);
  viewer.subscribe("/robot_description");
  await viewer.until(() => viewer.of("/robot_description").length > 0);
  const { data } = viewer.of("/robot_description")[0]?.value as { data: string };
  const named = [...new Set([...data.matchAll(/<mesh filename="([^"]+)"/g)].map(([, uri]) => uri))];
  assert.ok(named.length > 3);
  const fetched = (uri: string, request: number): Promise<FetchAssetResponse> => {
    const answer = new Promise<FetchAssetResponse>((done) =>
      viewer.client.on("fetchAssetResponse", (one) => one.requestId === request && done(one)),
    );
    viewer.client.fetchAsset(uri, request);
    return answer;
  };
  for (const [k, uri] of named.entries()) {
    const answer = await fetched(uri as string, k);
    assert.ok(answer.status === 0, uri);
    const { buffer, byteOffset } = answer.data;
    const facets = new DataView(buffer, byteOffset).getUint32(80, true);
    assert.ok(facets > 3 && answer.data.byteLength === 84 + 50 * facets, `${uri}: ${facets}`);
  }
  const missing = await fetched("package://cad_uav/../../secret.stl", 99);
  assert.ok(missing.status === 1 && /there is no/.test(missing.error));
  viewer.socket.close();
  flight.kill();
});

test("a foreign page and a wrong token stay outside", { skip, timeout: 60_000 }, async () => {
  const flight = new Flight(20);
  const address = await flight.address();
  const knock = (where: string, origin?: string) =>
    new Promise<string>((done) => {
      const socket = new WebSocket(where, ["foxglove.sdk.v1"], origin ? { origin } : {});
      socket.on("error", (error) => done(error.message));
      socket.on("open", () => {
        socket.terminate();
        done("open");
      });
    });
  assert.match(await knock(address, "https://evil.example"), /403/);
  assert.match(await knock(address.replace(/token=.*/, "token=0")), /403/);
  assert.match(await knock(address.replace(/\?token=.*/, "")), /403/);
  assert.match(await knock(address, "http://192.0.2.1:8080"), /403/);
  assert.equal(await knock(address, "https://app.foxglove.dev"), "open");
  assert.equal(await knock(address, "http://127.0.0.1:40000"), "open"); // the lab's
  assert.match(
    await knock(address.replace(/token=.*/, "token=0"), "http://127.0.0.1:40000"),
    /403/,
  );
  flight.kill();
});
