// Runs before anything is drawn: the reader's choice of colors, if it differs from the system's.
try {
  const chosen = localStorage.getItem("epipole-theme");
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset.theme = chosen;
} catch {
  // Storage may be forbidden; then the system decides.
}
