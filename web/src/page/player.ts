// SPDX-License-Identifier: Apache-2.0
// Time goes on, at a speed, until the end.

export class Player {
  time = 0;
  speed = 1;
  playing = false;
  end = 0;
  private last_ms: number | undefined;

  /** @param step  at every picture of the screen: the time may have changed */
  constructor(private readonly step: () => void) {
    const frame = (now_ms: number): void => {
      if (this.playing) {
        this.time += this.speed * 1e-3 * Math.min(100, now_ms - (this.last_ms ?? now_ms));
        if (this.time >= this.end) {
          this.time = this.end;
          this.playing = false;
        }
      }
      this.last_ms = now_ms;
      this.step();
      requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }
  toggle(): void {
    if (!this.playing && this.time >= this.end) {
      this.time = 0;
    }
    this.playing = !this.playing;
  }
  seek(t: number): void {
    this.time = Math.min(this.end, Math.max(0, t));
  }
}
