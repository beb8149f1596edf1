// Keeping a project in the browser: only by choice, restored on the next visit, erased on request.

import { choose, expect, expectAccessible, file, give, press, said, solved, test } from "./lab.mjs";

const KEPT = "epipole-lab-kept";

/** Names of all databases. */
const kept = (page) => page.evaluate(async () => (await indexedDB.databases()).map(({ name }) => name));

/** Chooses to keep the project and waits until it is stored. */
async function keep(lab) {
  await choose(lab, "checkbox", "Keep in this browser");
  await expect(said(lab)).toContainText("This browser keeps the project", { timeout: 30_000 });
}

const photograph = (lab, name) => lab.locator("#widgets").getByRole("button", { name: new RegExp(`^${name}:`) });

test("photographs and knobs are there again at the next visit, until they are forgotten", async ({ lab, library }) => {
  await solved(lab);
  await give(lab);
  // Nothing is stored without the reader's choice.
  expect(await kept(lab)).toEqual([]);
  await press(lab, "button", "Project");
  await expect(lab.locator("#widgets")).toContainText("on this machine. Nothing is uploaded");
  await press(lab, "button", "Project");
  await choose(lab, "checkbox", "Keep in this browser");
  await expect(said(lab)).toContainText("This browser keeps the project", { timeout: 30_000 });
  expect(await kept(lab)).toEqual([KEPT]);
  await expectAccessible(lab);
  const size = () =>
    lab.evaluate(
      (name) =>
        new Promise((resolve) => {
          const asked = indexedDB.open(name);
          asked.onsuccess = () => {
            const all = asked.result.transaction("files").objectStore("files").getAll();
            all.onsuccess = () => (asked.result.close(), resolve(all.result[0].size));
          };
        }),
      KEPT,
    );
  const before = await size();
  await press(lab, "checkbox", "Use this photograph");
  await expect(said(lab)).toContainText("one.png: left out by you");
  // The change is saved after a delay; its size differs by a letter, true or false.
  await expect.poll(size, { timeout: 30_000 }).not.toBe(before);

  // A new visit, not a reload, with an empty address.
  await lab.goto("about:blank");
  await lab.goto(`${library}/lab/index.html`);
  await expect(said(lab)).toContainText("The project kept in this browser is open again", { timeout: 60_000 });
  await press(lab, "button", "Photographs");
  await expect(said(lab)).toContainText("2 photographs.");
  for (const name of ["one.png", "two.png"]) await expect(photograph(lab, name)).toHaveCount(1);
  await expect(said(lab)).toContainText("one.png: left out by you");

  // A link to a sample shows the sample and overwrites nothing.
  await lab.goto(`${library}/lab/index.html?sample=turned`);
  await expect(said(lab)).toContainText("This browser keeps a project of yours", { timeout: 60_000 });
  await choose(lab, "button", "Open the kept project");
  await expect(said(lab)).toContainText("2 photographs.", { timeout: 60_000 });

  await choose(lab, "button", "Forget it");
  await expect(said(lab)).toContainText("The project is no longer kept in this browser.");
  await expect(said(lab)).toContainText("2 photographs.");
  await expect.poll(() => kept(lab)).toEqual([]);
  await lab.goto(`${library}/lab/index.html`);
  await solved(lab);
  expect(await kept(lab)).toEqual([]);
});

test("one starts over beside the sentence that a project came back", async ({ lab }) => {
  await solved(lab);
  await give(lab);
  await keep(lab);
  await lab.reload();
  await expect(said(lab)).toContainText("is open again", { timeout: 60_000 });
  await press(lab, "button", "Start over");
  await solved(lab);
  await expect.poll(() => kept(lab)).toEqual([]);
});

test("what one page forgets, another one that is open does not keep again", async ({ lab, library, complaints }) => {
  await solved(lab);
  await give(lab);
  await keep(lab);
  const other = await lab.context().newPage();
  await other.goto(`${library}/lab/index.html`);
  await expect(said(other)).toContainText("is open again", { timeout: 60_000 });
  await choose(other, "button", "Forget it");
  await expect.poll(() => kept(other)).toEqual([]);
  await other.close();
  await expect(said(lab)).toContainText("Another page of the Lab removed the kept project", { timeout: 30_000 });
  await expect(said(lab)).toContainText("2 photographs.");
  expect(complaints).toEqual([]);
});

