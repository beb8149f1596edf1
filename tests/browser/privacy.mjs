// Data that a page sends, and data that it leaves in the reader's browser.

/** Everything that the book stores besides quiz progress, with the format of each value. */
const KEPT = {
  "epipole-places": /^(\[|\["[\w-]+","[^"]+","[^"]+"\]|,|\])+$/,
  "epipole-settings": /^\{"theme":"(light|dark)"\}$/,
  "epipole-contents": /^folded$/,
  "epipole-listing": /^(numpy|opencv|epipole|rust)$/,
  "epipole-host": /^[A-Z][\w ,()]+$/,
};
const QUIZ = /^epipole-quiz:[\w-]+$/;

/** Records all requests of a browser context, including workers, with the size of their bodies. */
export function listenIn(context) {
  const requests = [];
  const note = (url, method, body = 0) => requests.push({ url, method, body });
  context.on("request", (request) => note(request.url(), request.method(), request.postDataBuffer()?.length));
  for (const page of context.pages()) page.on("websocket", (socket) => note(socket.url(), "socket"));
  return requests;
}

/** Requests that leave `origin` or carry data. */
export function leaving(requests, origin) {
  const inside = ({ url }) => url.startsWith(`${origin}/`) || /^(data|blob|about):/.test(url);
  return requests.filter((request) => !inside(request) || request.method !== "GET" || request.body > 0);
}

/** Whether a local storage entry is a setting or quiz progress. */
function isOurs([key, value]) {
  if (!QUIZ.test(key)) return KEPT[key]?.test(value) ?? false;
  const solved = JSON.parse(value);
  return Object.entries(solved).every(([id, hash]) => /^quiz-[\w-]+$/.test(id) && /^[0-9a-f]{8}$/.test(hash));
}

/** Data stored by a page: keys of settings and quizzes, and `besides`, which should be empty. */
export async function kept(page) {
  const { local, ...found } = await page.evaluate(async () => {
    const files = [];
    const directory = await navigator.storage.getDirectory();
    for await (const name of directory.keys()) files.push(name);
    return {
      local: Object.entries(localStorage),
      session: Object.keys(sessionStorage),
      databases: (await indexedDB.databases()).map(({ name }) => name),
      caches: await caches.keys(),
      workers: (await navigator.serviceWorker.getRegistrations()).map(({ scope }) => scope),
      files,
    };
  });
  const cookies = (await page.context().cookies()).map(({ name }) => name);
  const strange = local.filter((entry) => !isOurs(entry)).map((entry) => entry.join("="));
  const besides = Object.entries({ ...found, cookies, strange }).filter(([, list]) => list.length > 0);
  return { keys: local.map(([key]) => key).sort(), besides };
}
