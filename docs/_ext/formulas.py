r"""Formulas in the docstrings of the reference: plain text in a terminal, mathematics on a page.

`psi_1 = kappa V_x/(mu V_1)` becomes :math:`\psi_1 = \kappa V_x/(\mu V_1)`. An equation that stands
alone in an indented block is displayed. Names with underscores that are no symbols become code.
"""

import re
from collections.abc import Iterator
from itertools import groupby
from typing import Any, NamedTuple

from carom.quantities.glossary import GLOSSARY

GREEK = (
    "alpha|beta|gamma|delta|epsilon|zeta|eta|theta|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|phi|chi"
    "|psi|omega"
)
SYMBOL = re.compile(  # a letter, with d before it, an index, stars or primes behind it
    rf"(?<!\w\.)(?P<d>d(?=[AC-Z](?![^\W_])|[qstuwxz]\b))?(?P<base>{GREEK}|[A-Za-z])"
    r"(?:_(?P<index>max|min|eff|[A-Za-z0-9]{1,2}))?(?P<stars>\*{0,2})(?P<primes>'{0,2})"
    r"(?![\w*]|'(?!s\b)|\.[a-z])"
)
NUMBER = re.compile(r"(\d+(?:\.\d+)?)(?:e([+-]?)0*(\d+))?(?![\w%])")
FUNCTIONS = {
    **{name: rf"\{name}" for name in ("exp", "log", "ln", "sin", "cos", "tan", "min", "max")},
    **{"asin": r"\arcsin", "acos": r"\arccos", "atan": r"\arctan", "sqrt": r"\sqrt"},
    **{"Im": r"\mathrm{Im}", "Re": r"\mathrm{Re}", "sum": r"\sum"},
}
FUNCTION = re.compile(rf"({'|'.join(FUNCTIONS)})(\^\d)?(?:(?=([(\[]))|\s+)")
INTEGRAL = re.compile(r"(?:integral\s+of|int(_\w+\^\w+)?)\s+")
RELATION = re.compile(r"\s*(<=|>=|=|<|>)\s*")
SIGN = re.compile(r"\s+(\+-|-\+|[+-])\s+")
BETWEEN = re.compile(r"\s*(/)\s*|\s+([x.])\s+(?=[\w(|])|(\s*)")
TEX = {"<=": r"\le", ">=": r"\ge", "+-": r"\pm", "-+": r"\mp", "x": r"\times", ".": r"\cdot"}
POWER = re.compile(r"\^(-?)(?=[\w(])")
COMMA = re.compile(r"([,;])\s+")
CLOSING = {"(": ")", "[": "]", "|": "|"}
ARTICLE = re.compile(r"[aAI]\s+(?!(?:and|for|in|of|or|where|while|with)\b)[A-Za-z]")
UNIT = r"(?:[kM]?Pa|[kM]?N|[cmun]?m|[mu]?s|[mk]?J|[kmu]?g|rad|Hz)\b(?:\^-?\d+(?:\.\d+)?)?"
UNITS = re.compile(rf"(?:1/)?{UNIT}(?:[ /]{UNIT}|/\({UNIT}(?: {UNIT})*\))*(?![\w^/(*'])")
MEASURED = re.compile(rf"\d[\d.]*(?:e-?\d+)? (?=({UNITS.pattern}))")
IDENTIFIER = re.compile(r"(?<![./:-])\w*_\w+")
WORD = re.compile(r"[^\W\d][\w']*|[\d.,]*\d|[^\w]|\w")
NO_PROSE = re.compile(  # examples, fields and heads of parameters, code, roles, texts, emphasis
    r"(?m)^ *(?:>>> .*(?:\n.+)*|:\w*type\b[^:\n]*:.*|:\w+(?: [^:\n]+)?:(?= |$)"
    r"|[\w*]+(?:, [\w*]+)* : \S.*)"
    r"|\bshapes? \([^)]*\)|``.+?``|(?::\w+)+:`[^`]*`|`[^`]*`|\"[^\"\n]{1,60}\""
    r"|(?<![\w*])\*{1,2}[A-Za-z][^*\n]*\*{1,2}(?!\w)|\$[^$\n]+\$"
)


class Piece(NamedTuple):
    """A part of a formula: its LaTeX, where it ends in the text, and what it holds."""

    tex: str
    end: int
    letters: bool = False  # symbols
    sure: bool = False  # what no sentence has
    flat: bool = True  # neither a relation nor a comma

    def then(self, between: str, other: "Piece", *, signs: bool = True) -> "Piece":
        """Return both as one piece; signs between letters make a formula."""
        letters = self.letters or other.letters
        sure = self.sure or other.sure or (signs and letters)
        return Piece(f"{self.tex}{between}{other.tex}", other.end, letters, sure)


