// SPDX-License-Identifier: Apache-2.0
// Marks of a recording as shapes.
import {
  ArrowHelper,
  BoxGeometry,
  BufferGeometry,
  Color,
  CylinderGeometry,
  DoubleSide,
  Float32BufferAttribute,
  FrontSide,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  type Object3D,
  type Plane,
  SphereGeometry,
  Vector3,
} from "three";
import type { Mark } from "../recording/recording";
import { finishTexture } from "./finish";

// As visualization_msgs/Marker numbers them.
const kArrow = 0;
const kCube = 1;
const kSphere = 2;
const kCylinder = 3;
const kLineStrip = 4;
const kLineList = 5;

export function colourOf(mark: Mark): Color {
  return new Color().setRGB(mark.colour[0], mark.colour[1], mark.colour[2], "srgb");
}

function solid(mark: Mark, cut: Plane): Object3D {
  const [x, y, z] = mark.scale;
  const wall = mark.name.startsWith("wall/");
  const material = new MeshStandardMaterial({
    color: colourOf(mark),
    opacity: mark.colour[3],
    transparent: mark.colour[3] < 1,
    roughness: wall && mark.name.includes("steel") ? 0.35 : 0.9,
    metalness: wall && mark.name.includes("steel") ? 0.5 : 0,
    clippingPlanes: wall ? [cut] : [],
    side: wall ? DoubleSide : FrontSide,
  });
  const geometry =
    mark.type === kCube
      ? new BoxGeometry(x, y, z)
      : mark.type === kSphere
        ? new SphereGeometry(x / 2, 24, 16)
        : new CylinderGeometry(x / 2, x / 2, z, 96).rotateX(Math.PI / 2);
  // A box's faces are +x, -x, +y, ...: the vehicle is on the side of -x.
  const face = material.clone();
  if (wall) {
    face.map = finishTexture(mark.name.slice("wall/".length), y, z);
  }
  const mesh = new Mesh(
    geometry,
    mark.type === kCube ? [material, face, material, material, material, material] : face,
  );
  mesh.receiveShadow = wall;
  return mesh;
}

function lines(mark: Mark): Object3D {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(mark.points.flat(), 3));
  const material = new LineBasicMaterial({
    color: colourOf(mark),
    opacity: mark.colour[3],
    transparent: true,
  });
  return mark.type === kLineList
    ? new LineSegments(geometry, material)
    : new Line(geometry, material);
}

function arrow(mark: Mark): Object3D {
  const from = new Vector3(...(mark.points[0] ?? [0, 0, 0]));
  const way = new Vector3(...(mark.points[1] ?? [0, 0, 1])).sub(from);
  const length = way.length();
  const head = Math.min(0.04, 0.4 * length);
  return new ArrowHelper(way.normalize(), from, length, colourOf(mark), head, 0.6 * head);
}

/**
 * @param cut  what of a wall is in the way of the camera
 * @returns undefined for a kind that is not drawn
 */
export function markShape(mark: Mark, cut: Plane): Object3D | undefined {
  const shape =
    mark.type === kCube || mark.type === kSphere || mark.type === kCylinder
      ? solid(mark, cut)
      : mark.type === kLineStrip || mark.type === kLineList
        ? lines(mark)
        : mark.type === kArrow
          ? arrow(mark)
          : undefined;
  if (shape !== undefined && mark.type !== kArrow) {
    const [x, y, z, qx, qy, qz, qw] = mark.pose;
    shape.position.set(x, y, z);
    shape.quaternion.set(qx, qy, qz, qw);
  }
  return shape;
}

/** Whether they look the same. */
export function alike(a: Mark, b: Mark): boolean {
  const numbers = (mark: Mark): number[] => [
    mark.type,
    ...mark.pose,
    ...mark.scale,
    ...mark.colour,
    ...mark.points.flat(),
  ];
  const [ours, theirs] = [numbers(a), numbers(b)];
  return (
    a.frame === b.frame &&
    a.name === b.name &&
    ours.length === theirs.length &&
    ours.every((value, i) => value === theirs[i])
  );
}

export function dispose(shape: Object3D): void {
  shape.traverse((part) => {
    const drawn = part as Partial<Mesh>;
    drawn.geometry?.dispose();
    for (const material of [drawn.material ?? []].flat()) {
      (material as Partial<MeshStandardMaterial>).map?.dispose();
      material.dispose();
    }
  });
}
