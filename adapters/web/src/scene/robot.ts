// SPDX-License-Identifier: Apache-2.0
// A URDF as shapes, a group for each link.
import {
  BoxGeometry,
  BufferGeometry,
  CylinderGeometry,
  Float32BufferAttribute,
  Group,
  type Material,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  SphereGeometry,
} from "three";

const numbers = (text: string | null | undefined): number[] =>
  (text ?? "")
    .trim()
    .split(/\s+/)
    .filter((word) => word !== "")
    .map(Number);

/** Binary STL, as recordings carry it. */
export function stlGeometry(bytes: Uint8Array): BufferGeometry {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const kHeader = 84;
  const kFacet = 50;
  const count = Math.min(
    view.getUint32(kHeader - 4, true),
    Math.floor((bytes.length - kHeader) / kFacet),
  );
  const points = new Float32Array(9 * count);
  for (let facet = 0; facet < count; ++facet) {
    for (let i = 0; i < 9; ++i) {
      points[9 * facet + i] = view.getFloat32(kHeader + kFacet * facet + 12 + 4 * i, true);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  geometry.computeVertexNormals();
  return geometry;
}

class Paints {
  private readonly known = new Map<string, Material>();

  constructor(
    robot: Element,
    private readonly opacity: number,
  ) {
    for (const material of robot.querySelectorAll(":scope > material")) {
      this.read(material);
    }
  }
  of(visual: Element): Material {
    const material = visual.querySelector("material");
    const name = material?.getAttribute("name") ?? "";
    const known = this.known.get(name);
    return known ?? (material === null ? this.make([0.6, 0.6, 0.6, 1]) : this.read(material));
  }
  private read(material: Element): Material {
    const rgba = numbers(material.querySelector("color")?.getAttribute("rgba"));
    const made = this.make(rgba.length === 4 ? rgba : [0.6, 0.6, 0.6, 1]);
    this.known.set(material.getAttribute("name") ?? "", made);
    return made;
  }
  private make(rgba: number[]): Material {
    const [r = 0, g = 0, b = 0, a = 1] = rgba;
    const opacity = a * this.opacity;
    const material = new MeshStandardMaterial({
      opacity,
      transparent: opacity < 1,
      depthWrite: opacity >= 1,
      roughness: 0.65,
      metalness: 0.1,
    });
    material.color.setRGB(r, g, b, "srgb");
    return material;
  }
}

function place(object: Object3D, origin: Element | null): void {
  const [x = 0, y = 0, z = 0] = numbers(origin?.getAttribute("xyz"));
  const [roll = 0, pitch = 0, yaw = 0] = numbers(origin?.getAttribute("rpy"));
  object.position.set(x, y, z);
  object.rotation.set(roll, pitch, yaw, "ZYX");
}

function shapeOf(
  geometry: Element | null,
  material: Material,
  meshes: Map<string, Uint8Array>,
): Object3D | undefined {
  const shape = geometry?.firstElementChild;
  switch (shape?.tagName) {
    case "box": {
      const [x = 1, y = 1, z = 1] = numbers(shape.getAttribute("size"));
      return new Mesh(new BoxGeometry(x, y, z), material);
    }
    case "cylinder": {
      const radius = Number(shape.getAttribute("radius"));
      const mesh = new Mesh(
        new CylinderGeometry(radius, radius, Number(shape.getAttribute("length")), 32),
        material,
      );
      mesh.rotation.x = Math.PI / 2; // along z
      return mesh;
    }
    case "sphere":
      return new Mesh(new SphereGeometry(Number(shape.getAttribute("radius")), 24, 16), material);
    case "mesh": {
      const bytes = meshes.get((shape.getAttribute("filename") ?? "").split("/").at(-1) ?? "");
      if (bytes === undefined) {
        return undefined;
      }
      const mesh = new Mesh(stlGeometry(bytes), material);
      const [x = 1, y = x, z = x] = numbers(shape.getAttribute("scale") ?? "1 1 1");
      mesh.scale.set(x, y, z);
      return mesh;
    }
  }
  return undefined;
}

/** Parts of a vehicle that do more than move along. */
export interface Robot {
  links: Map<string, Group>;
  /** Blades, which are seen while they stand, and the discs that they make when they turn. */
  blades: Object3D[];
  discs: Object3D[];
  /** What gives way of the cup, to be pressed along x. */
  soft: Group;
}

/** @param opacity  of all of it: below 1 for a ghost */
export function buildRobot(urdf: string, meshes: Map<string, Uint8Array>, opacity: number): Robot {
  const robot: Robot = { links: new Map(), blades: [], discs: [], soft: new Group() };
  const root = new DOMParser().parseFromString(urdf, "text/xml").documentElement;
  const paints = new Paints(root, opacity);
  for (const link of root.querySelectorAll(":scope > link")) {
    const name = link.getAttribute("name") ?? "";
    const group = new Group();
    group.name = name;
    for (const visual of link.querySelectorAll(":scope > visual")) {
      const shape = shapeOf(
        visual.querySelector("geometry > *")?.parentElement ?? null,
        paints.of(visual),
        meshes,
      );
      if (shape === undefined) {
        continue;
      }
      const placed = new Group();
      placed.name = visual.getAttribute("name") ?? "";
      place(placed, visual.querySelector("origin"));
      shape.castShadow = !paints.of(visual).transparent;
      shape.receiveShadow = true;
      placed.add(shape);
      if (placed.name.startsWith("blade")) {
        robot.blades.push(placed);
      } else if (placed.name.startsWith("rotor")) {
        robot.discs.push(placed);
      }
      if (name === "cup" && /lip|bellow|waist/.test(placed.name)) {
        robot.soft.add(placed);
      } else {
        group.add(placed);
      }
    }
    if (name === "cup") {
      group.add(robot.soft);
    }
    robot.links.set(name, group);
  }
  return robot;
}
