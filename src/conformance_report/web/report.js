// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer and the filter box. Everything else of the page works without this.
'use strict';
(() => {
  const $ = (id) => document.getElementById(id);
  const data = JSON.parse($('data').textContent);

  const filter = $('filter'), rows = [...$('cases').tBodies[0].rows];
  const applyFilter = () => {
    const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !words.every((w) => text.includes(w));
      if (!row.hidden) ++shown;
    }
    $('filter-count').textContent = `${shown} of ${rows.length}`;
  };
  filter.addEventListener('input', applyFilter);
  applyFilter();

  // A slider under each row table replays the row from left to right, in the table and in the drawing.
  for (const table of document.querySelectorAll('table.steps')) {
    const article = table.closest('.finding'), band = article.querySelector('.lattice .row');
    const steps = [...table.tBodies[0].rows], slider = document.createElement('input');
    slider.type = 'range', slider.className = 'stepper', slider.min = 0, slider.max = steps.length - 1, slider.value = 0;
    slider.setAttribute('aria-label', `step along the row, ${article.id}`);
    const here = band && document.createElementNS('http://www.w3.org/2000/svg', 'circle');
    if (here) here.setAttribute('class', 'step'), here.setAttribute('r', .2), band.after(here);
    slider.addEventListener('input', () => {
      steps.forEach((row, i) => row.classList.toggle('now', i === Number(slider.value)));
      const cells = steps[slider.value].cells;
      slider.setAttribute('aria-valuetext', `x ${cells[0].textContent}: ${cells[1].textContent} crossings, ${cells[2].textContent}`);
      if (!here) return;
      here.setAttribute('cx', cells[0].textContent);
      here.setAttribute('cy', Number(band.getAttribute('y')) + .5);
    });
    table.parentElement.after(slider);
  }
  if (data.length === 0) return;

  const canvas = $('v-canvas'), context = canvas.getContext('2d');
  const layer = $('v-layer'), mode = $('v-mode'), swipe = $('v-swipe');
  const pictures = data.map(() => null);
  let current = 0, scale = 8, originX = 0, originY = 0, pixel = null, wrongAt = -1, finding = -1;
  $('viewer').hidden = false;

  // ---- pictures
  const pixelsOf = (id, w, h) => {
    const sheet = document.createElement('canvas');
    sheet.width = w, sheet.height = h;
    const c = sheet.getContext('2d', {willReadFrequently: true});
    c.drawImage($(id), 0, 0);
    return c.getImageData(0, 0, w, h);
  };
  const load = (k) => {
    if (pictures[k]) return pictures[k];
    const d = data[k], p = {...d, layers: {}, sheets: {}};
    p.layers.got = pixelsOf(`got-${k}`, d.w, d.h);
    p.layers.expected = pixelsOf(`expected-${k}`, d.w, d.h);
    p.owner = [];
    for (let i = 0; i < d.owners.length; i += 2) for (let n = 0; n < d.owners[i + 1]; ++n) p.owner.push(d.owners[i]);
    const difference = new ImageData(d.w, d.h), owner = new ImageData(d.w, d.h);
    for (let i = 0; i < d.w * d.h; ++i) {
      let differs = false;
      for (let c = 0; c < 3; ++c) differs ||= p.layers.got.data[4 * i + c] !== p.layers.expected.data[4 * i + c];
      for (let c = 0; c < 3; ++c) {
        const error = Math.abs(p.layers.got.data[4 * i + c] - p.layers.expected.data[4 * i + c]);
        difference.data[4 * i + c] = differs ? 64 + Math.min(191, error) : 0;
      }
      difference.data[4 * i + 3] = owner.data[4 * i + 3] = 255;
      const k2 = p.owner[(d.h - 1 - Math.floor(i / d.w)) * d.w + i % d.w] ?? -1;
      if (k2 >= 0) owner.data.set([40 + (k2 * 97 + 60) % 200, 40 + (k2 * 57 + 120) % 200, 40 + (k2 * 151) % 200], 4 * i);
    }
    p.layers.difference = difference, p.layers.owner = owner;
    for (const [name, image] of Object.entries(p.layers)) {
      const sheet = document.createElement('canvas');
      sheet.width = d.w, sheet.height = d.h;
      sheet.getContext('2d').putImageData(image, 0, 0);
      p.sheets[name] = sheet;
    }
    return pictures[k] = p;
  };
  const colour = (p, name, x, y) => [...p.layers[name].data.slice(4 * ((p.h - 1 - y) * p.w + x), 4 * ((p.h - 1 - y) * p.w + x) + 3)];

  // ---- exact values: the plane through a polygon's corners, as a fraction; null where they are not on one plane
  const gcd = (a, b) => { while (b) [a, b] = [b, a % b]; return a < 0n ? -a : a; };
  const exact = (polygon, component, x, y) => {
    const v = polygon.map((q) => [q[0], q[1], q[component]].map(BigInt));
    for (let i = 1; i + 1 < v.length; ++i) {
      const [a, b, c] = [v[0], v[i], v[i + 1]];
      const det = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
      if (det === 0n) continue;
      const at = (px, py) => a[2] * det + (px - a[0]) * ((b[2] - a[2]) * (c[1] - a[1]) - (c[2] - a[2]) * (b[1] - a[1])) +
        (py - a[1]) * ((c[2] - a[2]) * (b[0] - a[0]) - (b[2] - a[2]) * (c[0] - a[0]));
      if (v.some((q) => at(q[0], q[1]) !== q[2] * det)) return null;
      let n = at(BigInt(x), BigInt(y)), d = det;
      if (d < 0n) n = -n, d = -d;
      const g = gcd(n, d) || 1n;
      return d / g === 1n ? `${n / g}` : `${n / g}/${d / g} = ${(Number(n) / Number(d)).toFixed(2)}`;
    }
    return null;
  };
  const status = () => {
    const p = load(current);
    if (!pixel) { $('v-status').textContent = `${p.case}: ${p.w} x ${p.h} pixels. Point at a pixel.`; return; }
    const [x, y] = pixel, owner = p.owner[y * p.w + x] ?? -1, wrong = p.wrong.find((q) => q[0] === x && q[1] === y);
    let text = `(${x}, ${y})  yours ${colour(p, 'got', x, y).join(' ')}  expected ${colour(p, 'expected', x, y).join(' ')}`;
    if (wrong) text += `  ${wrong[2]}`;
    if (owner < 0) text += '  background';
    else if (p.polygons[owner]) {
      const values = ['z', 'r', 'g', 'b'].map((n, i) => [n, exact(p.polygons[owner], i + 2, x, y)]).filter((q) => q[1] !== null);
      text += `\npolygon ${owner}: ${p.polygons[owner].slice(0, 12).map((q) => `(${q[0]}, ${q[1]}, ${q[2]})`).join(' ')}`;
      if (values.length) text += `\n${values.map((q) => `${q[0]} = ${q[1]}`).join('; ')}`;
    }
    $('v-status').textContent = text;
    history.replaceState(null, '', `#case=${encodeURIComponent(p.case)}&picture=${current}&x=${x}&y=${y}&zoom=${scale}`);
  };

  // ---- drawing; origin = picture coordinates (y down) at the canvas' upper left corner
  const panes = () => mode.value === 'side' ? 2 : 1;
  const paneWidth = () => canvas.width / panes();
  const pane = (p, name, left, width, clipLeft, clipRight) => {
    context.save();
    context.beginPath();
    context.rect(clipLeft, 0, clipRight - clipLeft, canvas.height);
    context.clip();
    context.imageSmoothingEnabled = false;
    context.drawImage(p.sheets[name], left - originX * scale, -originY * scale, p.w * scale, p.h * scale);
    const x0 = Math.max(0, Math.floor(originX)), x1 = Math.min(p.w, Math.ceil(originX + width / scale));
    const y0 = Math.max(0, Math.floor(originY)), y1 = Math.min(p.h, Math.ceil(originY + canvas.height / scale));
    const sx = (x) => left + (x - originX) * scale, sy = (y) => (y - originY) * scale;
    if (scale >= 8) {
      context.strokeStyle = 'rgba(128,128,128,.6)';
      context.beginPath();
      for (let x = x0; x <= x1; ++x) context.moveTo(sx(x), sy(y0)), context.lineTo(sx(x), sy(y1));
      for (let y = y0; y <= y1; ++y) context.moveTo(sx(x0), sy(y)), context.lineTo(sx(x1), sy(y));
      context.stroke();
    }
    if (scale >= 40) {
      context.font = `${scale / 4.5}px monospace`;
      context.textAlign = 'center';
      for (let y = y0; y < y1; ++y) for (let x = x0; x < x1; ++x) {
        const c = colour(p, name, x, p.h - 1 - y);
        context.fillStyle = c[0] * .3 + c[1] * .59 + c[2] * .11 > 128 ? '#000' : '#fff';
        c.forEach((v, i) => context.fillText(v, sx(x + .5), sy(y) + scale * (i + 1) / 3.6));
      }
    }
    const outline = (polygon, thick) => {
      context.beginPath();
      polygon.forEach((q) => context.lineTo(sx(q[0] + .5), sy(p.h - 1 - q[1] + .5)));
      context.closePath();
      context.lineWidth = thick + 2, context.strokeStyle = '#000', context.stroke();
      context.lineWidth = thick, context.strokeStyle = '#fff', context.stroke();
      context.lineWidth = 1;
    };
    if (p.polygons.length <= 200) p.polygons.forEach((q) => outline(q, 1));
    if (pixel) {
      const owner = p.owner[pixel[1] * p.w + pixel[0]] ?? -1;
      if (owner >= 0 && p.polygons[owner]) outline(p.polygons[owner], 3);
      context.strokeStyle = '#f0f', context.lineWidth = 3;
      context.strokeRect(sx(pixel[0]), sy(p.h - 1 - pixel[1]), scale, scale);
    }
    context.restore();
  };
  const draw = () => {
    const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    canvas.width = Math.max(1, Math.round(box.width * ratio)), canvas.height = Math.max(1, Math.round(box.height * ratio));
    const p = load(current), w = paneWidth();
    swipe.hidden = mode.value !== 'swipe';
    if (mode.value === 'side') pane(p, layer.value, 0, w, 0, w - 2), pane(p, 'expected', w, w, w, 2 * w);
    else if (mode.value === 'swipe') {
      const cut = w * swipe.value / 100;
      pane(p, 'got', 0, w, 0, cut), pane(p, 'expected', 0, w, cut + 2, w);
    } else pane(p, layer.value, 0, w, 0, w);
    canvas.dataset.zoom = scale;
  };
  const update = () => { draw(); status(); };
  const fit = () => {
    const p = load(current);
    draw();
    scale = Math.max(1 / 8, Math.min(64, paneWidth() / p.w, canvas.height / p.h));
    originX = (p.w - paneWidth() / scale) / 2, originY = (p.h - canvas.height / scale) / 2;
    update();
  };
  const zoom = (factor, cx = paneWidth() / 2, cy = canvas.height / 2) => {
    const next = Math.max(1 / 8, Math.min(64, scale * factor));
    originX += cx / scale - cx / next, originY += cy / scale - cy / next, scale = next;
    update();
  };
  const look = (x, y) => {
    const p = load(current);
    pixel = [Math.max(0, Math.min(p.w - 1, x)), Math.max(0, Math.min(p.h - 1, y))];
    const sx = (pixel[0] - originX) * scale, sy = (p.h - 1 - pixel[1] - originY) * scale;
    if (sx < 0 || sx + scale > paneWidth() || sy < 0 || sy + scale > canvas.height) {
      originX = pixel[0] + .5 - paneWidth() / scale / 2, originY = p.h - pixel[1] - .5 - canvas.height / scale / 2;
    }
    update();
  };
  const step = (by) => {
    const p = load(current);
    if (p.wrong.length === 0) return;
    wrongAt = wrongAt < 0 ? (by > 0 ? 0 : p.wrong.length - 1) : (wrongAt + by + p.wrong.length) % p.wrong.length;
    look(p.wrong[wrongAt][0], p.wrong[wrongAt][1]);
  };
  const choose = (k) => { current = k, $('v-picture').value = k, pixel = null, wrongAt = -1;
    fit();
    // Small causes in a large frame: begin close to them.
    const w = load(k).wrong[0];
    if (!w || scale >= 24) return;
    scale = 24, originX = Math.max(0, w[0] + 1 - paneWidth() / 48), originY = Math.min(load(k).h - canvas.height / 24, load(k).h - w[1] - canvas.height / 48);
    update();
  };

  // ---- controls
  data.forEach((d, k) => $('v-picture').add(new Option(`${k + 1}: ${d.case}`, k)));
  $('v-picture').addEventListener('change', (e) => choose(Number(e.target.value)));
  for (const e of [layer, mode]) e.addEventListener('change', fit);
  swipe.addEventListener('input', draw);
  $('v-in').addEventListener('click', () => zoom(2));
  $('v-out').addEventListener('click', () => zoom(1 / 2));
  $('v-fit').addEventListener('click', fit);
  $('v-next').addEventListener('click', () => step(1));
  const help = () => { const open = $('v-keys').hidden; $('v-keys').hidden = !open, $('v-help').setAttribute('aria-expanded', open); };
  $('v-help').addEventListener('click', help);
  for (const button of document.querySelectorAll('button.open')) {
    button.hidden = false;
    button.addEventListener('click', () => { $('viewer').scrollIntoView(); choose(Number(button.dataset.picture)); canvas.focus({preventScroll: true}); });
  }
  const place = (e) => {
    const box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width;
    return [((e.clientX - box.left) * ratio) % paneWidth(), (e.clientY - box.top) * ratio];
  };
  const under = (e) => {
    const p = load(current), [cx, cy] = place(e), x = Math.floor(originX + cx / scale), y = p.h - 1 - Math.floor(originY + cy / scale);
    return x >= 0 && y >= 0 && x < p.w && y < p.h ? [x, y] : null;
  };
  let drag = null;
  canvas.addEventListener('wheel', (e) => { e.preventDefault(); zoom(e.deltaY < 0 ? 1.25 : 1 / 1.25, ...place(e)); }, {passive: false});
  canvas.addEventListener('pointerdown', (e) => { drag = [e.clientX, e.clientY, originX, originY]; canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener('pointermove', (e) => {
    if (drag) {
      const ratio = canvas.width / canvas.getBoundingClientRect().width;
      originX = drag[2] - (e.clientX - drag[0]) * ratio / scale, originY = drag[3] - (e.clientY - drag[1]) * ratio / scale;
      draw();
      return;
    }
    pixel = under(e);
    update();
  });
  canvas.addEventListener('pointerup', (e) => { drag = null; pixel = under(e); update(); });
  canvas.addEventListener('pointercancel', () => { drag = null; });
  const articles = [...document.querySelectorAll('.finding')];
  const goTo = (by) => {
    if (articles.length === 0) return;
    finding = Math.max(0, Math.min(articles.length - 1, finding + by));
    articles[finding].scrollIntoView();
    const open = articles[finding].querySelector('button.open');
    if (open) choose(Number(open.dataset.picture));
  };
  document.addEventListener('keydown', (e) => {
    if (e.ctrlKey || e.altKey || e.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName)) return;
    if (e.key === ' ' && e.target.tagName !== 'CANVAS') return;
    const p = load(current), [x, y] = pixel ?? [p.w >> 1, p.h >> 1], layers = ['got', 'expected', 'difference', 'owner'];
    const keys = {
      ' ': () => { layer.value = layer.value === 'got' ? 'expected' : 'got'; update(); }, '+': () => zoom(2), '-': () => zoom(1 / 2), f: fit,
      n: () => step(1), p: () => step(-1), j: () => goTo(1), k: () => goTo(-1), '?': help,
    };
    layers.forEach((name, i) => { keys[i + 1] = () => { layer.value = name; update(); }; });
    if (e.target === canvas) Object.assign(keys, {ArrowLeft: () => look(x - 1, y), ArrowRight: () => look(x + 1, y), ArrowUp: () => look(x, y + 1), ArrowDown: () => look(x, y - 1)});
    if (!Object.hasOwn(keys, e.key)) return;
    e.preventDefault();
    keys[e.key]();
  });
  window.addEventListener('resize', draw);

  const start = async () => {
    await Promise.all(data.flatMap((_, k) => [$(`got-${k}`).decode(), $(`expected-${k}`).decode()]));
    const link = new URLSearchParams(location.hash.slice(1));
    const wanted = link.has('picture') ? Number(link.get('picture')) : data.findIndex((d) => d.case === link.get('case'));
    choose(data[wanted] ? wanted : 0);
    if (Number(link.get('zoom')) > 0) scale = Math.min(64, Number(link.get('zoom')));
    if (link.has('x') && link.has('y')) look(Number(link.get('x')) | 0, Number(link.get('y')) | 0);
    $('viewer').dataset.ready = 'yes';
  };
  start();
})();
