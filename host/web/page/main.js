// SPDX-License-Identifier: Apache-2.0
// The live page: says in words what the program sends.
import uPlot from "uplot";

const events = new EventSource("live");
events.addEventListener("state", (event) => {
  document.getElementById("state").textContent = `${JSON.parse(event.data).samples} samples; uPlot ${typeof uPlot}.`;
});