/** Storage faults, as browsers raise them. */
const FAULTS = {
  "is forbidden": {
    fault: () => {
      IDBFactory.prototype.open = () => {
        throw new DOMException("forbidden", "SecurityError");
      };
    },
    words: "The project is not kept in this browser: it does not let this page keep anything. Save it as a file",
  },
  "is full": {
    fault: () => {
      IDBObjectStore.prototype.put = () => {
        throw new DOMException("full", "QuotaExceededError");
      };
    },
    words: "The project is not kept in this browser: there is no room for 0.0 MB. Save it as a file",
  },
};

for (const [what, { fault, words }] of Object.entries(FAULTS)) {
  test(`storage that ${what} is told, and the photographs stay`, async ({ lab, complaints }) => {
    await solved(lab);
    await give(lab);
    await lab.evaluate(fault);
    await choose(lab, "checkbox", "Keep in this browser");
    await expect(said(lab)).toContainText(words, { timeout: 30_000 });
    await expect(said(lab)).toContainText("2 photographs.");
    // No retries.
    await expect(async () => {
      const choice = lab.locator("#widgets").getByRole("checkbox", { name: "Keep in this browser" });
      if ((await choice.count()) === 0) await press(lab, "button", "Project");
      await expect(choice).not.toBeChecked({ timeout: 1_000 });
    }).toPass({ timeout: 15_000 });
    complaints.length = 0;
  });
}

test("a lost context loses nothing of what is kept, and brings nothing back twice", async ({ lab, complaints }) => {
  await solved(lab);
  await give(lab);
  await keep(lab);
  // The photograph is lost before it is saved to the kept project.
  await lab.locator("#photographs").setInputFiles([file("three.png", 96, 72)]);
  await expect(said(lab)).toContainText("3 photographs.", { timeout: 30_000 });
  await lab.evaluate(() => {
    const canvas = document.querySelector("#lab");
    const context = canvas.getContext("webgl2") ?? canvas.getContext("webgl");
    context.getExtension("WEBGL_lose_context").loseContext();
  });
  const next = lab.waitForEvent("load", { timeout: 60_000 });
  await lab.getByRole("button", { name: /^Start the Lab again with your project/ }).click({ timeout: 30_000 });
  await next;
  await expect(said(lab)).toContainText("3 photographs.", { timeout: 60_000 });
  for (const name of ["one.png", "two.png", "three.png"]) await expect(photograph(lab, name)).toHaveCount(1);
  await expect(said(lab)).not.toContainText("same file");
  complaints.length = 0;
});

test("what is kept but damaged, or of a newer Lab, is told and stays until it is forgotten", async ({ lab, complaints }) => {
  await solved(lab);
  await give(lab);
  await keep(lab);
  const { zipSync, strToU8 } = await import("../../web/node_modules/fflate/esm/index.mjs");
  const newer = [...zipSync({ "project.json": strToU8(JSON.stringify({ version: 999 })) })];
  const replace = (bytes) =>
    lab.evaluate(
      ([name, bytes]) =>
        new Promise((resolve) => {
          const asked = indexedDB.open(name);
          asked.onsuccess = () => {
            const transaction = asked.result.transaction("files", "readwrite");
            const value = bytes ? new Blob([new Uint8Array(bytes)]) : "no project";
            transaction.objectStore("files").put(value, "files");
            transaction.oncomplete = () => (asked.result.close(), resolve());
          };
        }),
      [KEPT, bytes],
    );
  const cases = [
    [[1, 2, 3], "does not open: this file is no project of the Lab, or it is damaged"],
    [newer, "does not open: this project was saved by a newer Lab"],
    [null, "The project that this browser keeps cannot be read any more."],
  ];
  for (const [bytes, words] of cases) {
    await replace(bytes);
    await lab.reload();
    await expect(said(lab)).toContainText(words, { timeout: 60_000 });
    expect(await kept(lab)).toEqual([KEPT]);
  }
  await give(lab);
  await choose(lab, "button", "Forget it");
  await expect(said(lab)).toContainText("2 photographs.");
  await expect.poll(() => kept(lab)).toEqual([]);
  expect(complaints).toEqual([]);
});
