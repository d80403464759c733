'use strict';
// The controls of the viewer.
(async () => {
  const { byId, make, digits, getJson, getManifest, fillHead } = farhorizon.numbers;
  const { results, cesium } = document.body.dataset;
  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const notice = (text, corner = true) => {
    byId('notice').hidden = !text;
    byId('notice').textContent = text ?? '';
    byId('notice').classList.toggle('corner', corner);
  };
  byId('fold').addEventListener('click', () => {
    const folded = byId('panel').classList.toggle('folded');
    byId('fold').textContent = folded ? 'Show' : 'Hide';
    byId('fold').setAttribute('aria-expanded', String(!folded));
  });
  await fillHead().catch(
    (failure) => notice(`The report cannot be read: ${failure.message}`, false));

  if (!cesium) {
    byId('notice').classList.remove('corner');
    byId('notice').replaceChildren('To see the terrain, CesiumJS has to be installed beside the ' +
      'service: run ', make('code', {}, 'service/pages/install-cesium'), ' in its source folder, ' +
      'which needs npm, or name a folder that has it as ', make('code', {}, 'viewer.cesium'),
      ' of the configuration; then start the service again.');
    return;
  }

  // ---- The scene.
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const colours = () => ({
    sky: dark.matches ? '#22303a' : '#c4dcea',
    ground: dark.matches ? '#14191c' : '#e3e7e1',
    level: colour('--level'), reference: colour('--reference'), quiet: colour('--quiet'),
  });
  let scene;
  try {
    scene = await farhorizon.Scene.open(
      byId('scene'), byId('credits'), { results, cesium, ...colours() });
  } catch (failure) {
    notice(`The terrain cannot be shown: ${failure.message ?? failure}`, false);
    return;
  }
  farhorizon.scene = scene; // for tests and the console
  dark.addEventListener('change', () => {
    scene.setColours(colours().sky, colours().ground);
    compare();
  });
  notice(null);

  const level = () => scene.shown;
  const finest = [...scene.levels.keys()][0];
  const names = new Set((await getManifest()).map(({ name }) => name));

  // ---- Horizon edges.
  const { colourOf, gltfOf, readGlb, readGeojson, makePrimitive } = farhorizon.horizonLines;
  const kPlain = [214, 40, 57];
  let geojson = null;
  const linesOf = async (which) => {
    const number = which === 'stream' ? finest : which;
    const glb = `lod${number}-horizon.glb`;
    if (names.has(glb)) {
      const response = await farhorizon.key.get(results + glb);
      return readGlb(scene.C, await response.arrayBuffer(), scene.frame);
    }
    geojson ??= getJson('horizon.geojson');
    const document = await geojson;
    if (!document) throw new Error('the job has made no horizon.geojson');
    return readGeojson(scene.C, document, number);
  };
  const mode = () => document.querySelector('[name="horizon"]:checked').value;
  const showHorizon = async () => {
    const [wanted, which] = [mode(), level()];
    byId('wheel').hidden = wanted !== 'azimuth';
    await scene.setInlineEdges(wanted === 'inline');
    if (wanted === 'off' || wanted === 'inline') return scene.setLines(null);
    notice('Reading the horizon edges…');
    const lines = await linesOf(which);
    notice(null);
    if (wanted !== mode() || which !== level()) return;
    scene.setLines(lines.azimuths.length === 0 ? null
      : makePrimitive(scene.C, lines, wanted === 'azimuth' ? colourOf : () => kPlain));
  };
  {
    const context = byId('wheel').querySelector('canvas').getContext('2d');
    for (let x = 0; x < 360; ++x) {
      context.fillStyle = `rgb(${colourOf(x / 2)})`;
      context.fillRect(x, 0, 1, 24);
    }
  }

  // ---- The skyline of the level that is shown against that of level 0.
  const compare = async () => {
    const on = byId('compare').checked;
    byId('comparison').hidden = !on;
    const over = byId('skylines');
    over.getContext('2d').clearRect(0, 0, over.width, over.height);
    if (!on) return;
    const shown = level() === 'stream' || level() === finest ? null : level();
    if (shown === null) {
      byId('difference').textContent = 'Choose another level to see how its skyline differs.';
      byId('profile').hidden = true;
      return;
    }
    const reference = await scene.skylineOf(finest);
    const rows = await scene.skylineOf(shown);
    const result = farhorizon.skyline.compare(rows, reference);
    byId('profile').hidden = false;
    byId('difference').textContent = result.count === 0 ? 'There is no terrain in this view.'
      : `Level ${shown} against level ${finest}, from here: at most ${digits(result.most)} px, ` +
        `root mean square ${digits(result.rms)} px.`;
    farhorizon.skyline.drawOver(over, rows, reference, colours());
    farhorizon.skyline.drawProfile(byId('profile'), result, colours());
  };

  // ---- Controls. What fails is said, and the rest goes on.
  const act = (work) => async (...given) => {
    try {
      await work(...given);
    } catch (failure) {
      notice(`${failure.message ?? failure}`);
    }
  };
  const showLevel = act(async (which) => {
    if (which !== 'stream' && !scene.levels.has(which)) return;
    const input = document.querySelector(`[name="level"][value="${which}"]`);
    if (input) input.checked = true;
    for (const row of byId('numbers').querySelectorAll('tbody tr')) {
      row.classList.toggle('shown', row.id === `row-${which}`);
    }
    await scene.show(which);
    await scene.setWireframe(byId('wireframe').checked);
    await showHorizon();
    await compare();
  });
  const pill = (value, text) => make('label', {},
    make('input', { type: 'radio', name: 'level', value: String(value) }), make('span', {}, text));
  byId('levels').append(
    ...[...scene.levels.keys()].map((number) => pill(number, String(number))),
    pill('stream', 'As streamed'));
  byId('levels').addEventListener('change', ({ target: { value } }) => {
    showLevel(value === 'stream' ? value : Number(value));
  });
  for (const input of document.querySelectorAll('[name="horizon"]')) {
    input.addEventListener('change', act(showHorizon));
  }
  const showWireframe = act(() => scene.setWireframe(byId('wireframe').checked));
  byId('wireframe').addEventListener('change', showWireframe);
  byId('compare').addEventListener('change', act(compare));
  const sayAzimuth = () => {
    byId('azimuth').value = Math.round(scene.orbit.heading);
    byId('towards').textContent = `${Math.round(scene.orbit.heading)}°`;
  };
  for (const button of document.querySelectorAll('[data-look]')) {
    button.addEventListener('click', () => {
      if (button.dataset.look === 'fit') scene.fit();
      else scene.look(Number(button.dataset.look));
      sayAzimuth();
    });
  }
  byId('azimuth').addEventListener('input', ({ target }) => {
    scene.orbit.heading = Number(target.value);
    scene.place();
    sayAzimuth();
  });
  byId('controls').addEventListener('submit', (event) => event.preventDefault());

  // The skylines hold for where the camera stands: they go when it moves and come when it rests.
  const { camera } = scene.widget;
  camera.percentageChanged = 0.001;
  camera.changed.addEventListener(() => {
    const over = byId('skylines');
    over.getContext('2d').clearRect(0, 0, over.width, over.height);
  });
  let rest = 0;
  camera.moveEnd.addEventListener(() => {
    clearTimeout(rest);
    if (byId('compare').checked) rest = setTimeout(act(compare), 150);
  });

  const cycle = () => {
    const order = ['off', 'plain', 'azimuth'];
    const value = order[(order.indexOf(mode()) + 1) % order.length];
    document.querySelector(`[name="horizon"][value="${value}"]`).checked = true;
    return showHorizon();
  };
  const flip = (id, work) => { byId(id).checked = !byId(id).checked; return work(); };
  const keys = {
    t: () => showLevel('stream'), f: () => scene.fit(), h: act(cycle),
    w: () => flip('wireframe', showWireframe),
    c: () => flip('compare', act(compare)),
    ArrowLeft: () => scene.turn({ heading: -5 }), ArrowRight: () => scene.turn({ heading: 5 }),
    ArrowUp: () => scene.turn({ pitch: -2 }), ArrowDown: () => scene.turn({ pitch: 2 }),
    '+': () => scene.turn({ zoom: 0.85 }), '=': () => scene.turn({ zoom: 0.85 }),
    '-': () => scene.turn({ zoom: 1 / 0.85 }),
  };
  addEventListener('keydown', (event) => {
    // Arrows move between choices and along sliders where those have the focus.
    const own = event.target.matches?.('input, select, textarea, summary') &&
      event.key.startsWith('Arrow');
    if (own || event.ctrlKey || event.metaKey || event.altKey) return;
    const work = /^[0-9]$/.test(event.key) ? () => showLevel(Number(event.key)) : keys[event.key];
    if (!work) return;
    event.preventDefault();
    work();
    sayAzimuth();
  });

  // Whether the models have edges of their own: the coarsest is asked, for it is small.
  const haveInlineEdges = async () => {
    const [{ uri }] = [...scene.levels.values()].at(-1);
    const bytes = await (await farhorizon.key.get(new URL(uri, scene.url))).arrayBuffer();
    return gltfOf(bytes).extensionsUsed?.includes('EXT_mesh_primitive_edge_visibility');
  };
  byId('inline').hidden = !(await haveInlineEdges().catch(() => false));
  byId('controls').hidden = false;
  await showLevel('stream');
  document.body.dataset.ready = 'true';
})();
