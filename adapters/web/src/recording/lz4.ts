// SPDX-License-Identifier: Apache-2.0
// Frames of LZ4, as chunks of a recording and whole files are packed. Checksums are skipped: a chunk of an MCAP carries its own CRC.
// Source: the frame format 1.6.4 and the block format of LZ4, https://github.com/lz4/lz4/tree/dev/doc

export const kLz4Magic = 0x184d2204;
const kShortestMatch = 4;

/** What is unpacked so far; grows up to a bound. */
class Output {
  private bytes: Uint8Array;
  at = 0;

  constructor(
    size: number,
    private readonly most: number,
  ) {
    this.bytes = new Uint8Array(size);
  }
  get taken(): Uint8Array {
    return this.bytes.subarray(0, this.at);
  }
  private reserve(count: number): void {
    const wanted = this.at + count;
    if (wanted > this.most) {
      throw new Error("it unpacks to more than its declared size");
    }
    if (wanted > this.bytes.length) {
      const larger = new Uint8Array(Math.min(this.most, Math.max(wanted, 2 * this.bytes.length)));
      larger.set(this.taken);
      this.bytes = larger;
    }
  }
  append(bytes: Uint8Array): void {
    this.reserve(bytes.length);
    this.bytes.set(bytes, this.at);
    this.at += bytes.length;
  }
  /** What stands `back` bytes before, which may run into what is being written. */
  repeat(back: number, count: number): void {
    if (back === 0 || back > this.at) {
      throw new Error("its LZ4 refers to what is not there");
    }
    this.reserve(count);
    for (let i = 0; i < count; ++i, ++this.at) {
      this.bytes[this.at] = this.bytes[this.at - back] as number;
    }
  }
}

class Input {
  at = 0;
  constructor(private readonly bytes: Uint8Array) {}
  get left(): number {
    return this.bytes.length - this.at;
  }
  take(count: number): Uint8Array {
    if (count > this.left) {
      throw new Error("its LZ4 ends early");
    }
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
  byte(): number {
    return this.take(1)[0] as number;
  }
  u32(): number {
    const [a, b, c, d] = this.take(4) as unknown as [number, number, number, number];
    return (a | (b << 8) | (c << 16) | (d << 24)) >>> 0;
  }
  /** A length of four bits, and what follows when they are full. */
  length(nibble: number): number {
    const kFull = 15;
    const kMore = 255;
    let length = nibble;
    for (let next = nibble === kFull ? kMore : 0; next === kMore; ) {
      next = this.byte();
      length += next;
    }
    return length;
  }
}

function unpackBlock(block: Input, out: Output): void {
  while (block.left > 0) {
    const token = block.byte();
    out.append(block.take(block.length(token >> 4)));
    if (block.left === 0) {
      return; // the last sequence is literals alone
    }
    const back = block.byte() | (block.byte() << 8);
    out.repeat(back, block.length(token & 15) + kShortestMatch);
  }
}

function unpackFrame(input: Input, out: Output): void {
  if (input.u32() !== kLz4Magic) {
    throw new Error("it is no frame of LZ4");
  }
  const flags = input.byte();
  const [checked, sized, summed, dictionary] = [16, 8, 4, 1].map((bit) => (flags & bit) !== 0);
  if (flags >> 6 !== 1 || dictionary) {
    throw new Error("its LZ4 is of another version, or with a dictionary");
  }
  input.take(1 + (sized ? 8 : 0) + 1); // largest block, size, checksum of these
  for (let size = input.u32(); size !== 0; size = input.u32()) {
    const block = input.take(size & 0x7fffffff);
    if (size > 0x7fffffff) {
      out.append(block);
    } else {
      unpackBlock(new Input(block), out);
    }
    input.take(checked ? 4 : 0);
  }
  input.take(summed ? 4 : 0);
}

/**
 * @param size  of what comes out, if it is known
 * @param most  bytes that come out
 * @throws Error where it is none, or more
 */
export function unpackLz4(packed: Uint8Array, size: number, most: number): Uint8Array {
  const input = new Input(packed);
  const out = new Output(size, most);
  do {
    unpackFrame(input, out);
  } while (input.left > 0);
  return out.taken;
}
