// SPDX-License-Identifier: Apache-2.0
// Time goes on, at a speed, until the end. While nothing changes nothing is drawn.

export class Player {
  time = 0;
  speed = 1;
  playing = false;
  end = 0;
  private last_ms: number | undefined;
  private woken = false;

  /**
   * @param step   shows the time as it is; @returns whether to go on with the next picture
   * @param paced  while it plays, called with the time since the picture before [ms]
   */
  constructor(
    private readonly step: () => boolean,
    private readonly paced: (took_ms: number) => void,
  ) {}

  /** Something has changed: step() at the screen's next picture. */
  wake(): void {
    if (!this.woken) {
      this.woken = true;
      requestAnimationFrame((now_ms) => this.frame(now_ms));
    }
  }
  private frame(now_ms: number): void {
    this.woken = false;
    if (this.playing) {
      if (this.last_ms !== undefined) {
        this.paced(now_ms - this.last_ms);
      }
      this.time += this.speed * 1e-3 * Math.min(100, now_ms - (this.last_ms ?? now_ms));
      if (this.time >= this.end) {
        this.time = this.end;
        this.playing = false;
      }
    }
    if (this.step() || this.playing) {
      this.last_ms = now_ms;
      this.wake();
    } else {
      this.last_ms = undefined;
    }
  }
  toggle(): void {
    if (!this.playing && this.time >= this.end) {
      this.time = 0;
    }
    this.playing = !this.playing;
    this.wake();
  }
  seek(t: number): void {
    this.time = Math.min(this.end, Math.max(0, t));
  }
}