def relations(text: str, at: int) -> Piece | None:
    """Read sums with relations between them."""
    whole = terms(text, at)
    while whole and (sign := RELATION.match(text, whole.end)):
        if not (right := terms(text, sign.end())):
            break
        whole = whole.then(f" {TEX.get(sign[1], sign[1])} ", right)._replace(flat=False)
    return whole


def terms(text: str, at: int) -> Piece | None:
    """Read a sum, which may begin with a minus."""
    minus = text.startswith("-", at)
    whole = product(text, at + minus)
    if whole and minus:
        whole = whole._replace(tex=f"-{whole.tex}")
    while whole and (sign := SIGN.match(text, whole.end)):
        if not (right := product(text, sign.end())):
            break
        whole = whole.then(f" {TEX.get(sign[1], sign[1])} ", right)
    return whole


def product(text: str, at: int) -> Piece | None:
    """Read factors, one after the other, or with a slash, a cross or a dot between them."""
    whole = None if ARTICLE.match(text, at) else factor(text, at)
    while whole and whole.flat:
        gap = BETWEEN.match(text, whole.end)
        sign, space = gap[1] or gap[2], gap[3]
        right = factor(text, gap.end())
        if not right or not (sign or follows(text, right, gap.end())):
            break
        between = "/" if sign == "/" else f" {TEX[sign]} " if sign else " " if space else ""
        if not sign and re.match(r"d[A-Za-z]\b", right.tex):
            between = r" \, "
        whole = whole.then(between, right, signs=not space)
    return whole


def follows(text: str, right: Piece, at: int) -> bool:
    """Return whether a factor may stand behind another with no sign between them."""
    if ARTICLE.match(text, at):  # an article, or the contact radius
        return not re.match(r"a\s+[a-z]+\b", text[at:])
    if text[at] in "([" and text[at - 1].isspace():
        return right.flat and right.letters
    return not text[at].isdigit()


def factor(text: str, at: int) -> Piece | None:
    """Read a number, a symbol, a function or what stands in parentheses, and its power."""
    if found := INTEGRAL.match(text, at):
        inner = product(text, found.end())
        return inner and inner._replace(tex=rf"\int{found[1] or ''} {inner.tex}", sure=True)
    if found := FUNCTION.match(text, at):
        return function(text, found)
    if found := NUMBER.match(text, at):
        whole = Piece(digits(*found.groups()), found.end())
    else:
        whole = bracket(text, at) if text[at : at + 1] in CLOSING else symbol(text, at)
    if whole and (found := POWER.match(text, whole.end)):
        raised = factor(text, found.end())
        if not raised:
            return None
        power = found[1] + (raised.tex[1:-1] if raised.tex.startswith("(") else raised.tex)
        tex = f"{whole.tex}^{{{power}}}" if power[1:] else f"{whole.tex}^{power}"
        whole = Piece(tex, raised.end, whole.letters or raised.letters, whole.letters)
    return whole


def function(text: str, found: re.Match[str]) -> Piece | None:
    """Read the argument of a function, in parentheses or simply behind it."""
    name, power, close = found.groups()
    inner = (bracket if close else product)(text, found.end())
    if not inner or not (close or (inner.letters and name != "sqrt")):
        return None
    argument = f"{{{inner.tex[1:-1]}}}" if name == "sqrt" else inner.tex
    tex = f"{FUNCTIONS[name]}{power or ''}{'' if close else ' '}{argument}"
    return Piece(tex, inner.end, letters=True, sure=bool(close) or inner.sure)


def bracket(text: str, at: int) -> Piece | None:
    """Read what stands in parentheses, commas between its parts, or between bars."""
    close = CLOSING[text[at]]
    whole = relations(text, at + 1)
    while whole and close != "|" and (comma := COMMA.match(text, whole.end)):
        right = relations(text, comma.end())
        whole = right and whole.then(f"{comma[1]} ", right, signs=False)._replace(flat=False)
    if not whole or text[whole.end : whole.end + 1] != close:
        return None
    if close == "|":
        tex = rf"\lvert {whole.tex}\rvert"
        return whole._replace(tex=tex, end=whole.end + 1, sure=whole.letters)
    return whole._replace(tex=f"{text[at]}{whole.tex}{close}", end=whole.end + 1)


