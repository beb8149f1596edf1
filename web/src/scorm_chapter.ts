/**
 * Script of a chapter in a SCORM 1.2 package: hands what its page says in SPLICE messages to the
 * learning platform. Without a platform, the chapter works but nothing is stored.
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
  // The page reports at once.
  finishOnLeave(api, () => undefined);
}
// Not before this page listens.
frame.src = frame.dataset["src"]!;
