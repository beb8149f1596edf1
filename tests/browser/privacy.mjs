// What a page tells others, and what it leaves behind on its reader's machine.

/** Settings of the page and progress in quizzes: all that the book keeps, and how it looks. */
const KEPT = {
  "epipole-theme": /^(light|dark)$/,
  "epipole-contents": /^folded$/,
  "epipole-listing": /^(numpy|opencv|rust)$/,
  "epipole-host": /^[A-Z][\w ,()]+$/,
};
const QUIZ = /^epipole-quiz:[\w-]+$/;

/** Records every request of a browser context, also those of workers, and what it would carry away. */
export function listenIn(context) {
  const requests = [];
  const note = (url, method, body = 0) => requests.push({ url, method, body });
  context.on("request", (request) => note(request.url(), request.method(), request.postDataBuffer()?.length));
  for (const page of context.pages()) page.on("websocket", (socket) => note(socket.url(), "socket"));
  return requests;
}

/** Those that leave `origin`, and those that carry anything. */
export function leaving(requests, origin) {
  const inside = ({ url }) => url.startsWith(`${origin}/`) || /^(data|blob|about):/.test(url);
  return requests.filter((request) => !inside(request) || request.method !== "GET" || request.body > 0);
}

/** Whether an entry of the local storage is a setting or progress. */
function isOurs([key, value]) {
  if (!QUIZ.test(key)) return KEPT[key]?.test(value) ?? false;
  const solved = JSON.parse(value);
  return Object.entries(solved).every(([id, hash]) => /^quiz-[\w-]+$/.test(id) && /^[0-9a-f]{8}$/.test(hash));
}

/** What a page keeps: names of settings and quizzes, and everything else, which ought to be nothing. */
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