def symbol(text: str, at: int) -> Piece | None:
    """Read a Greek letter or a single one of ours, with what belongs to it."""
    found = SYMBOL.match(text, at)
    if not found:
        return None
    base, index, stars = found["base"], found["index"] or "", found["stars"]
    if index[1:] and found[0] in GLOSSARY:
        return None  # the name of a variable
    tex = (found["d"] or "") + (rf"\{base}" if base[1:] else base)
    if index:
        word = {"max": r"\max", "min": r"\min", "eff": r"\mathrm{eff}"}.get(index, index)
        tex += f"_{{{word}}}" if index[1:] else f"_{index}"
    if stars:
        tex += f"^{{{stars}}}" if stars[1:] else "^*"
    sure = bool(base[1:] or index or stars or found["primes"])
    return Piece(tex + found["primes"], found.end(), letters=True, sure=sure)


def digits(mantissa: str, sign: str | None, exponent: str | None) -> str:
    r"""Return a number in LaTeX.

    >>> print(digits("1", "-", "10"), digits("2.5", "", "3"), digits("0.05", None, None))
    10^{-10} 2.5 \times 10^{3} 0.05
    """
    if exponent is None:
        return mantissa
    power = f"10^{{{'-' if sign == '-' else ''}{exponent}}}"
    return power if mantissa == "1" else rf"{mantissa} \times {power}"


def parts(text: str) -> Iterator[tuple[str, str]]:
    """Yield the parts of a text with what they are: `text`, `code`, or `math` in LaTeX."""
    at = 0
    while at < len(text):
        units, name = UNITS.match(text, at), IDENTIFIER.match(text, at)
        whole = None if text.startswith("integral", at) else relations(text, at)
        measured = MEASURED.match(text, at)
        if measured and whole and whole.end <= measured.end(1):
            yield "text", measured[0]
            at = measured.end()
        elif units and (not whole or whole.end <= units.end()):
            power = re.sub(r"\^(-?[\d.]*\d)", r"^{\1}", units[0])
            shown = rf"\mathrm{{{power}}}".replace(" ", r"\,")
            yield ("math", shown) if "^" in power else ("text", units[0])
            at = units.end()
        elif whole and whole.sure:
            yield "math", whole.tex
            at = whole.end
        else:
            found = name or WORD.match(text, at)
            yield "code" if name else "text", found[0]
            at = found.end()


def inline(text: str) -> str:
    r"""Return prose with roles for its formulas.

    >>> print(inline("psi_2 to 1e-10 max(1, |psi_1|), spin_out; `psi_2` is code"))
    :math:`\psi_2` to :math:`10^{-10} \max(1, \lvert \psi_1\rvert)`, ``spin_out``; `psi_2` is code
    """
    held: list[str] = []

    def hold(found: re.Match[str]) -> str:
        held.append(f":math:`{found[0][1:-1]}`" if found[0][0] == "$" else found[0])
        return f"\0{len(held) - 1}\0"

    forms = {"text": "{}", "code": "\1``{}``\2", "math": "\1:math:`{}`\2"}
    said = "".join(forms[kind].format(part) for kind, part in parts(NO_PROSE.sub(hold, text)))
    said = re.sub("(?<=[\\w\2])\1|\2(?=[\\w\\\\(])", r"\\ ", said)  # else a role is none
    said = re.sub("[\1\2]", "", said)
    return re.sub("\0(\\d+)\0", lambda found: held[int(found[1])], said)


def equation(text: str) -> str:
    r"""Return a line as a displayed equation, with its words as text; empty if it is none.

    >>> print(equation("F_n = k_n d while loading, F_t = k_t U"))
    F_n = k_n d\text{ while loading},\quad F_t = k_t U
    """
    found = [*parts(text.rstrip(".,;"))]
    if all(kind != "math" for kind, _ in found):
        return ""
    tex = ""
    for maths, group in groupby(found, key=lambda part: part[0] == "math"):
        said = "".join(part for _, part in group)
        if not maths:
            said = re.sub(r"[^,;]*[^,;\s][^,;]*", r"\\text{\g<0>}", said.replace("%", r"\%"))
            said = re.sub(r"([,;])(\\text\{)? ", r"\1\\quad \2", said)
        tex += said
    return tex


def equations(lines: list[str]) -> list[str]:
    """Return an indented block as displayed equations, nothing if it holds anything else."""
    rows: list[str] = []
    for line in lines:  # one that is indented further goes on where the one above ends
        deeper = depth(line) > depth(lines[0])
        rows = [*rows[:-1], f"{rows[-1]} {line.strip()}"] if deeper else [*rows, line.strip()]
    shown = [equation(row) for row in rows if "`" not in row]
    if len(shown) < len(rows) or not all(shown):
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
