'use strict';
// The report's numbers, which need no CesiumJS.
(() => {
  const { key, make } = farhorizon;
  const byId = (id) => document.getElementById(id);
  const { results, home } = document.body.dataset;
  const getJson = async (name) => {
    const response = await key.get(results + name);
    return response.ok ? response.json() : null;
  };

  let manifest = null;
  const getManifest = async () => {
    manifest ??= getJson('manifest.json').catch(() => null);
    return (await manifest)?.artifacts ?? [];
  };

  const digits = (value) => {
    if (value === null || value === undefined) return '–';
    return value === 0 ? '0' : Math.abs(value) < 1000 ? String(Number(value.toPrecision(3)))
      : Math.round(value).toLocaleString('en');
  };
  // The bytes of all contents of a level, which may be in parts: lodN.glb, or lodN-X-Y.glb.
  const glbBytesOf = (level, artifacts) => {
    const parts = artifacts.filter(({ name }) => /^lod(\d+)(-\d+-\d+)?\.glb$/.exec(name)?.[1]
      === String(level.level));
    return parts.length ? parts.reduce((sum, { bytes }) => sum + bytes, 0) : level.glb_bytes;
  };
  const fillNumbers = (report, artifacts) => {
    const heads = ['Level', 'Triangles', 'Skyline rms, m', 'Ground rms, m', 'GLB, kB'];
    const row = (level) => make('tr', { id: `row-${level.level}` },
      make('th', { scope: 'row' }, String(level.level)),
      ...[level.triangles, level.silhouette_error_m.rms, level.vertical_error_m.rms,
        glbBytesOf(level, artifacts) / 1000].map((value) => make('td', {}, digits(value))));
    byId('numbers').append(
      make('caption', {}, 'Errors against the DEM, root mean square'),
      make('thead', {}, make('tr', {}, ...heads.map((text) => make('th', { scope: 'col' }, text)))),
      make('tbody', {}, ...report.levels.map(row)));
    const { columns, rows, heights_m: heights } = report.dem;
    byId('facts').textContent = `${columns} × ${rows} posts, ${digits(heights[0])} to ` +
      `${digits(heights[1])} m; ${report.horizon.horizon_edges.toLocaleString('en')} horizon edges`;
  };
  const jobOf = (folder) => folder.replace(/\/results\/$/, '');
  const linkTo = (name) => {
    const link = make('a', { href: results + name }, name);
    return home ? key.follow(link, jobOf(results)) : link;
  };
  const fillHead = async () => {
    const report = await getJson('report.json');
    if (report) fillNumbers(report, await getManifest());
    byId('links').append(...['report.html', 'report.json', 'tileset.json'].flatMap(
      (name, i) => [i ? ' · ' : '', linkTo(name)]));
    if (!home) return;
    byId('home').href = home;
    byId('home').hidden = false;
    const job = await key.get(jobOf(results)).then((answer) => answer.json());
    byId('title').textContent = job.filename ?? job.id;
    document.title = `${job.filename ?? job.id}: farhorizon`;
  };

  farhorizon.numbers = { byId, make, digits, getJson, getManifest, fillHead };
})();
