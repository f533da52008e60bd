"""The paper for a journal and the citation file: complete, and with the numbers of the manual."""

import re
import runpy
import tomllib
from importlib.metadata import version
from pathlib import Path

import pytest
import yaml
from PIL import Image

ROOT = Path(__file__).parents[2]
PAPER = (ROOT / "paper/paper.md").read_text(encoding="utf-8")
HEADER, BODY = PAPER.split("---\n", 2)[1:]
BIB = (ROOT / "paper/paper.bib").read_text(encoding="utf-8")
SHIPPED = (ROOT / "src/carom/data/citations.bib").read_text(encoding="utf-8")
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
DOI = r"10\.\d{4,9}/[-._;()/:A-Za-z0-9]+"

STEPPED = "contact laws in fixed steps"
WORDS = " ".join(BODY.split())
# rows of the paper's table, and of that in docs/accuracy.md: (claim, checked against)
ROWS = {
    "rebound $": ("$", "47 impacts"),
    "the whole impact": ("the whole impact", "annuli"),
    "energy balance": ("energy balance", "memory"),
    "tractions": ("fields at the surface", "Cerruti"),
    "stress below the surface": ("stress below the surface", "Boussinesq"),
    f"{STEPPED}, $\\psi_2$ | LAMMPS": (STEPPED, "LAMMPS"),
    f"{STEPPED}, $\\psi_2$ | YADE": (STEPPED, "LIGGGHTS, YADE"),
    "boundary elements": ("boundary elements", "the exact impact"),
    "bound on what": ("bound on what", "full contact"),
}


def manual(name):
    """Return the text of a page, and as words with one blank between them."""
    text = (ROOT / f"docs/{name}.md").read_text(encoding="utf-8")
    return text, " ".join(text.split())


def entries(bib):
    """Return the fields of all entries of a BibTeX file, by key."""
    by_name = {}
    for entry in re.split(r"(?m)^@", bib)[1:]:
        key = re.match(r"\w+\{(\w+),", entry)[1]
        assert key not in by_name, key
        by_name[key] = dict(re.findall(r"(?m)^  (\w+) = \{(.*)\},$", entry))
    return by_name


def rows(text):
    """Return the rows of all tables of a page, without the lines that frame them."""
    return [line.strip("| ") for line in text.splitlines() if line.startswith("|")]


