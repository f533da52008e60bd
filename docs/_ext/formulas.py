r"""Formulas in the docstrings of the reference: plain text in a terminal, mathematics on a page.

`psi_1 = kappa V_x/(mu V_1)` becomes :math:`\psi_1 = \kappa V_x/(\mu V_1)`. An equation that stands
alone in an indented block is displayed. Names with underscores that are no symbols become code.
"""

import re
from itertools import groupby
from typing import Any

from carom.quantities.glossary import GLOSSARY

GREEK = (
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|phi|chi"
    "|psi|omega|Gamma"
)
VARIABLES = "|".join(name for name in GLOSSARY if re.search(r"_\w\w", name))
SYMBOL = (  # a letter, with d before it, an index, stars or primes behind it
    rf"(?<!\w\.)(?!(?:{VARIABLES})\b)(?:d(?=[AC-Z](?![^\W_])|[qstuwxz]\b))?(?:{GREEK}|[A-Za-z])"
    r"(?:_(?:max|min|eff|[A-Za-z0-9]{1,2}))?\*{0,2}'{0,2}(?![\w*]|'(?!s\b)|\.[a-z])"
)
NAMES = "exp|log|sin|cos|tan|min|max|sum"
ATOM = re.compile(  # what stands before a factor, or a factor without brackets
    rf"(?P<before>(?:integral\s+of|int(?:_\w+\^\w+)?)\s+|sqrt(?=\()"
    rf"|(?:{NAMES}|ln|asin|acos|atan|Im|Re)(?:\^\d)?"
    rf"(?:(?=[(\[])|\s+(?=(?:[\d.]+[ /])?[A-Za-z(|])))"
    rf"|\d+(?:\.\d+)?(?:e[+-]?\d+)?(?![\w%])|{SYMBOL}"
)
POWER = re.compile(r"\^-?(?=[\w(])")
CLOSING = {"(": ")", "[": "]", "|": "|"}
LINK = re.compile(  # between two factors; a product begins behind some
    r"(?P<begins>\s*[<>]?=\s*-?|\s*[<>]\s*-?|\s+(?:\+-|-\+|[+-])\s+)|(?P<comma>[,;]\s+-?)"
    r"|(?P<sign>\s*/\s*|\s+[x.]\s+(?=[\w(|]))|\s*"
)
ARTICLE = re.compile(r"[aAI]\s+(?!(?:and|for|in|of|or|where|while|with)\b)[A-Za-z]")
SURE = re.compile(  # what no sentence has
    rf"\b(?:{GREEK})(?![^\W_])|[A-Za-z](?:_|\*|')|[=<>|^]|(?<!\d)/|/(?!\d)|\s[+-]+\s|\s[x.]\s|[\w)\]][(\[]"
)
INNER = r"(?:[^()]|\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\))*"  # with brackets in brackets
ASIDE = re.compile(  # a bracket with a relation, a comma or no letter
    rf"[(\[](?!(?=[^)]*[A-Za-z])(?:[^()=<>,;]|\({INNER}\))*[)\]])"
)
TEX = (  # one after the other
    (r"\s+", " "),
    (rf"(?<=[^\s<>=+-])(?<!{NAMES}) x (?=[\w(|])", r" \\times "),
    (r" \. ", r" \\cdot "),
    (r"\bint(?:egral of)?(?=[ _])", r"\\int"),
    (r"\ba(sin|cos|tan)(?=\W)", r"\\arc\1"),
    (r"\b(Im|Re)(?=\W)", r"\\mathrm{\1}"),
    (rf"\b({NAMES}|ln)(?=\W)", r"\\\1"),
    (rf"\b({GREEK})(?![^\W_])", r"\\\1"),
    (r"_(max|min)", r"_{\\\1}"),
    ("_eff", r"_{\\mathrm{eff}}"),
    (r"_(\w\w)\b", r"_{\1}"),
    (r"(?<!\*)\*\^(\d+)", r"^{*\1}"),
    (r"(?<![*{])\*(?!\*)", "^*"),
    (r"(?<![*{])\*\*", "^{**}"),
    (r"(?<![\w.])1e\+?(-?)0*(\d+)", r"10^{\1\2}"),
    (r"(?<=\d)e\+?(-?)0*(\d+)\b", r" \\times 10^{\1\2}"),
    (r"(?<=[\w)\]}'*]) (?=d[A-Za-z]\b)", r" \\, "),
    (r" ?/ ?", "/"),
    (r" ?<= ?", r" \\le "),
    (r" ?>= ?", r" \\ge "),
    (r"\+-", r"\\pm"),
    (r"-\+", r"\\mp"),
    (r"\|([^|]*)\|", r"\\lvert \1\\rvert"),
    (r"\^(-?\d+\.\d+|-\w+|\w{2,})", r"^{\1}"),
    (rf"\^(-?)\(({INNER})\)", r"^{\1\2}"),
    *[(rf"\bsqrt\(({INNER})\)", r"\\sqrt{\1}")] * 2,  # a root in a root
)
UNIT = r"(?:[kM]?Pa|[kM]?N|[cmun]?m|[mu]?s|[mk]?J|[kmu]?g|rad|Hz)\b(?:\^-?\d+(?:\.\d+)?)?"
QUANTITY = re.compile(
    r"(?P<number>\d[\d.]*(?:e-?\d+)? )?"
    rf"(?P<unit>(?:1/)?{UNIT}(?:[ /]{UNIT}|/\({UNIT}(?: {UNIT})*\))*(?![\w^/(*']))"
)
WORD = re.compile(r"(?P<code>(?<![./:-])\w*_\w+)|[^\W\d][\w']*|[\d.,]*\d|[^\w]|\w")
NO_PROSE = re.compile(  # examples, fields and heads of parameters, code, roles, texts, emphasis
    r"(?m)(^ *(?:>>> .*(?:\n.+)*|:\w*type\b[^:\n]*:.*|:\w+(?: [^:\n]+)?:(?= |$)"
    r"|[\w*]+(?:, [\w*]+)* : \S.*)"
    r"|\bshapes? \([^)]*\)|``.+?``|(?::\w+)+:`[^`]*`|`[^`]*`|\"[^\"\n]{1,60}\""
    r"|(?<![\w*])\*{1,2}[A-Za-z][^*\n]*\*{1,2}(?!\w)|\$[^$\n]+\$)"
)


