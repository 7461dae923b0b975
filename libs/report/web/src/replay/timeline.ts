// The clock of the replay.

export class Timeline {
	time: number;
	speed = 50;
	playing = false;
	private readonly listeners: (() => void)[] = [];
	private last = 0;

	/** Stands at the end: the whole run is what is seen first. */
	constructor(readonly start: number, readonly end: number) {
		this.time = end;
	}

	onChange(listener: () => void): void {
		this.listeners.push(listener);
	}

	seek(time: number): void {
		this.time = Math.min(this.end, Math.max(this.start, time));
		this.changed();
	}

	toggle(): void {
		if (this.playing) this.pause();
		else this.play();
	}

	/** From the start again when it is over. */
	play(): void {
		if (this.time >= this.end) this.time = this.start;
		this.playing = true;
		this.last = performance.now();
		this.changed();
		requestAnimationFrame((now) => this.tick(now));
	}

	pause(): void {
		this.playing = false;
		this.changed();
	}

	private tick(now: number): void {
		if (!this.playing) return;
		this.time = Math.min(this.end, this.time + this.speed * Math.max(0, now - this.last) / 1000);
		this.last = now;
		this.playing = this.time < this.end;
		this.changed();
		if (this.playing) requestAnimationFrame((next) => this.tick(next));
	}

	private changed(): void {
		for (const listener of this.listeners) listener();
	}
}