def last_number(text):
    """Return the last number of a cell: 4e-13, [4e-9](laws.md) or $4 \\cdot 10^{-13}$."""
    text = re.sub(r"\]\([^)]*\)| of \$p_0\$| in \$\\psi_2\$| of the bound", "]", text)
    power = r"\$(?:([\d.]+) \\cdot )?10\^\{(-?\d+)\}\$"
    text = re.sub(power, lambda actual: f"{actual[1] or 1}e{actual[2]}", text)
    return float(re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", text)[-1])


def table_of_claims():
    """Return (claim, checked against, found) of docs/accuracy.md."""
    cells = [re.split(r" \| ", row) for row in rows(manual("accuracy")[0])]
    return [row[:3] for row in cells if len(row) == 4 and "`tests/" in row[3]]


def test_header_is_what_the_journal_asks_for():
    header = yaml.safe_load(HEADER)
    assert header["bibliography"] == "paper.bib"
    assert (ROOT / "paper" / header["bibliography"]).is_file()
    assert header["title"] == CITATION["title"]
    authors, cited = ([each["name"] for each in who["authors"]] for who in (header, CITATION))
    assert authors == cited
    places = {place["index"] for place in header["affiliations"]}
    assert {author["affiliation"] for author in header["authors"]} == places
    assert re.fullmatch(r"\d{1,2} [A-Z][a-z]+ \d{4}", header["date"])
    assert len(header["tags"]) >= 4


def test_sections_are_in_the_order_of_the_journal():
    asked = "Summary; Statement of need; State of the field; Software design; "
    asked += "Research impact statement; AI usage disclosure; Acknowledgements"
    matches = re.findall(r"(?m)^# (.*)$", BODY)
    places = [matches.index(section) for section in (*asked.split("; "), "References")]
    assert places == sorted(places)
    assert matches[-1] == "References"


def test_as_long_as_the_journal_takes():
    """From 750 to 1750 words, formulas and all."""
    assert 750 <= len(BODY.split()) <= 1750


def test_every_reference_is_cited_and_every_citation_has_one():
    cited = set(re.findall(r"(?<!\w)@(\w+)", BODY))
    assert cited == set(entries(BIB))
    assert len(cited) >= 15


def test_references_are_complete():
    for key, fields in entries(BIB).items():
        assert {"title", "author", "year"} <= set(fields), key
        assert set(fields) & {"journal", "publisher", "booktitle", "howpublished"}, key
        assert key.endswith(fields["year"]), key
        assert re.fullmatch(DOI, fields.get("doi", "10.1000/182")), key


def test_references_agree_with_those_that_results_cite():
    """Field by field, where both have a field."""
    shipped, here = entries(SHIPPED), entries(BIB)
    both = set(shipped) & set(here)
    assert len(both) >= 6
    for key in both:
        for field in set(shipped[key]) & set(here[key]):
            assert shipped[key][field] == here[key][field], (key, field)


@pytest.mark.slow
def test_figures_are_there_and_drawn_by_the_script_that_is_named(tmp_path):
    (name,) = re.findall(r"\]\(([^)]+\.png)\)", BODY)
    assert re.findall(r"\\label\{(fig:\w+)\}", BODY) == ["fig:contact"]
    (script,) = re.findall(r"`(paper/\w+\.py)`", BODY)
    main = runpy.run_path(str(ROOT / script))["main"]
    with Image.open(main(tmp_path)) as drawn, Image.open(ROOT / "paper" / name) as stored:
        assert drawn.size[0] == pytest.approx(stored.size[0], rel=0.02)
        assert drawn.size[1] == pytest.approx(stored.size[1], rel=0.02)


def test_labels_that_are_referred_to_are_there():
    used, made = (
        set(re.findall(rf"\\{each}\{{([\w:]+)\}}", BODY)) for each in ("autoref", "label")
    )
    assert used == made


@pytest.mark.parametrize("row", ROWS)
def test_largest_differences_are_those_of_the_manual(row):
    claim, reference = ROWS[row]
    (paper,) = (cells for cells in rows(BODY) if cells.startswith(row))
    values = [
        cells[2]
        for cells in table_of_claims()
        if cells[0].startswith(claim) and cells[1].startswith(reference)
    ]
    if row == "boundary elements":  # the page says how close with words before the number
        values = [re.search(r"within (\S+)", cell)[1] for cell in values]
    assert len(values) == 1
    assert last_number(paper.split(" | ")[-1]) == last_number(values[0])


def test_the_whole_table_is_compared():
    table = [row for row in rows(BODY) if row.count(" | ") == 2][1:]
    assert len(table) == len(ROWS)
    assert all(sum(row.startswith(name) for name in ROWS) == 1 for row in table)


OTHERS = [(said, "accuracy") for said in ("12 µs", "92 to 98.5 %", "500 synthetic")]


@pytest.mark.parametrize(("said", "page"), [*OTHERS, ("1,136 impacts", "halfspace_study")])
def test_other_numbers_are_those_of_the_manual(said, page):
    assert said in WORDS
    assert said in manual(page)[1]


def test_what_a_table_saves_is_that_of_the_measured_times():
    """A law as a table over the solver from which it is made: as the manual's table has it."""
    _, page = manual("accuracy")
    times = dict(re.findall(r"\| (\w+) \| \w+ \| ([\d.]+) \|", page))
    saved = float(f"{float(times['rebound']) / float(times['ReboundLaw']):.1g}")
    assert f"is {saved:g} times cheaper here" in page
    for text in (page, WORDS):
        assert re.search(rf"100 to {saved:g} times (?:cheaper|shorter)", text)


def test_errors_of_contact_laws_are_those_of_the_manual():
    """The largest error at chi = 1.4412, as the paper rounds it."""
    page, _ = manual("laws_study")
    ranking = re.search(r"<!-- begin: ranking -->(.*?)<!-- end -->", page, re.DOTALL)[1]
    largest = {}
    for row in rows(ranking)[2:]:
        name, _, value, *_ = row.split(" | ")
        largest[name] = float(value)
    for pattern, names in (
        (r"- (\S+) with `mindlin` of LAMMPS", ("mindlin", "LIGGGHTS hertz, history")),
        (r"- (\S+) with that of YADE", ("YADE Mindlin",)),
        (r"(\S+) with that of Kratos", ("mindlin_rescale/force",)),
        (r"(\S+) with that of MercuryDPM", ("mindlin, 2/3 of the stiffness",)),
        (r"- (\S+) with a linear spring", (r"linear spring, $k_t/k_n = \kappa$",)),
        (r"(\S+) with the ratio 2/7", ("linear spring, $k_t/k_n = 2/7$",)),
        (r"off by (\S+) in \$\\psi_2\$ with 16 springs", ("exact, 16 springs",)),
    ):
        said = re.search(pattern, WORDS)[1]
        digits = len(said.partition(".")[2])
        for name in names:
            assert f"{largest[name]:.{digits}f}" == said, name
    softer = re.search(r"<!-- begin: softer -->\S+, (\S+) and", manual("laws")[0])[1]
    assert re.search(r"`mindlin_rescale/force` is off by (\S+)\.(?:\s|$)", WORDS)[1] == softer


def test_the_ball_at_ten_degrees_is_that_of_the_manual():
    page, _ = manual("laws")
    ball = re.search(r"<!-- begin: steel_ball -->(.*?)<!-- end -->", page, re.DOTALL)[1]
    angles = dict(re.findall(r"(?m)^\| (exact|mindlin) \| ([\d.]+)°", ball))
    (spin,) = re.findall(r"(?m)^\| mindlin \| [^|]* \| ([\d.]+) ", ball)
    said = re.search(r"leaves at (\S+) degrees instead of (\S+), with (\d+) % of its spin", WORDS)
    assert said.groups() == (angles["mindlin"], angles["exact"], f"{100 * float(spin):.0f}")
    answer = 0
    for place in (ROOT / "README.md", *(ROOT / "docs").rglob("*.md")):  # the same words everywhere
        text = " ".join(place.read_text(encoding="utf-8").split())
        pattern = r"instead of 7\.3(?:°| degrees)?, with (.{,20}?) of (?:its|the)"
        for share in re.findall(pattern, text):
            assert share == f"{100 * float(spin):.0f} %", place.name
            answer += 1
    assert answer >= 5


def test_citation_file_has_the_version_of_the_package():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]["version"]
    assert str(CITATION["version"]) == project == version("carom")


def test_citation_file_is_complete():
    assert CITATION["cff-version"] == "1.2.0"
    assert {"message", "title", "abstract", "keywords", "authors", "license"} <= set(CITATION)
    for reference in CITATION["references"]:
        assert {"type", "title", "authors", "year"} <= set(reference), reference["title"]
        assert re.fullmatch(DOI, reference.get("doi", "10.1000/182"))


def test_citation_file_agrees_with_the_paper():
    """References of the same title have the same DOI, volume and year."""
    plain = {re.sub(r"[{}]", "", fields["title"]): fields for fields in entries(BIB).values()}
    assert len(CITATION["references"]) >= 4
    for reference in CITATION["references"]:
        fields = plain[reference["title"]]
        assert reference.get("doi") == fields.get("doi")
        assert str(reference["year"]) == fields["year"]
        assert str(reference["volume"]) == fields["volume"]
        assert f"{reference['start']}--{reference['end']}" == fields["pages"]
