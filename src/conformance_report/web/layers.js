// SPDX-License-Identifier: GPL-3.0-or-later
// The pictures of an example as layers that the viewer shows. y grows upwards in all arguments, downwards in images.
'use strict';
const Layers = (() => {
  const names = ['got', 'expected', 'difference', 'owner', 'depth', 'depth-error', 'count'];

  const pixelsOf = (id, w, h) => {
    const sheet = document.createElement('canvas');
    sheet.width = w, sheet.height = h;
    const c = sheet.getContext('2d', {willReadFrequently: true});
    c.drawImage(document.getElementById(id), 0, 0);
    return c.getImageData(0, 0, w, h);
  };
  /// Black, blue, green, yellow, white: brightness grows all the way, in grey too.
  const ramp = [[0, 0, 40], [30, 60, 160], [20, 140, 140], [120, 190, 60], [250, 230, 90], [255, 255, 255]];
  const falseColour = (share) => {
    const at = Math.max(0, Math.min(1, share)) * (ramp.length - 1), i = Math.min(ramp.length - 2, Math.floor(at));
    return ramp[i].map((c, k) => Math.round(c + (ramp[i + 1][k] - c) * (at - i)));
  };

  /// data: as the page has it; k: the number of its <img> elements.
  const load = (data, k) => {
    const {w, h} = data, p = {...data, images: {}, sheets: {}, owner: [], count: new Uint16Array(w * h)};
    p.images.got = pixelsOf(`got-${k}`, w, h), p.images.expected = pixelsOf(`expected-${k}`, w, h);
    for (let i = 0; i < data.owners.length; i += 2) for (let n = 0; n < data.owners[i + 1]; ++n) p.owner.push(data.owners[i]);
    p.at = (x, y) => y * w + x;
    p.ownerAt = (x, y) => p.owner[p.at(x, y)] ?? -1;
    p.colour = (name, x, y) => { const i = 4 * ((h - 1 - y) * w + x); return [...p.images[name].data.slice(i, i + 3)]; };
    p.wrongAt = (x, y) => p.wrong.find((q) => q[0] === x && q[1] === y);
    p.planes = p.polygons.map(() => ({}));
    p.plane = (polygon, component) => p.planes[polygon][component] ??= {is: Exact.plane(p.polygons[polygon], component)};
    p.polygons.forEach((polygon) => Exact.fill(polygon, w, h, (x, y) => ++p.count[p.at(x, y)]));
    p.under = (x, y) => p.polygons.flatMap((polygon, n) => Exact.covers(polygon, x, y) ? [n] : []);
    // Exact depth of the owner; null where there is none, or its corners are on no plane.
    p.depth = (x, y) => {
      const owner = p.ownerAt(x, y), plane = owner >= 0 && p.polygons[owner] ? p.plane(owner, 2).is : null;
      return plane ? plane.approximately(x, y) : null;
    };
    p.measured = new Map(p.wrong.filter((q) => q[3] !== null).map((q) => [p.at(q[0], q[1]), q[3]]));
    let low = Infinity, high = -Infinity;
    for (let y = 0; y < h; ++y) for (let x = 0; x < w; ++x) {
      const z = p.depth(x, y);
      if (z !== null) low = Math.min(low, z), high = Math.max(high, z);
    }
    p.range = low <= high ? [Math.floor(low), Math.ceil(high)] : [0, 1];
    p.gain = 1;
    return p;
  };

  const paint = {
    difference: (p, x, y) => {
      const a = p.colour('got', x, y), b = p.colour('expected', x, y), d = a.map((v, i) => Math.abs(v - b[i]));
      // A difference of one must be seen, whatever the gain.
      return d.some((v) => v > 0) ? d.map((v) => 64 + Math.min(191, v * p.gain)) : [0, 0, 0];
    },
    owner: (p, x, y) => {
      const k = p.ownerAt(x, y);
      return k < 0 ? [0, 0, 0] : [40 + (k * 97 + 60) % 200, 40 + (k * 57 + 120) % 200, 40 + (k * 151) % 200];
    },
    depth: (p, x, y) => {
      const z = p.measured.get(p.at(x, y)) ?? p.depth(x, y);
      return z === null ? [60, 20, 30] : falseColour((z - p.range[0]) / Math.max(1, p.range[1] - p.range[0]));
    },
    // Too near is blue, too far is orange.
    'depth-error': (p, x, y) => {
      const z = p.measured.get(p.at(x, y)), v = p.depth(x, y);
      if (z === undefined || v === null) return v === null ? [0, 0, 0] : [40, 40, 40];
      const size = 90 + Math.min(165, Math.abs(z - v) * p.gain);
      return z < v ? [0, size / 2, size] : [size, size / 2, 0];
    },
    count: (p, x, y) => [[0, 0, 0], [70, 70, 80], [60, 110, 190], [220, 150, 40]][p.count[p.at(x, y)]] ?? [240, 80, 60],
  };

  /// The canvas of a layer, painted when it is first asked for; forget() after a change of gain or range.
  const sheet = (p, name) => {
    if (p.sheets[name]) return p.sheets[name];
    if (paint[name]) {
      const image = p.images[name] = new ImageData(p.w, p.h);
      for (let y = 0; y < p.h; ++y) for (let x = 0; x < p.w; ++x) {
        const i = 4 * ((p.h - 1 - y) * p.w + x);
        image.data.set(paint[name](p, x, y), i), image.data[i + 3] = 255;
      }
    }
    const canvas = p.sheets[name] = document.createElement('canvas');
    canvas.width = p.w, canvas.height = p.h;
    canvas.getContext('2d').putImageData(p.images[name], 0, 0);
    return canvas;
  };
  const forget = (p) => { for (const name of Object.keys(paint)) delete p.sheets[name]; };

  /// What stands in a pixel of the layer when it is large enough.
  const numbers = (p, name, x, y) => {
    if (name === 'owner') return [p.ownerAt(x, y) < 0 ? '' : p.ownerAt(x, y)];
    if (name === 'count') return [p.count[p.at(x, y)]];
    const z = p.measured.get(p.at(x, y)), v = p.depth(x, y);
    if (name === 'depth') return [z ?? (v === null ? '' : v.toFixed(1))];
    if (name === 'depth-error') return [z === undefined || v === null ? '' : (z - v).toFixed(1)];
    if (name === 'difference') { const b = p.colour('expected', x, y); return p.colour('got', x, y).map((c, i) => c - b[i]); }
    return p.colour(name, x, y);
  };
  return {names, load, sheet, forget, numbers};
})();
