// anywidget module: renders <epipole-figure> in a cell and keeps it equal to its model in Python.
// Scripts and modules arrive as buffers of one message, once per page; as traits of the widget they
// would be stored with every cell. Pages without a kernel embed them (`INSIDE`), and their models
// may have only a name.

const KEY = Symbol.for("epipole-figures");
/** Time over which changes are collected before they are sent to Python, milliseconds. */
const GATHER_MS = 60;
/** Time without changes after which the picture is sent to Python, milliseconds. */
const REST_MS = 1500;
/** Time limit for the kernel to send the scripts, milliseconds. */
const PATIENCE_MS = 30_000;

const TYPES = { code: "text/javascript", worker: "text/javascript", figures: "application/wasm", jobs: "application/wasm" };

/** The embedded files on pages without a kernel, else undefined. */
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

/** Loads the figures' scripts once per page; a failed load can be retried. */
function load(model) {
  if (customElements.get("epipole-figure")) return Promise.resolve();
  globalThis[KEY] ??= start(model).catch((problem) => {
    globalThis[KEY] = undefined;
    throw problem;
  });
  return globalThis[KEY];
}

/** Runs `work`, ignoring errors without a kernel: models of MyST throw on saving and on `off`. */
function ask(work) {
  try {
    work();
  } catch (problem) {
    if (typeof INSIDE === "undefined") throw problem;
  }
}

const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
/** Sorted parameters, as Python keeps the order in which they were set. */
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
  // A static picture for viewers of the notebook without widgets.
  const show = async () => {
    const [state, picture] = [figure.state, await figure.toPng({ scale: 1 })];
    const bytes = await picture?.arrayBuffer();
    if (!ready || !bytes) return;
    try {
      await model.send({ kind: "picture", state }, undefined, [bytes]);
    } catch {
      // Without a kernel, the picture is not needed.
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
    // The model may still call back.
    ready = false;
    clearTimeout(gathering);
    clearTimeout(resting);
    ask(() => model.off("change:state", follow));
    ask(() => model.off("msg:custom", hear));
    figure.remove();
  };
}

export default { render };
