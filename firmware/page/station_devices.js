// The devices of a station, each with what it does.
import { element } from './elements.js';
import { live } from './live_data.js';
import { mark } from './marks.js';
import { word, word_of } from './words.js';

const kKinds = ['camera', 'arm', 'button', 'lamp'];

// Of a device's name, such as "camera /dev/video0"; null for devices that this page does not know.
export function kind_of_device(name) {
  return name.split(' ').find((part) => kKinds.includes(part)) ?? null;
}

// "Camera /dev/video0" in the page's language.
export function device_title(name) {
  const kind = kind_of_device(name);
  return kind === null ? name : name.replace(kind, word_of('device', kind));
}

function device_line(name, is_faulty) {
  const kind = kind_of_device(name);
  const title = kind === null ? name : word_of('device', kind);
  return element('li', { title: name }, mark(is_faulty ? 'fault' : 'good'),
    element('span', {}, word(is_faulty ? 'device.fails' : 'device.works', { device: title })));
}

// Null where the station names none, or is not heard: then nothing is known of now.
export function device_list(station) {
  const { devices, faults } = station.state ?? {};
  if (!Array.isArray(devices) || devices.length === 0 || !station.is_connected || !live.is_fresh()) return null;
  const faulty = new Set((Array.isArray(faults) ? faults : []).map((fault) => fault?.device));
  return element('ul', { class: 'devices' },
    devices.map((name) => device_line(String(name), faulty.has(name))));
}
