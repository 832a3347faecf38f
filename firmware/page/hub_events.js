// Server-sent events that come again by themselves, whatever happens to the hub or to the network between.

// The hub sends something every 10 s; twice as long without a word is a dead connection that no error tells of.
const kSilenceMs = 20000;
const kFirstWaitMs = 1000;
const kLongestWaitMs = 15000;

export class HubEvents {
  // `on_open` after each connection, `on_event(name, data)` for each event but heart-beats.
  constructor(names, on_open, on_event) {
    this.names = names;
    this.on_open = on_open;
    this.on_event = on_event;
    this.wait_ms = kFirstWaitMs;
    this.source = null;
    this.is_open = false;
  }

  start() {
    this.stop();
    const source = new EventSource('api/v1/events');
    this.source = source;
    this.watch();
    source.addEventListener('error', () => this.begin_again());
    source.addEventListener('heartbeat', () => this.hear());
    for (const name of this.names) {
      source.addEventListener(name, (event) => {
        this.hear();
        this.on_event(name, event.data);
      });
    }
  }

  stop() {
    clearTimeout(this.timer);
    this.source?.close();
    this.source = null;
    this.is_open = false;
  }

  hear() {
    this.wait_ms = kFirstWaitMs;
    this.watch();
    if (!this.is_open) {
      this.is_open = true;
      this.on_open();
    }
  }

  watch() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.begin_again(), kSilenceMs);
  }

  // The browser's own retry gives up for ever after some errors, so that each connection is a new one.
  begin_again() {
    this.stop();
    // Many pages lose the same hub at once; they should not all come back at once.
    this.timer = setTimeout(() => this.start(), this.wait_ms * (0.75 + Math.random() / 2));
    this.wait_ms = Math.min(this.wait_ms * 2, kLongestWaitMs);
  }
}
