// Puts <epipole-figure> into a cell and keeps it and the model in Python equal. The scripts and modules come as
// buffers of one message, once a page: what stands in a widget itself would be kept anew for every cell that runs.
// Pages without a kernel have them inside (`INSIDE`), and a model that may hold no more than a name.

const KEY = Symbol.for("epipole-figures");
/** How long what changes is gathered before Python is told, milliseconds. */
const GATHER_MS = 60;
/** A figure that rests for so long shows its picture to Python, milliseconds. */
const REST_MS = 1500;
/** How long the kernel may take to send the scripts, milliseconds. */
const PATIENCE_MS = 30_000;

const TYPES = { code: "text/javascript", worker: "text/javascript", figures: "application/wasm", jobs: "application/wasm" };

/** What is inside, where there is no kernel to ask. */
function inside() {
  if (typeof INSIDE === "undefined") return undefined;
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return Object.fromEntries(Object.entries(INSIDE).map(([name, text]) => [name, bytes(text)]));
}

function asked(model) {
  return new Promise((resolve, reject) => {
    const late = setTimeout(() => reject(new Error("the kernel did not send the figure")), PATIENCE_MS);
    const hear = (message, buffers) => {
      if (message?.kind !== "assets") return;
      clearTimeout(late);
      model.off("msg:custom", hear);
      resolve(Object.fromEntries(message.names.map((name, index) => [name, buffers[index]])));
    };
    model.on("msg:custom", hear);
    model.send({ kind: "assets?" });
  });
}

async function start(model) {
  const files = inside() ?? (await asked(model));
  const address = (name) => URL.createObjectURL(new Blob([files[name]], { type: TYPES[name] }));
  const code = address("code");
  const { setAssets } = await import(/* webpackIgnore: true */ /* @vite-ignore */ code);
  URL.revokeObjectURL(code);
  setAssets({ figures: address("figures"), jobs: address("jobs"), worker: address("worker") });
}

/** Loads what figures need, once for the page; what failed may be tried again. */
function load(model) {
  if (customElements.get("epipole-figure")) return Promise.resolve();
  globalThis[KEY] ??= start(model).catch((problem) => {
    globalThis[KEY] = undefined;
    throw problem;
  });
  return globalThis[KEY];
}

/** What a model without a kernel need not be able to do: MyST's throws where it is to save or to forget a listener. */
function ask(work) {
  try {
    work();
  } catch (problem) {
    if (typeof INSIDE === "undefined") throw problem;
  }
}

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
/** Parameters in one order: Python keeps that in which it was told. */
const sorted = (state) => Object.entries(state ?? {}).sort(([one], [other]) => (one < other ? -1 : 1));

async function render({ model, el }) {
  try {
    await load(model);
  } catch (problem) {
    el.textContent = `This figure could not be loaded: ${problem.message}. Run the cell again.`;
    return undefined;
  }
  const figure = document.createElement("epipole-figure");
  figure.setAttribute("name", model.get("name"));
  for (const [key, value] of Object.entries(model.get("_look") ?? {})) {
    if (key === "height") figure.style.height = `${value}px`;
    else figure.setAttribute(key, value);
  }
  el.append(figure);

  let ready = false;
  let gathering;
  let resting;
  // For whoever looks at the notebook where no widgets are shown.
  const show = async () => {
    const [state, picture] = [figure.state, await figure.toPng({ scale: 1 })];
    const bytes = await picture?.arrayBuffer();
    if (!ready || !bytes) return;
    try {
      await model.send({ kind: "picture", state }, undefined, [bytes]);
    } catch {
      // Without a kernel nobody takes it.
    }
  };
  const tell = () => {
    clearTimeout(gathering);
    gathering = undefined;
    if (!same(sorted(figure.state), sorted(model.get("state")))) model.set("state", figure.state);
    if (!same(figure.readouts, model.get("readouts"))) model.set("readouts", figure.readouts);
    const solved = [...new Set([...(model.get("solved") ?? []), ...figure.solved])];
    if (!same(solved, model.get("solved") ?? [])) model.set("solved", solved);
    if (figure.description !== model.get("description")) model.set("description", figure.description);
    ask(() => model.save_changes());
    clearTimeout(resting);
    resting = setTimeout(() => void show(), REST_MS);
  };
  const later = () => {
    if (ready) gathering ??= setTimeout(tell, GATHER_MS);
  };
  const follow = () => {
    if (ready && !same(sorted(figure.state), sorted(model.get("state")))) void figure.restore(model.get("state") ?? {});
  };
  const hear = (message) => {
    if (message?.kind === "press") void figure.whenReady().then(() => figure.press(message.id));
  };
  for (const type of ["epipole-change", "epipole-readout", "epipole-challenge"]) figure.addEventListener(type, later);
  model.on("change:state", follow);
  model.on("msg:custom", hear);
  void figure.restore(model.get("state") ?? {}, { solved: model.get("solved") ?? [] }).then(() => {
    figure.flush();
    ready = true;
    tell();
  });

  return () => {
    // Also for a model that goes on calling.
    ready = false;
    clearTimeout(gathering);
    clearTimeout(resting);
    ask(() => model.off("change:state", follow));
    ask(() => model.off("msg:custom", hear));
    figure.remove();
  };
}

export default { render };