def formula(text: str, at: int, within: bool = False) -> int:
    """Return where a formula that begins here ends, 0 if none does; commas are within brackets."""
    end, at = 0, at + text.startswith("-", at)
    link = LINK.match("= ")
    while last := 0 if is_prose(text, at, link) else factor(text, at):
        end = last
        link = LINK.match(text, end)
        if link["comma"] and not within:
            break
        at = link.end()
    return end


def is_prose(text: str, at: int, link: re.Match[str]) -> bool:
    """Return whether words go on behind what links factors, and no formula."""
    if not link["sign"] and ARTICLE.match(text, at):  # an article, or the contact radius
        return bool(link.lastgroup or re.match(r"a\s+[a-z]+\b", text[at:]))
    aside = link[0] and ASIDE.match(text, at)
    return not link.lastgroup and bool(aside or text[at : at + 1].isdigit())


def factor(text: str, at: int) -> int:
    """Return where a number, a symbol, a function or a bracket ends, with its power; or 0."""
    if atom := ATOM.match(text, at):
        end = factor(text, atom.end()) if atom["before"] else atom.end()
    elif close := CLOSING.get(text[at : at + 1]):
        end = formula(text, at + 1, within=close != "|")
        end = end + 1 if end and text[end : end + 1] == close else 0
    else:
        return 0
    power = POWER.match(text, end)
    return factor(text, power.end()) if end and power else end


def latex(text: str) -> str:
    r"""Return a formula in LaTeX.

    >>> print(latex("2.5e-10 sqrt(R* d_max) <= psi_1^(1/5)"))
    2.5 \times 10^{-10} \sqrt{R^* d_{\max}} \le \psi_1^{1/5}
    """
    for pattern, replacement in TEX:
        text = re.sub(pattern, replacement, text)
    return text


