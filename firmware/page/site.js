// What the hub says of the site that it stands at; an older hub says nothing.
import { get_if_there } from './hub_api.js';
import { set_site_zone } from './times.js';

export const site = { name: null, program: null };

export async function read_site() {
  const told = await get_if_there('site').catch(() => null);
  site.name = told?.name ?? null;
  site.program = told?.program ?? null;
  if (told?.time_zone) set_site_zone(told.time_zone);
}
