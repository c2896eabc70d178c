"use strict";
// Shows a part of the path in the dark, for a picture.
(async () => {
  while (!document.documentElement.dataset.ready) await new Promise((done) => setTimeout(done, 5));
  document.getElementById("theme").click();
  const upto = document.getElementById("upto");
  upto.value = Math.round(upto.max * 0.6);
  upto.dispatchEvent(new Event("input"));
})();
