// Shows a crop large, and flips through the crops of its scene in one place. The page reads the same without it.
(() => {
  const dialog = document.createElement("dialog");
  if (!dialog.showModal) return;
  dialog.innerHTML = "<img alt=''><p><b></b><span>\u2190 \u2192 flip, click: next, Esc: close</span></p>";
  document.body.append(dialog);
  const [image, caption] = [dialog.querySelector("img"), dialog.querySelector("b")];
  let pictures = [], current = 0;

  const show = (index) => {
    current = (index + pictures.length) % pictures.length;
    const picture = pictures[current];
    image.src = picture.src;
    image.alt = picture.alt;
    caption.textContent = `${picture.closest(".crops").dataset.scene}: ${picture.dataset.caption}`;
  };
  const open = (picture) => {
    pictures = [...picture.closest(".crops").querySelectorAll("img")];
    show(pictures.indexOf(picture));
    dialog.showModal();
  };

  for (const picture of document.querySelectorAll(".crops img")) {
    picture.tabIndex = 0;
    picture.setAttribute("role", "button");
    picture.addEventListener("click", () => open(picture));
    picture.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") { event.preventDefault(); open(picture); }
    });
  }
  image.addEventListener("click", () => show(current + 1));
  dialog.addEventListener("click", (event) => { if (event.target === dialog) dialog.close(); });
  dialog.addEventListener("keydown", (event) => {
    if (event.key === "ArrowRight") show(current + 1);
    if (event.key === "ArrowLeft") show(current - 1);
  });
  for (const hint of document.querySelectorAll(".flip-hint")) hint.hidden = false;
})();
