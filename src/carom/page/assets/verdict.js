// Whether the theory holds for the impact that is shown, in one line that says why.

Carom.verdict = (() => {
  const { make } = Carom.elements;
  const MARKS = { ok: ["✓", "ok"], FAILS: ["✗", "fails"], "?": ["?", "unknown"] };
  const ORDER = ["FAILS", "?", "ok"]; // the first of these decides
  const line = document.getElementById("verdict");
  const NOT_HERE = "Not judged here: the program tells whether the theory holds.";
  const NO_BODIES = "Not judged: two numbers tell no bodies.";
  const WAITS = "Whether the theory holds is being judged …";
  const REFUSED = "Not judged: what is set is no impact that can be shown.";

  // Findings, those first that decide.
  const sorted = (findings) => [...findings].sort((a, b) => ORDER.indexOf(a.mark) - ORDER.indexOf(b.mark));

  // Why there is no verdict on an impact, "" if there is one. `pending` says that another is asked
  // for, which "waits" for its answer or is "refused": then what is still shown is not it.
  function missing(answer, pending = "") {
    if (!Carom.source.live) return NOT_HERE;
    if (pending === "refused") return REFUSED;
    if (pending || !answer) return WAITS;
    if (answer.findings) return answer.findings.length ? "" : NO_BODIES;
    return answer.unjudged ? `Not judged: ${answer.unjudged}` : WAITS;
  }

  function said(findings) {
    const [{ mark, plain }] = sorted(findings);
    if (mark === "ok") return [mark, "The theory holds here: all that it assumes is met."];
    const others = findings.filter((each) => each.mark === mark).length - 1;
    const more = others ? ` (and ${others} more)` : "";
    const begin = mark === "FAILS" ? "The theory does not hold here" : "Whether the theory holds is open";
    return [mark, `${begin}: ${plain}${more}.`];
  }

  function tell(mark, text) {
    const [sign, look] = MARKS[mark];
    const icon = make("span", { className: `carom-mark carom-${look}`, ariaHidden: "true" }, sign);
    line.replaceChildren(icon, ` ${text}`);
  }

  function show(answer, pending) {
    const why = missing(answer, pending);
    tell(...(why ? ["?", why] : said(answer.findings)));
  }

  return { show, missing, sorted };
})();
