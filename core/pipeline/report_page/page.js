
'use strict';
// The page is whole without this: here are the switches that show one picture instead of all.
(() => {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  document.documentElement.classList.add('js');

  // The map: one figure at a time, the horizon edges over it.
  const map = document.getElementById('map');
  const edges = map.querySelector('.edges');
  const slider = document.querySelector('[data-compares]');
  const split = () => {
    const level = map.querySelector('.shown').dataset.shows !== 'dem';
    slider.parentElement.hidden = !level;
    map.classList.toggle('comparing', level && slider.value > 0);
    map.style.setProperty('--split', slider.value + '%');
  };
  const showOnMap = (value) => {
    for (const figure of all('figure', map)) {
      const shown = figure.dataset.shows === value;
      figure.classList.toggle('shown', shown);
      if (shown) figure.querySelector('.frame').append(edges);
    }
    split();
  };
  slider.addEventListener('input', split);
  for (const box of all('input[data-sector]')) {
    box.addEventListener('change', () => {
      for (const layer of all(`img[data-sector="${box.dataset.sector}"]`)) layer.hidden = !box.checked;
    });
  }
  document.querySelector('[data-enlarges]').addEventListener('change', (event) => {
    map.parentElement.classList.toggle('enlarged', event.target.checked);
  });

  // The skylines: all levels on one scale, or one on its own.
  const skylines = document.getElementById('skylines');
  const showSkyline = (value) => {
    skylines.dataset.level = value;
    for (const mark of all('path[data-level]', skylines)) {
      mark.classList.toggle('off', value !== 'all' && mark.dataset.level !== value);
      if (mark.dataset.common === undefined) continue;
      if (value === 'all') mark.setAttribute('transform', mark.dataset.common);
      else mark.removeAttribute('transform');
    }
    for (const text of all('.factor', skylines)) {
      text.classList.toggle('shown', text.dataset.level === value);
    }
  };

  const shows = { map: showOnMap, skylines: showSkyline };
  for (const choice of all('.choice')) {
    const show = shows[choice.dataset.for];
    choice.addEventListener('change', (event) => show(event.target.value));
    show(choice.querySelector('input:checked').value);
  }
})();
