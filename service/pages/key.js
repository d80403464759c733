'use strict';
// The key of a service that asks for one: asked for once, kept for as long as the tab is open, and
// sent in the field Authorization alone. A link, which can have no field, gets a ticket instead.
const farhorizon = {};
(() => {
  const kName = 'farhorizon-key';
  const headers = () => {
    const key = sessionStorage.getItem(kName);
    return key ? { Authorization: `Bearer ${key}` } : {};
  };
  const isAsked = () => sessionStorage.getItem(kName) !== null;
  const forget = () => {
    sessionStorage.removeItem(kName);
    location.reload();
  };

  const make = (tag, properties = {}, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  };
  // Fulfilled when a key has been given; however many ask, one dialog is shown.
  let asking = null;
  const ask = (why) => {
    asking ??= new Promise((done) => {
      const input = make('input', {
        type: 'password', name: 'key', autocomplete: 'off', spellcheck: false, required: true,
        placeholder: 'fh_…',
      });
      const form = make('form', {},
        make('p', {}, why), make('label', {}, 'Key ', input),
        make('button', { className: 'primary' }, 'Use it'));
      const dialog = make('dialog', { className: 'key' }, form);
      dialog.addEventListener('cancel', (event) => event.preventDefault());
      form.addEventListener('submit', (event) => {
        event.preventDefault();
        sessionStorage.setItem(kName, input.value.trim());
        asking = null;
        dialog.remove();
        dispatchEvent(new Event('farhorizon-key'));
        done();
      });
      document.body.append(dialog);
      dialog.showModal();
    });
    return asking;
  };
  const isChallenge = (status, challenge) =>
    status === 401 && /^Bearer realm="farhorizon"/.test(challenge ?? '');
  const reasonOf = (challenge) => (/invalid_token/.test(challenge)
    ? 'This key is not good, or no longer. The service asks for another.'
    : 'This service asks for a key. It is kept until this tab is closed.');

  // fetch with the key. Asks for one, and fetches again, where the service wants one.
  const get = async (url, options = {}) => {
    for (;;) {
      const sent = headers();
      const response = await fetch(url, { ...options, headers: { ...options.headers, ...sent } });
      const challenge = response.headers.get('WWW-Authenticate');
      if (!isChallenge(response.status, challenge)) return response;
      // Another request may have got a key meanwhile.
      if (sent.Authorization === headers().Authorization) await ask(reasonOf(challenge));
    }
  };
  // Lets a link to a result work by itself where there is a key.
  const follow = (link, job) => {
    link.addEventListener('click', async (event) => {
      if (!isAsked() || event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      const response = await get(`${job}/ticket`, { method: 'POST' });
      if (!response.ok) return;
      const url = new URL(link.href);
      url.searchParams.set('ticket', (await response.json()).ticket);
      location.assign(url);
    });
    return link;
  };

  farhorizon.make = make;
  farhorizon.key = { headers, isAsked, forget, ask, isChallenge, reasonOf, get, follow };
})();
