// SPDX-License-Identifier: GPL-3.0-or-later
// Filter box, replay of a row, contact sheet. Everything of the page is there without this, too.
'use strict';
const Page = (() => {
  const $ = (id) => document.getElementById(id);
  const {words, pictures} = JSON.parse($('data').textContent);
  /// A word or sentence in the language of the page.
  const t = (english) => words[english] ?? english;

  const filter = $('filter'), rows = [...$('cases').tBodies[0].rows];
  const applyFilter = () => {
    const wanted = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const row of rows) {
      const text = row.textContent.toLowerCase();
      row.hidden = !wanted.every((w) => text.includes(w));
      if (!row.hidden) ++shown;
    }
    $('filter-count').textContent = `${shown} ${t('of')} ${rows.length}`;
  };
  filter.addEventListener('input', applyFilter);
  applyFilter();

  // A slider under each row table replays the row from left to right, in the table and in the drawing.
  for (const table of document.querySelectorAll('table.steps')) {
    const article = table.closest('.finding'), band = article.querySelector('.lattice .row');
    const steps = [...table.tBodies[0].rows], slider = document.createElement('input');
    slider.type = 'range', slider.className = 'stepper', slider.min = 0, slider.max = steps.length - 1, slider.value = 0;
    slider.setAttribute('aria-label', `${t('step along the row')}, ${article.id}`);
    const here = band && document.createElementNS('http://www.w3.org/2000/svg', 'circle');
    if (here) here.setAttribute('class', 'step'), here.setAttribute('r', 0), band.after(here);
    slider.addEventListener('input', () => {
      steps.forEach((row, i) => row.classList.toggle('now', i === Number(slider.value)));
      const cells = steps[slider.value].cells;
      slider.setAttribute('aria-valuetext', `x = ${cells[0].textContent}: ${cells[1].textContent}, ${cells[2].textContent}`);
      if (!here) return;
      here.setAttribute('r', .2);
      here.setAttribute('cx', cells[0].textContent);
      here.setAttribute('cy', Number(band.getAttribute('y')) + .5);
    });
    table.parentElement.after(slider);
  }

  // All pictures at a glance: no bytes of their own, they are on the page already.
  const sheet = $('contact');
  const shown = [...document.querySelectorAll('.finding')].filter((f) => f.querySelector('img'));
  for (const finding of shown.length > 1 ? shown : []) {
    const link = document.createElement('a'), image = document.createElement('img'), name = document.createElement('span');
    link.href = `#${finding.id}`, image.src = finding.querySelector('img.yours').src, image.alt = '';
    name.textContent = finding.querySelector('h3').textContent.trim();
    link.append(image, name), sheet.append(link), sheet.hidden = false;
  }
  return {$, t, pictures};
})();
