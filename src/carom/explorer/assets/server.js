// Answers of the live page: the server that sent it.
window.Carom = window.Carom || {};

Carom.source = (() => {
  const GONE = { field: "", message: "The page has lost its program. Start it again: carom explore" };

  const pause = (seconds) => new Promise((done) => window.setTimeout(done, 1000 * seconds));

  async function once(address, options) {
    try {
      return await fetch(address, options);
    } catch (error) {
      throw error.name === "AbortError" ? error : GONE;
    }
  }

  // What a refusal says: of which field, and after how many seconds to ask again, if at all.
  async function refusal(answer) {
    const text = await answer.clone().text();
    try {
      const told = JSON.parse(text);
      return "field" in told ? told : null;
    } catch {
      return answer.ok ? null : { field: "", message: text.replace(/^carom: /, "").trim() };
    }
  }

  // The answer; where the program still prepares, how far it is, until it is ready.
  async function asked(address, options) {
    for (;;) {
      const answer = await once(address, options);
      const told = await refusal(answer);
      if (!told) return answer;
      if (!told.again) throw told;
      document.getElementById("notice").textContent = told.message;
      await pause(told.again);
    }
  }

  const json = async (address, options) => (await asked(address, options)).json();

  function fit(request, signal) {
    if (request.data) return json(`fit?${new URLSearchParams({ data: request.data })}`, { signal });
    const headers = { "Content-Type": "application/json" };
    return json("fit", { method: "POST", headers, body: JSON.stringify(request), signal });
  }

  return {
    can: { laws: true, fit: true, files: true, code: true },
    why: "",
    answer: (query, signal) => json(`answer?${query}`, { signal }),
    laws: (query, signal) => json(`laws?${query}`, { signal }),
    fit,
    code: async (query, signal) => (await asked(`view.py?${query}`, { signal })).text(),
    file: (name) => name,
  };
})();
