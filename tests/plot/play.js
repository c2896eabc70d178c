"use strict";
// Shows a part of the path in the dark, for a picture.
(async () => {
  while (!document.documentElement.dataset.ready) await new Promise((done) => setTimeout(done, 5));
  document.getElementById("theme").click();
  // Without the way up at the end, which is three times as high as the part.
  const high = document.getElementById("high");
  high.value = 121;
  high.dispatchEvent(new Event("input"));
  document.querySelector("[data-view=iso]").click();
  const upto = document.getElementById("upto");
  upto.value = Math.round(upto.max * 0.6);
  upto.dispatchEvent(new Event("input"));
})();
