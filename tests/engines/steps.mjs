// Functions that run in a page, in any engine. They are sent as text and cannot use outer names.

/** Number of figures on the page. */
export async function figuresOf() {
  return document.querySelectorAll("epipole-figure").length;
}

/** Starts a figure and waits for its computation. */
export async function ready(index) {
  await customElements.whenDefined("epipole-figure");
  const figure = document.querySelectorAll("epipole-figure")[index];
  figure.scrollIntoView({ block: "center", behavior: "instant" });
  await figure.whenReady();
  figure.dispatchEvent(new PointerEvent("pointerenter"));
}

/** Focuses the first enabled slider, or the first handle. Returns whether there is one. */
export async function takeHold({ index, what }) {
  const figure = document.querySelectorAll("epipole-figure")[index];
  const selector = what === "slider" ? "input[type=range]:not([aria-disabled=true])" : ".grip";
  const found = [...figure.shadowRoot.querySelectorAll(selector)].find((one) => one.checkVisibility?.() ?? true);
  found?.focus({ preventScroll: true });
  return found !== undefined;
}

/** State, readouts and description of a figure after its computation. */
export async function look(index) {
  const figure = document.querySelectorAll("epipole-figure")[index];
  const rest = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  await rest(50);
  figure.flush();
  // Poll several times, as a computation starts a moment after the state has changed.
  for (let calm = 0, tries = 0; calm < 3 && tries < 1200; tries += 1) {
    calm = figure.shadowRoot.querySelector("[aria-busy]") ? 0 : calm + 1;
    await rest(50);
  }
  figure.flush();
  const canvas = figure.shadowRoot.querySelector("canvas");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width || 1, canvas.height || 1);
  const colors = new Set();
  for (let at = 0; at < data.length && colors.size < 64; at += 4 * 97) colors.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
  return {
    name: figure.getAttribute("name"),
    state: figure.state,
    readouts: figure.readouts,
    description: figure.description,
    permalink: figure.permalink,
    colors: colors.size,
  };
}

/** A base64 JPEG larger than figures accept: fine stripes, colors and slanted edges. */
export async function drawPhotograph() {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [1531, 1097];
  const context = canvas.getContext("2d");
  for (let band = 0; band < 400; band += 1) {
    context.fillStyle = `hsl(${(band * 47) % 360} 60% ${20 + ((band * 31) % 60)}%)`;
    context.save();
    context.translate((band * 389) % 1531, (band * 241) % 1097);
    context.rotate(band);
    context.fillRect(-60, -1 - (band % 9), 120, 2 + 2 * (band % 9));
    context.restore();
  }
  return canvas.toDataURL("image/jpeg", 0.8).split(",")[1];
}

/** Drops a photograph onto a figure. Returns the note beside the input. */
export async function dropPhotograph({ index, base64 }) {
  const figure = document.querySelectorAll("epipole-figure")[index];
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const dataTransfer = new DataTransfer();
  dataTransfer.items.add(new File([bytes], "desk.jpg", { type: "image/jpeg" }));
  const picture = figure.shadowRoot.querySelector(".picture");
  const drop = new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true, composed: true });
  // Some engines ignore the dataTransfer of synthetic events.
  if (!drop.dataTransfer) Object.defineProperty(drop, "dataTransfer", { value: dataTransfer });
  picture.dispatchEvent(drop);
  const note = figure.shadowRoot.querySelector(".photo .note");
  for (let tries = 0; tries < 1200 && !note.textContent.includes("pixels"); tries += 1) {
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  return note.textContent;
}

/** Formulas with hanging punctuation, and those followed by a line that begins with punctuation. */
export async function badlySet() {
  // Open and lay out everything, as hidden parts have no position.
  for (const folded of document.querySelectorAll("details")) folded.open = true;
  for (const element of document.querySelectorAll("main *")) {
    if (getComputedStyle(element).contentVisibility !== "visible") element.style.contentVisibility = "visible";
  }
  const bad = [];
  for (const formula of document.querySelectorAll("main :is(p, li, td) math")) {
    const says = formula.querySelector("annotation")?.textContent ?? formula.textContent;
    // Engines without the property have no hanging punctuation.
    if ((getComputedStyle(formula).hangingPunctuation || "none") !== "none") bad.push(`hanging: ${says}`);
    const after = formula.nextSibling;
    if (after?.nodeType !== Node.TEXT_NODE || !/^[,.;:!?)\]]/.test(after.data)) continue;
    const sign = document.createRange();
    sign.setStart(after, 0);
    sign.setEnd(after, 1);
    const [first, second] = [formula, sign].map((one) => one.getBoundingClientRect());
    if (second.left < first.left || second.top > first.bottom) bad.push(`a line begins after: ${says}`);
  }
  return bad;
}

/** Runs the code of a listing of the page, and says what comes below it. */
export async function runListing(name) {
  const box = document.getElementById(`listing-${name}`);
  const button = box.querySelector("button.run");
  const until = async (holds) => {
    for (const start = performance.now(); !holds(); ) {
      if (performance.now() - start > 60_000) throw new Error(`it takes too long: ${box.innerText}`);
      await new Promise((done) => setTimeout(done, 50));
    }
  };
  const said = () => box.querySelector(".run-output")?.textContent ?? "";
  button.click();
  await until(() => said() !== "" && button.dataset.state === "ready");
  return said().trim();
}
