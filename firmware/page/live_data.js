// What the hub says now: its stations, the scan that arrived last, and how old all of that is.
import { get, get_if_there, on_login_needed } from './hub_api.js';
import { HubEvents } from './hub_events.js';

// Older than this, what is shown is no longer called live.
export const kFreshSeconds = 5;
const kPollMs = 2000;
// Shorter than kFreshSeconds: a hub that hangs is told from one that is slow once.
const kPollTimeoutMs = 4000;
const kTickMs = 500;

class LiveData extends EventTarget {
  constructor() {
    super();
    this.stations = [];
    this.latest = null;
    this.is_latest_known = false;  // null may mean that nothing was measured
    this.store_problem = null;
    this.answered_at = null;  // of performance.now()
    this.silent_since = null;  // of Date.now(); null while the hub answers
    this.needs_login = false;
    this.asked_at = -Infinity;
    this.latest_demanded = true;
    this.events = new HubEvents(['scan', 'shape', 'station', 'correction', 'missed'], () => this.note_open(),
      (name, data) => this.take_event(name, data));
  }

  start() {
    on_login_needed(() => this.note_login());
    this.events.start();
    setInterval(() => this.tick(), kTickMs);
    document.addEventListener('visibilitychange', () => this.note_visibility());
    window.addEventListener('pagehide', () => this.events.stop());
    window.addEventListener('pageshow', (event) => event.persisted && this.note_visibility());
    this.poll_now();
  }

  // A browser opens six connections to one hub, and each stream takes one: what nobody looks at holds none,
  // or the seventh page would wait for ever.
  note_visibility() {
    if (document.hidden) {
      this.events.stop();
    } else if (!this.needs_login) {
      this.events.start();
      this.poll_now();
    }
  }

  // Only what a poll brought makes the page live: other answers say nothing of stations and trays.
  note_answer() {
    this.answered_at = performance.now();
    this.silent_since = null;
    this.tell('age');
  }

  note_failure(error) {
    if (error.status === 0) this.silent_since ??= Date.now();
    this.latest_demanded = true;
    this.tell('age');
  }

  // The hub makes who sends many wrong tokens wait: nothing is asked with a token that it refused.
  note_login() {
    if (this.needs_login) return;
    this.needs_login = true;
    this.events.stop();
    this.tell('login');
  }

  // After a login everything is asked for anew.
  begin_session() {
    this.needs_login = false;
    this.events.start();
    this.demand_latest();
  }

  // Seconds since the hub answered; infinite before its first answer.
  age() {
    return this.answered_at === null ? Infinity : (performance.now() - this.answered_at) / 1000;
  }

  is_fresh() {
    return this.age() <= kFreshSeconds;
  }

  demand_latest() {
    this.latest_demanded = true;
    this.poll_now();
  }

  poll_now() {
    this.asked_at = -Infinity;
    this.tick();
  }

  // At once, so that "do not touch the tray" is seen in time; but twice a second at most, whatever many
  // stations say.
  poll_soon() {
    if (performance.now() - this.asked_at >= kTickMs) this.poll_now();
    else this.asked_at = Math.min(this.asked_at, performance.now() - kPollMs + kTickMs);
  }

  tick() {
    this.tell('age');
    if (this.is_asking || this.needs_login || performance.now() - this.asked_at < kPollMs) return;
    this.poll();
  }

  async poll() {
    this.is_asking = true;
    this.asked_at = performance.now();
    try {
      const heard_at = performance.now();
      const { stations } = await get('stations', { timeout_ms: kPollTimeoutMs });
      this.stations = stations.map((station) => ({ ...station, heard_at }));
      if (this.latest_demanded || !this.events.is_open) await this.read_latest();
      this.note_answer();
      this.tell('stations');
    } catch (error) {
      this.note_failure(error);
    } finally {
      this.is_asking = false;
    }
  }

  async read_latest() {
    this.latest_demanded = false;
    try {
      this.latest = await get_if_there('scans/latest', { timeout_ms: kPollTimeoutMs });
      this.is_latest_known = true;
      this.store_problem = null;
    } catch (error) {
      if (error.status !== 503) throw error;
      this.latest_demanded = true;  // the hub lives, and its store does not: the band says so
      this.store_problem = error.message;
    }
    this.tell('latest');
  }

  // What was told while nobody listened is asked for.
  note_open() {
    this.demand_latest();
    this.tell('open');
  }

  take_event(name, data) {
    if (name === 'station') return this.poll_soon();
    if (name !== 'shape') this.demand_latest();
    this.dispatchEvent(new CustomEvent(name, { detail: data }));
  }

  tell(name) {
    this.dispatchEvent(new Event(name));
  }
}

export const live = new LiveData();

// Calls `action` now and whenever one of `names` happens, until `signal` aborts.
export function follow(names, signal, action) {
  for (const name of names) live.addEventListener(name, action, { signal });
  action();
}

// Seconds since that station said something, as far as this page knows.
export function station_age(station) {
  return (performance.now() - station.heard_at + station.age_ms) / 1000;
}
