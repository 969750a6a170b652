// The viewer of a scene's crops: slider, side by side or flip; one zoom and place for both; exposure; error maps. The page reads without it.
(() => {
  const source = document.getElementById("colour-maps");
  if (!source) return;
  const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const colours = Object.fromEntries(Object.entries(JSON.parse(source.textContent)).map(([name, text]) => [name, bytesOf(text)]));

  // IEEE 754 binary16, little-endian.
  const floatsOf = (text) => {
    const words = new Uint16Array(bytesOf(text).buffer);
    return Float32Array.from(words, (w) => {
      const exponent = (w >> 10) & 31, fraction = w & 1023, sign = w & 0x8000 ? -1 : 1;
      return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
    });
  };
  const encoded = (v) => (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055) * 255 + 0.5;  // IEC 61966-2-1
  const clamped = (v) => Math.min(Math.max(v, 0), 1);
  const luminance = (d, i) => 0.212671 * d[3 * i] + 0.715160 * d[3 * i + 1] + 0.072169 * d[3 * i + 2];

  const start = (root) => {
    const data = JSON.parse(root.querySelector("script").textContent);
    const { width, height } = data;
    const reference = new Float32Array(bytesOf(data.reference).buffer);
    const scaled = (text) => text && floatsOf(text).map((v) => v * data.top);
    const images = data.images.map((image) => {
      const difference = scaled(image.difference) || new Float32Array(reference.length);
      return { label: image.label, difference, data: reference.map((v, i) => v + difference[i]), rmse: scaled(image.rmse), bias: image.bias && floatsOf(image.bias) };
    });
    const at = (name) => root.querySelector(`[data-part=${name}]`);
    const parts = Object.fromEntries(["left", "right", "show", "mode", "exposure", "stops", "zoom", "stage", "divider", "divide", "legend", "window", "reset", "status"].map((n) => [n, at(n)]));
    const [first, second] = parts.stage.querySelectorAll("canvas");
    const state = { zoom: 1, x: width / 2, y: height / 2, flipped: false };

    for (const select of [parts.left, parts.right])
      images.forEach((image, i) => select.append(new Option(image.label, i)));
    parts.left.value = images.length > 2 ? 1 : 0;
    parts.right.value = data.right;

    // One pixel of the crop is one pixel of this; drawImage enlarges it.
    const developed = (image) => {
      const pixels = new ImageData(width, height), show = parts.show.value, gain = 2 ** Number(parts.exposure.value);
      const values = show === "rmse" ? image.rmse : show === "bias" ? image.bias : null;
      for (let i = 0; i < width * height; ++i) {
        let rgb;
        if (show === "image") {
          rgb = [0, 1, 2].map((c) => encoded(clamped(image.data[3 * i + c] * data.exposure * gain)));
        } else {
          const value = show === "error" ? Math.abs(luminance(image.difference, i)) : values ? values[i] : 0;
          const place = show === "bias" ? value / 8 + 0.5 : (value / data.top) * gain;
          const entry = 3 * Math.round(clamped(place) * 255), map = show === "bias" ? colours.bias : colours.error;
          rgb = [map[entry], map[entry + 1], map[entry + 2]];
        }
        pixels.data.set([rgb[0], rgb[1], rgb[2], 255], 4 * i);
      }
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [width, height];
      canvas.getContext("2d").putImageData(pixels, 0, 0);
      return canvas;
    };
    const draw = (canvas, image) => {
      const side = canvas.clientWidth * (window.devicePixelRatio || 1);
      [canvas.width, canvas.height] = [Math.round(side), Math.round(side * height / width)];
      const context = canvas.getContext("2d"), scale = canvas.width / width * state.zoom;
      context.imageSmoothingEnabled = false;
      context.drawImage(developed(image), canvas.width / 2 - state.x * scale, canvas.height / 2 - state.y * scale, width * scale, height * scale);
    };
    const place = () => {  // what is seen stays inside the crop
      state.zoom = Math.min(Math.max(state.zoom, 1), 16);
      const [w, h] = [width / state.zoom / 2, height / state.zoom / 2];
      state.x = Math.min(Math.max(state.x, w), width - w);
      state.y = Math.min(Math.max(state.y, h), height - h);
    };
    const refresh = () => {
      place();
      const mode = parts.mode.value, [left, right] = [parts.left, parts.right].map((s) => images[Number(s.value)]);
      parts.stage.dataset.mode = mode;
      parts.divide.hidden = mode !== "slider";
      draw(first, mode === "flip" && state.flipped ? right : left);
      if (mode !== "flip") draw(second, right);
      const cut = Number(parts.divide.value);
      second.style.clipPath = mode === "slider" ? `inset(0 0 0 ${cut}%)` : "";
      parts.divider.style.left = `${cut}%`;
      const stops = Number(parts.exposure.value);
      parts.stops.textContent = `${stops > 0 ? "+" : ""}${stops.toFixed(2)} stops`;
      parts.zoom.textContent = `${state.zoom.toFixed(1)}\u00d7`;
      const show = parts.show.value, end = (data.top / 2 ** stops).toPrecision(2);
      parts.legend.textContent = { image: "", error: `black: 0, light: ${end} (luminance, this one render)`, rmse: `black: 0, light: ${end} (RMSE over replicates)`,
        bias: "blue: \u22124, red: +4 standard errors" }[show];
      const seen = mode === "flip" ? (state.flipped ? right : left).label : `${left.label} | ${right.label}`;
      parts.status.textContent = seen;
      parts.stage.setAttribute("aria-label", `${root.dataset.scene}: ${seen}`);
    };
    const zoomed = (factor) => { state.zoom *= factor; refresh(); };
    const moved = (dx, dy) => { state.x += dx; state.y += dy; refresh(); };
    const flipped = () => { state.flipped = !state.flipped; refresh(); };
    const stopped = (by) => { parts.exposure.value = Number(parts.exposure.value) + by; refresh(); };
    const reset = () => { Object.assign(state, { zoom: 1, flipped: false }); parts.exposure.value = 0; parts.divide.value = 50; refresh(); };
    const to_window = () => {
      const [x, y, w, h] = data.window;
      Object.assign(state, { zoom: Math.min(width / w, height / h), x: x + w / 2, y: y + h / 2 });
      refresh();
    };

    for (const name of ["left", "right", "show", "mode", "exposure", "divide"]) parts[name].addEventListener("input", refresh);
    at("in").addEventListener("click", () => zoomed(1.5));
    at("out").addEventListener("click", () => zoomed(1 / 1.5));
    at("swap").addEventListener("click", () => { [parts.left.value, parts.right.value] = [parts.right.value, parts.left.value]; refresh(); });
    parts.reset.addEventListener("click", reset);
    if (data.window) parts.window.addEventListener("click", to_window); else parts.window.hidden = true;

    const keys = { "+": () => zoomed(1.5), "=": () => zoomed(1.5), "-": () => zoomed(1 / 1.5), 0: reset, f: () => { parts.mode.value = "flip"; flipped(); },
      "]": () => stopped(0.5), "[": () => stopped(-0.5), w: () => data.window && to_window(), ArrowLeft: () => moved(-4 / state.zoom, 0), ArrowRight: () => moved(4 / state.zoom, 0),
      ArrowUp: () => moved(0, -4 / state.zoom), ArrowDown: () => moved(0, 4 / state.zoom) };
    parts.stage.addEventListener("keydown", (event) => {
      const action = keys[event.key];
      if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      action();
    });
    // Dragging moves the divider where there is one to move, else the place; a click flips.
    let from = null;
    parts.stage.addEventListener("pointerdown", (event) => { from = { x: event.clientX, y: event.clientY, far: 0 }; parts.stage.setPointerCapture(event.pointerId); });
    parts.stage.addEventListener("pointermove", (event) => {
      if (!from) return;
      const box = first.getBoundingClientRect(), [dx, dy] = [event.clientX - from.x, event.clientY - from.y];
      from = { x: event.clientX, y: event.clientY, far: from.far + Math.abs(dx) + Math.abs(dy) };
      if (parts.mode.value === "slider" && !event.shiftKey) { parts.divide.value = 100 * (event.clientX - box.left) / box.width; refresh(); }
      else moved(-dx * width / box.width / state.zoom, -dy * height / box.height / state.zoom);
    });
    parts.stage.addEventListener("pointerup", () => { if (from && from.far < 4 && parts.mode.value === "flip") flipped(); from = null; });
    parts.stage.addEventListener("wheel", (event) => {  // only with the stage in focus: else the page scrolls
      if (document.activeElement !== parts.stage) return;
      event.preventDefault();
      zoomed(event.deltaY < 0 ? 1.2 : 1 / 1.2);
    }, { passive: false });
    new ResizeObserver(refresh).observe(parts.stage);
    root.hidden = false;
    refresh();
    return (label) => { parts.right.value = images.findIndex((image) => image.label === label); refresh(); root.scrollIntoView({ block: "center" }); parts.stage.focus({ preventScroll: true }); };
  };

  for (const root of document.querySelectorAll(".viewer")) {
    const choose = start(root);
    for (const picture of root.closest("section").querySelectorAll("img[data-image]")) {
      picture.tabIndex = 0;
      picture.setAttribute("role", "button");
      picture.addEventListener("click", () => choose(picture.dataset.image));
      picture.addEventListener("keydown", (event) => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); choose(picture.dataset.image); } });
    }
  }
})();
