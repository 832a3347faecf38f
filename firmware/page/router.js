// Which view the address asks for: "#scan/kitchen-12", "#history?food=rice".

// {view, path, query}; `?kiosk` before the "#" is a kiosk whatever follows.
export function read_address(place = location) {
  const [route, query = ''] = place.hash.replace(/^#/, '').split('?');
  const [view, ...path] = route.split('/').map(decode);
  const parameters = new URLSearchParams(query);
  if (new URLSearchParams(place.search).has('kiosk') && view !== 'kiosk') {
    return { view: 'kiosk', path: [], query: parameters };
  }
  return { view: view || 'live', path, query: parameters };
}

function decode(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}
