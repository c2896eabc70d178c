"use strict";
// Measures the page in real time and says it on the console. Added to a page by the bench.
(async () => {
  const frame = () => new Promise(requestAnimationFrame);
  const over = document.getElementById("over");
  while (!document.documentElement.dataset.ready) await new Promise((done) => setTimeout(done, 5));
  const opened = performance.now();
  await frame();

  /** Longest and mean milliseconds between the frames of some hand movement. */
  async function hand(count, act) {
    let longest = 0;
    const start = await frame();
    let last = start;
    for (let step = 0; step < count; step++) {
      act(step);
      const now = await frame();
      longest = Math.max(longest, now - last);
      last = now;
    }
    return { longest, mean: (last - start) / count };
  }

  const box = over.getBoundingClientRect();
  const place = { clientX: box.left + box.width / 3, clientY: box.top + box.height / 3, bubbles: true, cancelable: true };
  const wheel = (deltaY) => over.dispatchEvent(new WheelEvent("wheel", { ...place, deltaY }));
  const move = (more) => over.dispatchEvent(new PointerEvent("pointermove", { ...place, ...more }));
  const zoom = await hand(60, (step) => wheel(step < 40 ? -60 : 120));
  const drag = await hand(30, () => move({ buttons: 1, movementX: 4, movementY: 2 }));
  const turn = await hand(30, () => move({ buttons: 1, shiftKey: true, movementX: 6, movementY: 3 }));
  const hover = await hand(30, (step) => move({ clientX: place.clientX + 5 * step }));
  console.log(`said: ${JSON.stringify({ opened, zoom, drag, turn, hover })}`);
})();