def marked(text: str) -> str:
    """Return a text with roles for its formulas and names, each between two marks; |x| stays."""
    done, at = "", 0
    while at < len(text):
        end = 0 if text.startswith("integral", at) else formula(text, at)
        quantity, part = QUANTITY.match(text, at), text[at:end]
        if quantity and end <= quantity.end():
            number, unit = quantity.groups("")
            power = re.sub(r"\^(-?[\d.]*\d)", r"^{\1}", unit).replace(" ", r"\,")
            done += number + (f"\1:math:`\\mathrm{{{power}}}`\2" if "^" in power else unit)
            at = quantity.end()
        elif SURE.search(part) and re.search(r"(?<!\d)[A-Za-z]", part):
            done += f"\1:math:`{latex(part)}`\2"
            at = end
        else:
            word = WORD.match(text, at)
            done += f"\1``{word[0]}``\2" if word["code"] else word[0].replace("|", r"\|")
            at = word.end()
    return done


def inline(text: str) -> str:
    r"""Return prose with roles for its formulas.

    >>> print(inline("psi_2 to 1e-10 max(1, |psi_1|), spin_out; `psi_2` is code"))
    :math:`\psi_2` to :math:`10^{-10} \max(1, \lvert \psi_1\rvert)`, ``spin_out``; `psi_2` is code
    """
    pieces = NO_PROSE.split(text)
    pieces[::2] = map(marked, pieces[::2])
    pieces[1::2] = [re.sub(r"^\$(.*)\$$", r":math:`\1`", piece) for piece in pieces[1::2]]
    said = re.sub("(?<=[\\w\2])\1|\2(?=[\\w\\\\(])", r"\\ ", "".join(pieces))  # else a role is none
    return re.sub("[\1\2]", "", said)


def equation(text: str) -> str:
    r"""Return a line as a displayed equation, with its words as text; empty if it is none.

    >>> print(equation("F_n = k_n d while loading, F_t = k_t U"))
    F_n = k_n d\text{ while loading},\quad F_t = k_t U
    """
    plain = re.sub("\1``|``\2", "", marked(text.rstrip(".,;")))
    pieces = re.split("\1:math:`|`\2", plain)
    for at in range(0, len(pieces), 2):
        words = re.sub(r"[^,;]*[^,;\s][^,;]*", r"\\text{\g<0>}", pieces[at].replace("%", r"\%"))
        pieces[at] = re.sub(r"([,;])(\\text\{)? ", r"\1\\quad \2", words)
    return "".join(pieces) if pieces[1:] else ""


def equations(lines: list[str]) -> list[str]:
    """Return an indented block as displayed equations, nothing if it holds anything else."""
    further = rf"\n {{{depth(lines[0]) + 1},}}"  # goes on where the line above ends
    rows = re.sub(further, " ", "\n".join(lines)).split("\n")
    shown = [equation(row.strip()) for row in rows]
    if "`" in "".join(rows) or not all(shown):
        return []
    if len(shown) > 1:  # one below the other at their first relation
        shown = [re.sub(r" (?=(?:=|\\le|\\ge|<|>) )", " & ", row, count=1) for row in shown]
    return [".. math::", "", *(line for row in shown for line in (f"   {row}", ""))]


def depth(line: str) -> int:
    return len(line) - len(line.lstrip())


def convert(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with mathematics for its formulas."""
    done: list[str] = []
    above, literal = "", None  # how deep a directive, or what ends with "::", begins
    for blank, found in groupby(lines, key=lambda line: not line.strip()):
        group = [*found]
        first = group[0]
        if blank or (literal is not None and depth(first) > literal):
            done += group
            continue
        directive = first.lstrip().startswith(".. ")
        literal = depth(first) if directive or group[-1].endswith("::") else None
        alone = depth(first) > depth(above) and above.lstrip()[:1] not in (":", ".")
        if shown := equations(group) if alone and not directive else []:
            done += [f"{' ' * depth(above)}{row}".rstrip() for row in shown]
        else:
            done += group if directive else inline("\n".join(group)).split("\n")
        above = first
    return done


def process(app: Any, what: str, name: str, thing: Any, options: Any, lines: list[str]) -> None:
    """Convert a docstring of the reference."""
    lines[:] = convert(lines)


def setup(app: Any) -> dict[str, Any]:
    app.connect("autodoc-process-docstring", process, priority=901)  # after the glossary's words
    return {"parallel_read_safe": True}
