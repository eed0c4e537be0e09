// SPDX-License-Identifier: Apache-2.0
// What a wall looks like: grey tiles drawn here, coloured by the mark.
import { CanvasTexture, RepeatWrapping, SRGBColorSpace } from "three";

const kTile_px = 256;

/** The same numbers every time. */
function noise(): () => number {
  let state = 12345;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

function speckle(
  context: CanvasRenderingContext2D,
  count: number,
  size: number,
  depth: number,
): void {
  const next = noise();
  for (let i = 0; i < count; ++i) {
    const shade = Math.round(255 * (1 - depth * next()));
    context.fillStyle = `rgb(${shade} ${shade} ${shade})`;
    const r = size * (0.3 + next());
    context.beginPath();
    context.ellipse(
      kTile_px * next(),
      kTile_px * next(),
      r,
      0.7 * r,
      Math.PI * next(),
      0,
      2 * Math.PI,
    );
    context.fill();
  }
}

function draw(context: CanvasRenderingContext2D, finish: string): void {
  context.fillStyle = "#f4f4f4";
  context.fillRect(0, 0, kTile_px, kTile_px);
  if (finish.includes("steel")) {
    const next = noise();
    for (let y = 0; y < kTile_px; ++y) {
      const shade = Math.round(225 + 30 * next());
      context.fillStyle = `rgb(${shade} ${shade} ${shade})`;
      context.fillRect(0, y, kTile_px, 1);
    }
  } else if (finish.includes("block")) {
    speckle(context, 500, 3, 0.15);
    context.strokeStyle = "#b8b8b8";
    context.lineWidth = 6;
    for (const [x, y] of [
      [0, 0],
      [-kTile_px / 2, kTile_px / 2],
      [kTile_px / 2, kTile_px / 2],
    ] as const) {
      context.strokeRect(x, y, kTile_px, kTile_px / 2);
    }
  } else if (!finish.includes("gel")) {
    speckle(context, 900, 5, 0.14);
    speckle(context, 60, 2.5, 0.5);
  }
}

/** @param width_m, height_m  of the face that it covers */
export function finishTexture(finish: string, width_m: number, height_m: number): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = kTile_px;
  const context = canvas.getContext("2d");
  if (context !== null) {
    draw(context, finish);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 8;
  texture.wrapS = texture.wrapT = RepeatWrapping;
  const kTile_m = finish.includes("block") ? 0.4 : 1.0;
  texture.repeat.set(
    Math.max(1, Math.round(width_m / kTile_m)),
    Math.max(1, Math.round(height_m / kTile_m)),
  );
  return texture;
}
