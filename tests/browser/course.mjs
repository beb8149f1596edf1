// A page of a course with an iframe, and the messages that it hears from there.

import { serve } from "./server.mjs";

/**
 * Opens a course page: `hear` is the code of its listener, `attributes` are those of the iframe.
 * Returns what is in the iframe.
 */
export async function course(page, address, hear = "", attributes = "") {
  const html = `<!doctype html><html lang="en"><title>A course</title>
    <iframe src="${address}" title="Figure" width="900" height="400" ${attributes}></iframe>
    <script>
      window.heard = [];
      const iframe = document.querySelector("iframe");
      addEventListener("message", (event) => {
        // A frame whose page has gone since has no window any more.
        if (event.source && event.source !== iframe.contentWindow) return;
        window.heard.push(event.data);
        const data = typeof event.data === "string" ? JSON.parse(event.data) : event.data;
        const answer = (message) => event.source.postMessage(message, "*");
        ${hear}
      });
    </script>`;
  const outer = await serve({ mounts: { "": () => html }, policy: false });
  await page.goto(outer.origin);
  return { inner: page.frameLocator("iframe"), close: outer.close };
}

/** Messages that the page has heard, parsed. */
export async function heard(page, subject) {
  const all = await page.evaluate(() => window.heard.map((data) => (typeof data === "string" ? { text: data, ...JSON.parse(data) } : data)));
  return subject ? all.filter((message) => message.subject === subject) : all;
}
