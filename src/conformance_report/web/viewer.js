// SPDX-License-Identifier: GPL-3.0-or-later
// The viewer: one example at a time, pixel by pixel.
'use strict';
(() => {
  const {$, t, pictures: data} = Page;
  if (data.length === 0) return;

  const canvas = $('v-canvas'), context = canvas.getContext('2d');
  const layer = $('v-layer'), mode = $('v-mode'), swipe = $('v-swipe');
  const loaded = data.map(() => null);
  const picture = () => loaded[current] ??= Layers.load(data[current], current);
  // origin: picture coordinates (y down) at the canvas' upper left corner; polygon: the one that is outlined and explained.
  let current = 0, scale = 8, originX = 0, originY = 0, pixel = null, pinned = false, polygon = -1, wrongAt = -1, finding = -1;
  $('viewer').hidden = false;

  // ---- what is said about the pixel
  const kinds = {missing: t('missing'), extra: t('too many'), owner: t('wrong polygon'), depth: t('wrong depth'), colour: t('wrong colour'), differs: t('differs')};
  const corners = (p, n) => p.polygons[n].slice(0, 12).map((q) => `(${q[0]}, ${q[1]}, ${q[2]})`).join(' ') + (p.polygons[n].length > 12 ? ' ...' : '');
  const shownPolygon = (p) => polygon >= 0 ? polygon : pixel ? p.ownerAt(...pixel) : -1;
  const status = () => {
    const p = picture();
    if (!pixel) { $('v-status').textContent = `${p.case}: ${p.w} x ${p.h}. ${t('Point at a pixel.')}`; return; }
    const [x, y] = pixel, owner = p.ownerAt(x, y), wrong = p.wrongAt(x, y), got = p.colour('got', x, y);
    let text = `(${x}, ${y})  ${t('yours')} ${got.join(' ')}  ${t('expected')} ${p.colour('expected', x, y).join(' ')}`;
    if (wrong) text += `  ${kinds[wrong[2]] ?? wrong[2]}`;
    if (owner < 0) text += `  ${t('background')}`;
    else if (p.polygons[owner]) {
      text += `\n${t('polygon')} ${owner}: ${corners(p, owner)}`;
      const values = ['z', 'r', 'g', 'b'].flatMap((name, i) => {
        const {is} = p.plane(owner, i + 2), mine = i === 0 ? p.measured.get(p.at(x, y)) : got[i - 1];
        if (!is) return [];
        const n = is.n(x, y), error = mine === undefined || p.c !== 256 && i > 0 ? null : mine - is.approximately(x, y);
        return [`${name} = ${Exact.text(n, is.d)}` + (error === null ? '' : ` (${t('yours')} ${mine}, ${error < 0 ? '−' : '+'}${Math.abs(error).toFixed(2)})`)];
      });
      if (values.length) text += `\n${values.join('; ')}`;
    }
    $('v-status').textContent = text;
    history.replaceState(null, '', `#case=${encodeURIComponent(p.case)}&picture=${current}&x=${x}&y=${y}&zoom=${scale}`);
  };

  const element = (tag, text, parent) => { const e = document.createElement(tag); e.textContent = text; parent.append(e); return e; };
  /// For a pixel that is held: who covers it, and what decides that.
  const details = () => {
    const p = picture(), box = $('v-details');
    box.replaceChildren(), box.hidden = !pinned || !pixel;
    if (box.hidden) return;
    const [x, y] = pixel, under = p.under(x, y), owner = p.ownerAt(x, y), list = document.createElement('ul');
    element('h3', `${t('Pixel')} (${x}, ${y})`, box);
    element('p', under.length === 0 ? t('No polygon covers it.') : t('Polygons that cover it, in drawing order:'), box);
    const choices = under.length === 0 ? p.polygons.slice(0, 8).map((_, n) => n) : under.slice(0, 64);
    for (const n of choices) {
      const button = element('button', `${t('polygon')} ${n}`, element('li', '', list)), {is} = p.plane(n, 2);
      button.type = 'button', button.setAttribute('aria-pressed', n === shownPolygon(p));
      button.addEventListener('click', () => { polygon = polygon === n ? -1 : n; update(); });
      button.after(` ${is ? `z = ${Exact.text(is.n(x, y), is.d)}` : ''}${n === owner ? `, ${t('in front')}` : ''}`);
    }
    if (under.length > choices.length) element('li', '...', list);
    box.append(list);
    const n = shownPolygon(p) >= 0 ? shownPolygon(p) : choices[0];
    if (!p.polygons[n]) return;
    const decisions = Exact.decisions(p.polygons[n], x, y), odd = decisions.filter((d) => d.counts).length;
    element('p', `${t('polygon')} ${n}, ${t('row')} y = ${y}: ${t('an edge counts when')} (x − x1)·(y2 − y1) − (y − y1)·(x2 − x1) ≥ 0`, box);
    const edges = document.createElement('ul');
    for (const d of decisions) {
      element('li', `(${d.low[0]}, ${d.low[1]})–(${d.high[0]}, ${d.high[1]}): ${d.sum} ${d.counts ? `≥ 0, ${t('counts')}` : `< 0, ${t('does not count')}`} (x = ${d.crossing})`, edges);
    }
    if (decisions.length === 0) element('li', t('No edge crosses this row.'), edges);
    box.append(edges);
    element('p', `${odd} ${t('of')} ${decisions.length}: ${odd % 2 === 1 ? t('odd, so it is inside') : t('even, so it is outside')}`, box);
  };

  // ---- drawing
  const panes = () => mode.value === 'side' ? 2 : 1;
  const paneWidth = () => canvas.width / panes();
  const pane = (p, name, left, width, clipLeft, clipRight) => {
    context.save();
    context.beginPath();
    context.rect(clipLeft, 0, clipRight - clipLeft, canvas.height);
    context.clip();
    context.imageSmoothingEnabled = false;
    context.drawImage(Layers.sheet(p, name), left - originX * scale, -originY * scale, p.w * scale, p.h * scale);
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
      const image = p.images[name].data;
      for (let y = y0; y < y1; ++y) for (let x = x0; x < x1; ++x) {
        const i = 4 * (y * p.w + x), lines = Layers.numbers(p, name, x, p.h - 1 - y);
        context.fillStyle = image[i] * .3 + image[i + 1] * .59 + image[i + 2] * .11 > 128 ? '#000' : '#fff';
        lines.forEach((v, k) => context.fillText(v, sx(x + .5), sy(y) + scale * (k + (4 - lines.length) / 2 + .5) / 3.6));
      }
    } else if (scale >= 12) {
      // Where the samples are.
      context.fillStyle = 'rgba(128,128,128,.9)';
      for (let y = y0; y < y1; ++y) for (let x = x0; x < x1; ++x) context.fillRect(sx(x + .5) - 1, sy(y + .5) - 1, 2, 2);
    }
    const outline = (corners, thick) => {
      context.beginPath();
      corners.forEach((q) => context.lineTo(sx(q[0] + .5), sy(p.h - 1 - q[1] + .5)));
      context.closePath();
      context.lineWidth = thick + 2, context.strokeStyle = '#000', context.stroke();
      context.lineWidth = thick, context.strokeStyle = '#fff', context.stroke();
      context.lineWidth = 1;
    };
    if (p.polygons.length <= 200) p.polygons.forEach((q) => outline(q, 1));
    const n = shownPolygon(p);
    if (n >= 0 && p.polygons[n]) outline(p.polygons[n], 3);
    if (pixel) {
      context.strokeStyle = '#f0f', context.lineWidth = pinned ? 4 : 2;
      context.strokeRect(sx(pixel[0]), sy(p.h - 1 - pixel[1]), scale, scale);
    }
    context.restore();
  };
  const draw = () => {
    const ratio = window.devicePixelRatio || 1, box = canvas.getBoundingClientRect();
    canvas.width = Math.max(1, Math.round(box.width * ratio)), canvas.height = Math.max(1, Math.round(box.height * ratio));
    const p = picture(), w = paneWidth();
    swipe.hidden = mode.value !== 'swipe';
    $('v-gain-box').hidden = !['difference', 'depth-error'].includes(layer.value);
    $('v-range-box').hidden = layer.value !== 'depth';
    if (mode.value === 'side') pane(p, layer.value, 0, w, 0, w - 2), pane(p, 'expected', w, w, w, 2 * w);
    else if (mode.value === 'swipe') {
      const cut = w * swipe.value / 100;
      pane(p, 'got', 0, w, 0, cut), pane(p, 'expected', 0, w, cut + 2, w);
    } else pane(p, layer.value, 0, w, 0, w);
    canvas.dataset.zoom = scale;
  };
  const update = () => { draw(); status(); details(); };

  // ---- moving about
  const limited = (s) => Math.max(1 / 8, Math.min(64, s));
  const fit = () => {
    const p = picture();
    draw();
    scale = limited(Math.min(paneWidth() / p.w, canvas.height / p.h));
    originX = (p.w - paneWidth() / scale) / 2, originY = (p.h - canvas.height / scale) / 2;
    update();
  };
  const zoom = (factor, cx = paneWidth() / 2, cy = canvas.height / 2) => {
    const next = limited(scale * factor);
    originX += cx / scale - cx / next, originY += cy / scale - cy / next, scale = next;
    update();
  };
  const look = (x, y) => {
    const p = picture();
    pixel = [Math.max(0, Math.min(p.w - 1, x)), Math.max(0, Math.min(p.h - 1, y))], pinned = true;
    const sx = (pixel[0] - originX) * scale, sy = (p.h - 1 - pixel[1] - originY) * scale;
    if (sx < 0 || sx + scale > paneWidth() || sy < 0 || sy + scale > canvas.height) {
      originX = pixel[0] + .5 - paneWidth() / scale / 2, originY = p.h - pixel[1] - .5 - canvas.height / scale / 2;
    }
    update();
  };
  const release = () => { pinned = false, polygon = -1; update(); };
  const step = (by) => {
    const {wrong} = picture();
    if (wrong.length === 0) return;
    wrongAt = wrongAt < 0 ? (by > 0 ? 0 : wrong.length - 1) : (wrongAt + by + wrong.length) % wrong.length;
    polygon = -1, look(wrong[wrongAt][0], wrong[wrongAt][1]);
  };
  const choose = (k) => {
    current = k, $('v-picture').value = k, pixel = null, pinned = false, polygon = -1, wrongAt = -1;
    const p = picture(), [low, high] = p.range;
    $('v-low').value = low, $('v-high').value = high, $('v-gain').value = Math.log2(p.gain);
    fit();
    // Small causes in a large frame: begin close to them.
    const w = p.wrong[0];
    if (!w || scale >= 24) return;
    scale = 24, originX = Math.max(0, w[0] + 1 - paneWidth() / 48), originY = Math.min(p.h - canvas.height / 24, p.h - w[1] - canvas.height / 48);
    update();
  };
  const articles = [...document.querySelectorAll('.finding')];
  const goTo = (by) => {
    if (articles.length === 0) return;
    finding = Math.max(0, Math.min(articles.length - 1, finding + by));
    articles[finding].scrollIntoView();
    const open = articles[finding].querySelector('button.open');
    if (open) choose(Number(open.dataset.picture));
  };

  // ---- controls
  data.forEach((d, k) => $('v-picture').add(new Option(`${k + 1}: ${d.case}`, k)));
  $('v-picture').addEventListener('change', (e) => choose(Number(e.target.value)));
  layer.addEventListener('change', update);
  mode.addEventListener('change', fit);
  swipe.addEventListener('input', draw);
  $('v-gain').addEventListener('input', (e) => { picture().gain = 2 ** e.target.value; Layers.forget(picture()); draw(); });
  for (const id of ['v-low', 'v-high']) $(id).addEventListener('input', () => {
    picture().range = [Number($('v-low').value), Number($('v-high').value)];
    Layers.forget(picture()), draw();
  });
  $('v-in').addEventListener('click', () => zoom(2));
  $('v-out').addEventListener('click', () => zoom(1 / 2));
  $('v-fit').addEventListener('click', fit);
  $('v-next').addEventListener('click', () => step(1));
  $('v-previous').addEventListener('click', () => step(-1));
  const help = () => { const open = $('v-keys').hidden; $('v-keys').hidden = !open, $('v-help').setAttribute('aria-expanded', open); };
  $('v-help').addEventListener('click', help);
  for (const button of document.querySelectorAll('button.open')) {
    button.hidden = false;
    button.addEventListener('click', () => { $('viewer').scrollIntoView(); choose(Number(button.dataset.picture)); canvas.focus({preventScroll: true}); });
  }

  // ---- pointers: drag moves, two fingers zoom, a click holds the pixel or lets it go
  const place = (e) => {
    const box = canvas.getBoundingClientRect(), ratio = canvas.width / box.width;
    return [((e.clientX - box.left) * ratio) % paneWidth(), (e.clientY - box.top) * ratio];
  };
  const under = (e) => {
    const p = picture(), [cx, cy] = place(e), x = Math.floor(originX + cx / scale), y = p.h - 1 - Math.floor(originY + cy / scale);
    return x >= 0 && y >= 0 && x < p.w && y < p.h ? [x, y] : null;
  };
  const fingers = new Map();
  let moved = false;
  const spread = () => { const [a, b] = [...fingers.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
  canvas.addEventListener('wheel', (e) => { e.preventDefault(); zoom(e.deltaY < 0 ? 1.25 : 1 / 1.25, ...place(e)); }, {passive: false});
  canvas.addEventListener('pointerdown', (e) => { if (fingers.size === 0) moved = false; fingers.set(e.pointerId, place(e)); canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener('pointermove', (e) => {
    const before = fingers.get(e.pointerId), here = place(e);
    if (!before) {
      if (pinned) return;
      pixel = under(e);
      update();
      return;
    }
    const travel = Math.hypot(here[0] - before[0], here[1] - before[1]);
    if (fingers.size === 2) {
      const old = spread();
      fingers.set(e.pointerId, here), moved = true;
      if (old > 0) zoom(spread() / old, ...here);
    } else if (moved || travel > 4) {
      fingers.set(e.pointerId, here), moved = true;
      originX -= (here[0] - before[0]) / scale, originY -= (here[1] - before[1]) / scale;
      draw();
    }
  });
  canvas.addEventListener('pointerup', (e) => {
    const was = fingers.delete(e.pointerId);
    if (!was || moved || fingers.size > 0) return;
    const at = under(e);
    if (!at || pinned && at[0] === pixel[0] && at[1] === pixel[1]) return release();
    pixel = at, pinned = true, polygon = -1;
    update();
  });
  canvas.addEventListener('pointercancel', (e) => { fingers.delete(e.pointerId); });

  document.addEventListener('keydown', (e) => {
    if (e.ctrlKey || e.altKey || e.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName)) return;
    if (e.key === ' ' && e.target.tagName !== 'CANVAS') return;
    const p = picture(), [x, y] = pixel ?? [p.w >> 1, p.h >> 1];
    const keys = {
      ' ': () => { layer.value = layer.value === 'got' ? 'expected' : 'got'; update(); }, '+': () => zoom(2), '-': () => zoom(1 / 2), f: fit,
      n: () => step(1), p: () => step(-1), j: () => goTo(1), k: () => goTo(-1), Escape: release, '?': help,
    };
    Layers.names.forEach((name, i) => { keys[i + 1] = () => { layer.value = name; update(); }; });
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
    if (Number(link.get('zoom')) > 0) scale = limited(Number(link.get('zoom')));
    if (link.has('x') && link.has('y')) look(Number(link.get('x')) | 0, Number(link.get('y')) | 0);
    $('viewer').dataset.ready = 'yes';
  };
  start();
})();
