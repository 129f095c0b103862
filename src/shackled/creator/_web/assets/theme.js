// The chosen theme, set before anything is painted.
try {
  document.documentElement.style.colorScheme = localStorage.getItem("theme") || "";
} catch { /* no storage */ }
