/**
 * Script of a chapter in a SCORM 1.2 package: forwards the page's SPLICE messages to the learning platform. Without a
 * platform, the chapter works but nothing is stored.
 */

import { findApi, finishOnLeave, record } from "./scorm_api.js";
import { recordOf } from "./splice.js";

const frame = document.querySelector("iframe")!;
const api = findApi();
if (api) {
  addEventListener("message", ({ source, data }) => {
    const message = source === frame.contentWindow ? recordOf(data) : undefined;
    if (message?.["subject"] === "SPLICE.reportScoreAndState") record(api, message["state"], Number(message["score"]));
    if (message?.["subject"] !== "SPLICE.getState") return;
    const state = api.LMSGetValue("cmi.suspend_data");
    const answer = { subject: "SPLICE.getState.response", message_id: message["message_id"], state };
    frame.contentWindow?.postMessage(answer, "*");
  });
  // The page reports immediately, so nothing is left to store.
  finishOnLeave(api, () => undefined);
}
// Only now, since this page must listen first.
frame.src = frame.dataset["src"]!;
