// Replaces the picture in `box` by a view that turns. `data`: numbers of points and cameras, and
// their bytes as base64: three int16 per position, then red, green, blue per point.
(function (box, data) {
  if (!box || !box.isConnected) return;
  const UNIT = 8000; // Units of a position per radius of the cloud.
  const HOME = { yaw: -0.5, pitch: 0.35, distance: 3 };
  const bytes = Uint8Array.from(atob(data.bytes), (letter) => letter.charCodeAt(0));
  const count = data.points + 5 * data.cameras;
  const places = new Int16Array(bytes.buffer, 0, 3 * count);
  const colors = bytes.subarray(6 * count);
  const canvas = document.createElement("canvas");
  canvas.tabIndex = 0;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${data.text}. Arrow keys turn the view, plus and minus zoom, Home resets it.`);
  canvas.style.cssText = "display:block;width:100%;aspect-ratio:3/2;touch-action:pan-y;cursor:grab;background:#fff";
  const context = canvas.getContext("2d");
  if (!context) return;
  box.replaceChildren(canvas);
  let view = { ...HOME };
  let waiting = false;

  function draw() {
    waiting = false;
    const scale = window.devicePixelRatio || 1;
    const width = Math.round(canvas.clientWidth * scale);
    const height = Math.round(canvas.clientHeight * scale);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    context.clearRect(0, 0, width, height);
    const [cy, sy, cp, sp] = [Math.cos(view.yaw), Math.sin(view.yaw), Math.cos(view.pitch), Math.sin(view.pitch)];
    const focal = 1.1 * height;
    const place = (n) => {
      const [x, y, z] = [0, 1, 2].map((axis) => places[3 * n + axis] / UNIT);
      const [right, ahead] = [cy * x + sy * z, cy * z - sy * x];
      const depth = cp * ahead + sp * y + view.distance;
      const down = cp * y - sp * ahead;
      return [width / 2 + (focal * right) / depth, height / 2 + (focal * down) / depth, depth];
    };
    const shown = Array.from({ length: data.points }, (_, n) => [n, ...place(n)]).filter(([, , , depth]) => depth > 0.05);
    shown.sort((a, b) => b[3] - a[3]);
    for (const [n, u, v, depth] of shown) {
      const size = Math.max(1, (0.012 * focal) / depth);
      context.fillStyle = `rgb(${colors[3 * n]},${colors[3 * n + 1]},${colors[3 * n + 2]})`;
      context.fillRect(u - size / 2, v - size / 2, size, size);
    }
    context.strokeStyle = "#3b7dd8";
    context.lineWidth = 1.5 * scale;
    context.beginPath();
    for (let camera = 0; camera < data.cameras; camera += 1) {
      // Its center, then the corners of its image in order.
      const corners = [0, 1, 2, 3, 4].map((k) => place(data.points + 5 * camera + k));
      if (corners.some(([, , depth]) => depth <= 0.05)) continue;
      for (const [from, to] of [[0, 1], [0, 2], [0, 3], [0, 4], [1, 2], [2, 3], [3, 4], [4, 1]]) {
        context.moveTo(corners[from][0], corners[from][1]);
        context.lineTo(corners[to][0], corners[to][1]);
      }
    }
    context.stroke();
  }

  function change(changed) {
    view = { ...view, ...changed };
    view.pitch = Math.min(1.5, Math.max(-1.5, view.pitch));
    view.distance = Math.min(20, Math.max(0.3, view.distance));
    if (!waiting) requestAnimationFrame(draw);
    waiting = true;
  }

  const KEYS = {
    ArrowLeft: () => ({ yaw: view.yaw - 0.1 }),
    ArrowRight: () => ({ yaw: view.yaw + 0.1 }),
    ArrowUp: () => ({ pitch: view.pitch - 0.1 }),
    ArrowDown: () => ({ pitch: view.pitch + 0.1 }),
    "+": () => ({ distance: view.distance / 1.2 }),
    "-": () => ({ distance: view.distance * 1.2 }),
    Home: () => HOME,
  };
  canvas.addEventListener("keydown", (event) => {
    const key = KEYS[event.key === "=" ? "+" : event.key];
    if (!key || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    change(key());
  });
  canvas.addEventListener("pointerdown", (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    change({ yaw: view.yaw + event.movementX / 150, pitch: view.pitch - event.movementY / 150 });
  });
  // The page scrolls past a view that nobody has chosen.
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas) return;
      event.preventDefault();
      change({ distance: view.distance * Math.exp(event.deltaY / 500) });
    },
    { passive: false },
  );
  new ResizeObserver(() => change({})).observe(canvas);
})
