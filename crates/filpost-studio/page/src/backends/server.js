// The local server of `filpost studio`: files of the folder, and answers of the library.
import { SentTexts } from "./texts.js";

const sent = new SentTexts();

/** Asks the server, with long texts by their names where it has them. */
async function ask(request) {
  const answer = await askAsItIs(sent.pack(request));
  if (!answer?.unkept && sent.unpack(answer)) return answer;
  sent.forget();
  return askAsItIs(request);
}

/** Asks the server, JSON for JSON. */
async function askAsItIs(request) {
  const response = await fetch("ask", {
    method: "POST",
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(request),
  });
  if (!response.ok) throw new Error(`the studio answers ${response.status}`);
  const answer = await response.json();
  if (answer?.failure) throw new Error(answer.failure);
  if (answer?.refused) throw new Error(answer.refused);
  return answer;
}

/** Pause between two looks at a request that is being answered, milliseconds. */
const LOOK = 300;

/** A request that tells `told` how much of it is done, 0 to 1, and can be stopped. */
function watched(request, told) {
  const ticket = crypto.randomUUID();
  let isOver = false, isStopped = false;
  const answer = ask({ ...request, ticket }).finally(() => (isOver = true));
  const look = async () => {
    if (isOver) return;
    const { share } = await ask({ do: isStopped ? "stop" : "watch", ticket }).catch(() => ({}));
    if (isOver) return;
    if (typeof share === "number") told(share);
    setTimeout(look, LOOK);
  };
  setTimeout(look, LOOK);
  const stop = () => {
    isStopped = true;
    // The request may not have come there yet: each look asks again.
    if (!isOver) ask({ do: "stop", ticket }).catch(() => null);
  };
  return { answer, stop, supersede: stop };
}

/** The back end of the page; `lost` is told when the server has ended. */
export function serverBackend(lost) {
  // The server ends when this connection does.
  const alive = new EventSource("alive");
  alive.onerror = () => lost(true);
  alive.onopen = () => lost(false);
  return {
    keeps: true,
    ask,
    watched,
    list: () => ask({ do: "files" }),
    read: (name) => ask({ do: "read", name }),
    write: (name, text, { stamp, encoding }) => ask({ do: "write", name, text, stamp, encoding }),
    remove: (name, stamp) => ask({ do: "remove", name, stamp }),
  };
}
