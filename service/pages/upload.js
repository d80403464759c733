'use strict';
// Uploads: files that are chosen or dropped go to the service, one after another.
(() => {
  const { key, make } = farhorizon;
  const byId = (id) => document.getElementById(id);
  // sent: called after each that the service has taken. fetch tells nothing of what has been sent,
  // XMLHttpRequest does.
  const takeUploads = (sent) => {
    const send = (file, line) => new Promise((done) => {
      const query = new URLSearchParams({ filename: file.name });
      for (const field of byId('upload').querySelectorAll('.options [name]')) {
        if (field.value.trim()) query.set(field.name, field.value.trim());
      }
      const request = new XMLHttpRequest();
      const say = (text, bad = false) => {
        line.firstChild.textContent = `${file.name}: ${text}`;
        line.classList.toggle('bad', bad);
      };
      const fail = (text) => {
        const close = make('button', { type: 'button' }, 'Dismiss');
        close.addEventListener('click', () => line.remove());
        say(text, true);
        line.append(close);
        done();
      };
      request.upload.addEventListener('progress', ({ loaded, total }) => {
        say(loaded < total ? `${Math.floor(100 * loaded / total)} % sent` : 'is being looked at');
      });
      request.addEventListener('load', async () => {
        const challenge = request.getResponseHeader('WWW-Authenticate');
        if (key.isChallenge(request.status, challenge)) {
          await key.ask(key.reasonOf(challenge));
          return send(file, line).then(done);
        }
        if (request.status === 201) {
          line.remove();
          sent();
          return done();
        }
        let problem = null;
        try { problem = JSON.parse(request.responseText); } catch { /* no problem document */ }
        return fail(problem?.detail ?? `the service answered ${request.status}`);
      });
      request.addEventListener('error', () => fail('the connection broke; send it again'));
      request.open('POST', `jobs?${query.toString().replaceAll('+', '%20')}`);
      request.setRequestHeader('Content-Type', 'application/octet-stream');
      for (const [name, value] of Object.entries(key.headers())) request.setRequestHeader(name, value);
      say('is being sent');
      request.send(file);
    });
    let queue = Promise.resolve();
    const take = (files) => {
      for (const file of files) {
        const line = make('li', {}, make('span', {}, `${file.name}: waits`));
        byId('uploads').append(line);
        queue = queue.then(() => send(file, line));
      }
    };
    byId('file').addEventListener('change', ({ target }) => {
      take([...target.files]);
      target.value = '';
    });
    byId('upload').addEventListener('submit', (event) => event.preventDefault());
    // The whole page takes files, so that none that misses the box replaces the page.
    let depth = 0;
    const over = (change) => {
      depth = Math.max(0, depth + change);
      document.body.classList.toggle('over', depth > 0);
    };
    addEventListener('dragenter', () => over(1));
    addEventListener('dragleave', () => over(-1));
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      depth = 0;
      over(0);
      take([...event.dataTransfer.files]);
    });
  };

  Object.assign(farhorizon, { byId, takeUploads });
})();
