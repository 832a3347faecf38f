// Requests to the hub's API. All addresses are relative: the page may lie below a path of a proxy.

// A shape of 200 kB or a long history over a weak network.
const kTimeoutMs = 20000;

export class HubError extends Error {
  // `status` 0: the hub did not answer. `code` and `message` are the hub's.
  constructor(status, code, message) {
    super(message);
    this.status = status;
    this.code = code;
  }
}

let tell_login_needed = () => {};

export function on_login_needed(action) {
  tell_login_needed = action;
}

async function ask(path, options) {
  const aborter = new AbortController();
  const timer = setTimeout(() => aborter.abort(), options.timeout_ms ?? kTimeoutMs);
  try {
    const answer = await fetch(path, { ...options, signal: aborter.signal, cache: 'no-store' });
    // The body belongs to the answer: a hub that stops in the middle has not answered.
    const body = options.binary && answer.ok ? await answer.blob() : await answer.text();
    return { answer, body };
  } catch {
    throw new HubError(0, 'silent', '');
  } finally {
    clearTimeout(timer);
  }
}

function parsed(text) {
  try {
    return JSON.parse(text);
  } catch {
    return null;
  }
}

async function request(path, options = {}) {
  const { answer, body } = await ask(path, options);
  if (answer.ok) return options.plain || options.binary ? body : parsed(body);
  if (answer.status === 401 && !options.is_login) tell_login_needed();
  if (options.accepted?.includes(answer.status)) return parsed(body);
  const error = parsed(body)?.error ?? {};
  throw new HubError(answer.status, error.code ?? String(answer.status), error.message ?? '');
}

export function get(path, options = {}) {
  return request(`api/v1/${path}`, options);
}

// Null where the hub has no such thing.
export async function get_if_there(path, options = {}) {
  try {
    return await request(`api/v1/${path}`, options);
  } catch (error) {
    if (error.status === 404) return null;
    throw error;
  }
}

export function get_picture(path) {
  return get_if_there(path, { binary: true });
}

function send(path, body, options = {}) {
  const headers = { 'Content-Type': 'application/json' };
  return request(`api/v1/${path}`, { method: 'POST', headers, body: JSON.stringify(body), ...options });
}

export function post(path, body) {
  return send(path, body);
}

export function log_in(token) {
  return send('login', { token }, { is_login: true });
}

// Without a body: the hub takes none there.
export function log_out() {
  return request('api/v1/logout', { method: 'POST' });
}

export function get_health() {
  return request('health', { accepted: [503] });
}

export function get_metrics() {
  return request('metrics', { plain: true });
}
