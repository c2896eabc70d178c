// The local server of `filpost studio`: files of the folder, and answers of the library.

/** Asks the server, JSON for JSON. */
async function ask(request) {
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

/** The back end of the page; `lost` is told when the server has ended. */
export function serverBackend(lost) {
  // The server ends when this connection does.
  const alive = new EventSource("alive");
  alive.onerror = () => lost(true);
  alive.onopen = () => lost(false);
  return {
    keeps: true,
    ask,
    list: () => ask({ do: "files" }),
    read: (name) => ask({ do: "read", name }),
    write: (name, text, { stamp, encoding }) => ask({ do: "write", name, text, stamp, encoding }),
    remove: (name, stamp) => ask({ do: "remove", name, stamp }),
  };
}
