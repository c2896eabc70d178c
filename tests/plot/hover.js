"use strict";
// Points at a motion, for a picture.
(async () => {
  while (!document.documentElement.dataset.ready) await new Promise((done) => setTimeout(done, 5));
  document.querySelector("[data-view=xy]").click();
  const over = document.getElementById("over"), box = over.getBoundingClientRect();
  const pixels = document.getElementById("plot").getContext("2d").getImageData(0, 0, box.width, box.height).data;
  for (let at = 4 * Math.round(box.width) * 60; at < pixels.length; at += 4) {
    if (pixels[at] !== 18 || pixels[at + 1] !== 138 || pixels[at + 2] !== 74) continue;
    const x = at / 4 % box.width, y = Math.floor(at / 4 / box.width);
    over.dispatchEvent(new PointerEvent("pointermove", { bubbles: true, clientX: box.left + x, clientY: box.top + y }));
    return;
  }
})();
