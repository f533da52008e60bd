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

  // The answer; where the program still prepares, how far it is, until it is ready.
  async function asked(address, options = {}, kind = "text") {
    for (;;) {
      const content = await once(address, options, kind);
      if (content.field === undefined) return content;
      if (!content.again) throw content; // it is refused, of this field
      document.getElementById("notice").textContent = content.message;
      await pause(content.again);
    }
  }

  function fit(request, signal) {
    if (request.data) return asked(`fit?${new URLSearchParams({ data: request.data })}`, { signal });
    const headers = { "Content-Type": "application/json" };
    return asked("fit", { method: "POST", headers, body: JSON.stringify(request), signal });
  }

  return {
    can: { laws: true, fit: true, files: true, code: true },
    why: "",
    answer: (query) => asked(`answer?${query}`),
    laws: (query, signal) => asked(`laws?${query}`, { signal }),
    fit,
    code: (query, signal) => asked(`view.py?${query}`, { signal }),
    written: (address) => asked(address, {}, "blob"),
    file: (name) => name,
  };
})();
