// Answers of the live page: the server that sent it.

Carom.source = (() => {
  const GONE = { field: "", message: "The page has lost its program. Start it again: carom explore" };

  const pause = (seconds) => new Promise((done) => window.setTimeout(done, 1000 * seconds));

  // What is at an address, read once: JSON as what it says, all else as `kind`.
  // A busy server may refuse a connection, or close it for another: it is asked again before its
  // refusal is told, or it is taken for gone.
  async function once(address, options, kind, tries = 3) {
    try {
      const answer = await fetch(address, options);
      const json = answer.headers.get("Content-Type") === "application/json";
      const content = await (json ? answer.json() : answer[answer.ok ? kind : "text"]());
      if (answer.ok || json) return content;
      const refusal = { field: "", message: content.replace(/^carom: /, "").trim() };
      if (answer.status !== 503 || tries === 1) return refusal;
    } catch (error) {
      if (error.name === "AbortError") throw error;
      if (tries === 1) throw GONE;
    }
    await pause(0.3);
    return once(address, options, kind, tries - 1);
  }

  // The answer, or what is refused of a field.
  async function asked(address, options = {}, kind = "text") {
    const content = await once(address, options, kind);
    if (content.field !== undefined) throw content;
    return content;
  }

  function fit(request, signal) {
    if (request.data) return asked(`fit?${new URLSearchParams({ data: request.data })}`, { signal });
    const headers = { "Content-Type": "application/json" };
    return asked("fit", { method: "POST", headers, body: JSON.stringify(request), signal });
  }

  return {
    live: true,
    number: async (name, text) => (await asked(`number?${new URLSearchParams({ name, text })}`)).value,
    verdict: async (query, signal) => (await asked(`verdict?${query}`, { signal })).findings,
    laws: ({ query }, signal) => asked(`laws?${query}`, { signal }),
    fit,
    code: (query, signal) => asked(`view.py?${query}`, { signal }),
    written: (address) => asked(address, {}, "blob"),
    file: (name) => name,
  };
})();
