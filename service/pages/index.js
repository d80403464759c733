'use strict';
// The list of jobs, kept up to date. All text from outside goes in as text, never as markup.
(() => {
  const { byId, make, key } = farhorizon;
  const readableBytes = (bytes) => {
    const unit = [[1e9, 'GB'], [1e6, 'MB'], [1e3, 'kB']].find(([size]) => bytes >= size);
    return unit ? `${(bytes / unit[0]).toPrecision(3)} ${unit[1]}` : `${bytes} bytes`;
  };
  const readableTime = (iso) => {
    const time = new Date(iso);
    const today = time.toDateString() === new Date().toDateString();
    return today ? time.toLocaleTimeString() : time.toLocaleString();
  };
  const isOpen = (job) => job.status === 'accepted' || job.status === 'running';
  const kStates = {
    accepted: 'waiting', running: 'running', successful: 'done', failed: 'failed',
    dismissed: 'dismissed',
  };
  // What a problem document or a failed fetch says.
  const causeOf = async (response) => {
    const problem = await response.json().catch(() => null);
    return problem?.detail ?? `the service answered ${response.status}`;
  };

  // A job's element is made once and then filled anew, so that focus and open lists stay.
  const rows = new Map();
  const places = (id) => ({
    self: `jobs/${id}`, results: `jobs/${id}/results`, viewer: `viewer/${id}`,
  });

  const showArtifacts = async (row, button) => {
    const shown = row.querySelector('.artifacts');
    button.setAttribute('aria-expanded', String(!shown));
    if (shown) return shown.remove();
    const response = await key.get(places(row.id).results);
    if (!response.ok) return trouble(await causeOf(response));
    const table = make('table', { className: 'artifacts' });
    for (const [name, artifact] of Object.entries(await response.json())) {
      const href = `${places(row.id).results}/${encodeURIComponent(name)}`;
      const link = key.follow(make('a', { href }, name), places(row.id).self);
      table.append(make('tr', {}, make('td', {}, link),
        make('td', {}, readableBytes(artifact.length))));
    }
    row.append(table);
  };
  const dismiss = async (row) => {
    const open = row.dataset.open === 'true';
    if (!open && !confirm('Remove the artifacts of this job?')) return;
    const response = await key.get(places(row.id).self, { method: 'DELETE' });
    if (!response.ok) trouble(await causeOf(response));
    refresh();
  };

  const makeRow = (job) => {
    const at = places(job.id);
    const artifacts = make('button', { type: 'button', className: 'of-result' }, 'Artifacts');
    const remove = make('button', { type: 'button', className: 'remove' });
    const report = key.follow(make(
      'a', { className: 'button of-result', href: `${at.results}/report.html` }, 'Report'), at.self);
    const row = make('li', { id: job.id },
      make('div', { className: 'top' }, make('span', { className: 'name' }),
        make('span', { className: 'state' }), make('time')),
      make('p', { className: 'message' }), make('progress', { max: 100 }),
      make('details', { className: 'assumed' }, make('summary'), make('ul')),
      make('div', { className: 'actions' },
        make('a', { className: 'button of-result', href: at.viewer }, 'View'),
        report, artifacts, remove));
    artifacts.setAttribute('aria-expanded', 'false');
    artifacts.addEventListener('click', () => showArtifacts(row, artifacts));
    remove.addEventListener('click', () => dismiss(row));
    return row;
  };
  const fillRow = (row, job) => {
    const find = (selector) => row.querySelector(selector);
    row.className = `job ${job.status}`;
    row.dataset.open = String(isOpen(job));
    find('.name').textContent = job.filename || job.id;
    find('.state').textContent = kStates[job.status] ?? job.status;
    const time = find('time');
    time.dateTime = job.created;
    time.textContent = readableTime(job.created);
    find('.message').textContent = job.status === 'successful' ? '' : job.message;
    const progress = find('progress');
    progress.hidden = job.status !== 'running';
    progress.value = job.progress;
    progress.setAttribute('aria-label', `Progress of ${job.filename}`);
    const assumed = job.assumptions ?? [];
    find('.assumed').hidden = assumed.length === 0;
    find('.assumed summary').textContent =
      assumed.length === 1 ? 'One thing was assumed' : `${assumed.length} things were assumed`;
    find('.assumed ul').replaceChildren(...assumed.map(({ text }) => make('li', {}, text)));
    for (const element of row.querySelectorAll('.of-result')) {
      element.hidden = job.status !== 'successful';
    }
    if (job.status !== 'successful') find('.artifacts')?.remove();
    const remove = find('.remove');
    remove.hidden = !isOpen(job) && job.status !== 'successful';
    remove.textContent = isOpen(job) ? 'Cancel' : 'Remove';
  };
  const rowOf = (job) => {
    if (!rows.has(job.id)) rows.set(job.id, makeRow(job));
    fillRow(rows.get(job.id), job);
    return rows.get(job.id);
  };

  const trouble = (text) => {
    byId('trouble').hidden = !text;
    byId('trouble').textContent = text ?? '';
  };

  // Older pages stay as they were when they were asked for.
  let older = [];
  let next = null;
  const nextOf = (list) => {
    const link = list.links.find(({ rel }) => rel === 'next');
    return link ? new URL(link.href).search : null;
  };
  const show = (newest) => {
    const seen = new Set(newest.map(({ id }) => id));
    const jobs = [...newest, ...older.filter(({ id }) => !seen.has(id))];
    const list = byId('jobs');
    jobs.forEach((job, i) => {
      const row = rowOf(job);
      if (list.children[i] !== row) list.insertBefore(row, list.children[i] ?? null);
    });
    while (list.children.length > jobs.length) list.lastChild.remove();
    byId('empty').hidden = jobs.length > 0;
    byId('older').hidden = !next;
    const count = (state) => newest.filter(({ status }) => status === state).length;
    const [running, waiting] = [count('running'), count('accepted')];
    const parts = [running && `${running} running`, waiting && `${waiting} waiting`];
    byId('queue').textContent =
      parts.filter(Boolean).join(', ') || (jobs.length ? 'None is running or waiting' : '');
  };

  // The browser asks with If-None-Match; an unchanged list costs a 304 and no work here.
  const kLimit = 25;
  let tag = null;
  let timer = 0;
  let busy = true;
  const refresh = async () => {
    clearTimeout(timer);
    try {
      const response = await key.get(`jobs?limit=${kLimit}`, { cache: 'no-cache' });
      if (!response.ok) throw new Error(await causeOf(response));
      if (tag === null || response.headers.get('ETag') !== tag) {
        const list = await response.json();
        if (older.length === 0) next = nextOf(list);
        show(list.jobs);
        busy = list.jobs.some(isOpen);
        tag = response.headers.get('ETag');
      }
      if (byId('trouble').dataset.kind === 'connection') trouble(null);
      byId('trouble').dataset.kind = '';
    } catch (failure) {
      trouble(`No answer: ${failure.message}. Trying again.`);
      byId('trouble').dataset.kind = 'connection';
    }
    clearTimeout(timer);
    if (!document.hidden) timer = setTimeout(refresh, busy ? 1000 : 5000);
  };
  document.addEventListener('visibilitychange', () => { if (!document.hidden) refresh(); });
  byId('older').addEventListener('click', async () => {
    const response = await key.get(`jobs${next}`);
    if (!response.ok) return trouble(await causeOf(response));
    const list = await response.json();
    older = older.concat(list.jobs);
    next = nextOf(list);
    tag = null;
    refresh();
  });

  const showForget = () => { byId('forget').hidden = !key.isAsked(); };
  byId('forget').addEventListener('click', key.forget);
  addEventListener('farhorizon-key', showForget);
  showForget();
  farhorizon.takeUploads(refresh);
  refresh();
})();
