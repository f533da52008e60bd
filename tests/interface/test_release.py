"""What several files say of a release agrees; and what is not ready is not published."""

import re
import sys
import tomllib
import zipfile
from importlib.metadata import version
from pathlib import Path

import pytest
import yaml

sys.path.insert(0, str(Path(__file__).parents[2] / "release"))

import metadata
import ready

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
CHANGELOG = (ROOT / "CHANGELOG.md").read_text("utf-8")
README = (ROOT / "README.md").read_text("utf-8")
FILES = "https://github.com/owner/carom/{}/v0.3.0/"
CODE = r"(?s)```.*?```|`[^`]*`"


def test_citation_and_codemeta_are_what_the_script_writes():
    assert metadata.CITATION.read_text("utf-8") == metadata.citation()
    assert metadata.CODEMETA.read_text("utf-8") == metadata.codemeta()


def test_there_is_one_version():
    recipe = yaml.safe_load((ROOT / "release/conda/recipe.yaml").read_text("utf-8"))
    spack = (ROOT / "release/spack/package.py").read_text("utf-8")
    others = {
        version("carom"),
        metadata.released()[0],
        str(yaml.safe_load(metadata.citation())["version"]),
        yaml.safe_load(metadata.codemeta())["version"],
        recipe["context"]["version"],
        re.search(r'version\("([\d.]+)"', spack)[1],
    }
    assert others == {PROJECT["version"]}


def test_keywords_authors_and_licences_are_those_of_the_citation():
    cited = yaml.safe_load(metadata.citation())
    assert PROJECT["keywords"] == cited["keywords"]
    assert PROJECT["authors"] == cited["authors"]
    assert cited["license"] == "BSD-3-Clause"  # Carom's own; other parts have others
    assert set(PROJECT["license"].split(" AND ")) == {
        "BSD-3-Clause",
        "BSD-2-Clause",
        "GPL-2.0-only",
    }
    for name in PROJECT["license-files"]:
        assert (ROOT / name).is_file()


def test_classifiers_tell_the_pythons_that_are_tested_and_no_licence():
    """PEP 639: an expression takes the place of classifiers of licences."""
    workflow = yaml.safe_load((ROOT / ".github/workflows/ci.yml").read_text("utf-8"))
    tested = workflow["jobs"]["green"]["strategy"]["matrix"]["python"]
    told = re.findall(r":: Python :: (3\.\d+)", "\n".join(PROJECT["classifiers"]))
    assert told == tested
    assert PROJECT["requires-python"] == f">={told[0]}"
    assert not any(each.startswith("License") for each in PROJECT["classifiers"])


def described(text, files):
    from description import described

    return described(text, files)


def test_description_leads_to_files_that_are_there():
    pytest.importorskip("hatchling")
    text = described(README, FILES)
    places = re.findall(r"\]\(([^)]+)\)", text)
    found = [
        re.fullmatch(re.escape(FILES).replace(r"\{\}", "(blob|raw)") + "(.*)", a) for a in places
    ]
    assert len(found) > 8
    assert all(found)
    for each in found:
        assert (ROOT / each[2].partition("#")[0]).exists()
    pictures = [each[2] for each in found if each[1] == "raw"]
    assert pictures == re.findall(r"!\[[^]]*\]\(([^)]+)\)", README) != []


@pytest.mark.parametrize("files", [FILES, None], ids=["address", "no address"])
def test_description_has_nothing_that_an_index_does_not_show(files):
    """No formulas and no paths; all code as it was, and all words but alternatives of pictures."""
    pytest.importorskip("hatchling")
    text = described(README, files)
    assert re.findall(CODE, text) == re.findall(CODE, README)
    plain = re.sub(CODE, "", text)
    assert not re.search(r"\$|\\[a-z]|[_^]\{|\]\((?!https:)", plain)
    words = re.sub(
        r"!?\[([^]]*)\]\([^)]*\)|\$.*?\$", r"\1", README if files else no_pictures(README)
    )
    kept = re.sub(r"!?\[([^]]*)\]\([^)]*\)", r"\1", text)
    lost = set(re.findall(r"[A-Za-z]{3,}", words)) - set(re.findall(r"[A-Za-z]{3,}", kept))
    assert lost == set()


def no_pictures(text):
    return re.sub(r"!\[[^]]*\]\([^)]*\)", "", text)


def test_formulas_in_plain_letters():
    pytest.importorskip("hatchling")
    text = r"$\psi_2$, $\max(1, \lvert\psi_1\rvert)$, $4 \cdot 10^{-13}$, `$x_1$`, $\chi^2$"
    plain = r"ψ₂, max(1, \|ψ₁\|), 4 · 10⁻¹³, `$x_1$`, χ²"
    assert described(text, None) == plain


URLS = {
    "Source": "https://github.com/owner/carom",
    "Issues": "https://github.com/owner/carom/issues",
    "Documentation": "https://owner.github.io/carom/",
    "Changelog": "https://github.com/owner/carom/blob/main/CHANGELOG.md",
}


@pytest.fixture
def complete(monkeypatch, tmp_path):
    """A project of which everything is told; what is changed here is a fault."""
    project, head = PROJECT | {"urls": dict(URLS)}, [PROJECT["version"], "2026-12-01"]
    for module in (metadata, ready):
        monkeypatch.setattr(module, "project", lambda: project)
        monkeypatch.setattr(module, "released", lambda: tuple(head))
    for name in ("CITATION", "CODEMETA"):
        path = tmp_path / name
        monkeypatch.setattr(ready, name, path)
        path.write_text(getattr(metadata, name.lower())(), "utf-8")
    return project, head


def test_a_complete_project_is_ready(complete):
    assert list(ready.missing(f"v{PROJECT['version']}")) == []
    text = metadata.citation()
    assert "\ndate-released: 2026-12-01\nrepository-code: https://github.com/owner/carom\n" in text
    assert yaml.safe_load(metadata.codemeta())["codeRepository"] == URLS["Source"]


@pytest.mark.parametrize("link", URLS)
@pytest.mark.parametrize(
    "address", [None, "", "docs", "http://carom.org/", "https://carom.example/"]
)
def test_an_address_that_nobody_can_reach_is_missing(link, address, complete):
    complete[0]["urls"] |= {link: address} if address is not None else {}
    complete[0]["urls"].pop(link) if address is None else None
    assert f"pyproject.toml: [project.urls] has no public address {link}" in list(ready.missing())


def test_dates_versions_and_stale_files_are_missing(complete):
    complete[1][:] = ["0.2.9", "unreleased"]
    ready.CODEMETA.write_text("{}")
    text = "\n".join(ready.missing("v0.2.9"))
    for said in (
        "begins with 0.2.9",
        "0.2.9 has no date",
        "CODEMETA: is out of date",
        "tag: is v0.2.9",
    ):
        assert said in text


def test_this_checkout_tells_what_it_lacks():
    """Until there is a public address nothing can be published by the workflow."""
    assert bool(list(ready.missing())) is (
        metadata.released()[1] == "unreleased" or set(PROJECT.get("urls", {})) < set(URLS)
    )


LIBRARY = ["carom/lib/libcarom.so", "carom/lib/carom.wasm"]
WHEELS = {  # name, files, metadata: what is missing
    "sound": ("manylinux_2_28", LIBRARY, "0.3.0", "words", None),
    "pure": ("any", LIBRARY[1:], "0.3.0", "words", "has no compiled library"),
    "no browser": (
        "manylinux_2_28",
        LIBRARY[:1],
        "0.3.0",
        "words",
        "nothing compiled for browsers",
    ),
    "own machine": ("linux_x86_64", LIBRARY, "0.3.0", "words", "auditwheel"),
    "older": ("manylinux_2_28", LIBRARY, "0.2.0", "words", "is not of version"),
    "links": ("manylinux_2_28", LIBRARY, "0.3.0", "[a](docs/a.md)", "links that lead nowhere"),
    "no description": ("manylinux_2_28", LIBRARY, "0.3.0", "", "links that lead nowhere"),
}


@pytest.mark.parametrize("kind", WHEELS)
def test_a_wheel_that_should_not_be_published_is_told(kind, complete, tmp_path):
    platform, names, number, description, said = WHEELS[kind]
    complete[0]["version"] = complete[1][0] = "0.3.0"
    path = tmp_path / f"carom-{number}-py3-none-{platform}.whl"
    with zipfile.ZipFile(path, "w") as wheel:
        for name in names:
            wheel.writestr(name, "")
        head = f"Metadata-Version: 2.4\nName: carom\nVersion: {number}\n\n{description}"
        wheel.writestr(f"carom-{number}.dist-info/METADATA", head)
    found = [line for line in ready.missing(None, [path]) if line.startswith(path.name)]
    assert len(found) == (said is not None)
    assert said is None or said in found[0]


KINDS = ["Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"]


def test_changelog_is_in_its_form():
    """Versions downwards, a date or none; sections with the names and in the order of the form."""
    heads = re.findall(r"(?m)^## (.*)$", CHANGELOG)
    forms = [re.fullmatch(r"(\d+)\.(\d+)\.(\d+) - (unreleased|\d{4}-\d\d-\d\d)", a) for a in heads]
    assert all(forms)
    numbers = [tuple(map(int, each.groups()[:3])) for each in forms]
    assert numbers == sorted(set(numbers), reverse=True)
    for section in re.split(r"(?m)^## ", CHANGELOG)[1:]:
        kinds = re.findall(r"(?m)^### (.*)$", section)
        assert all(kind in KINDS or kind.startswith("From ") for kind in kinds)
        known = [KINDS.index(kind) for kind in kinds if kind in KINDS]
        assert known == sorted(set(known))


def requirement(text):
    """Return the name of a requirement, the lowest version, and the first that is too high."""
    name, least, beyond = re.fullmatch(r"([\w.-]+)(?:>=([\d.]+))?(?:,<([\d.]+))?", text).groups()
    return name.replace("_", "-"), least, beyond


OTHER_NAMES = {"matplotlib": "matplotlib-base"}  # on conda-forge; "pillow" is "pil" in Spack
BUILT_BY = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["build-system"]["requires"]


def test_recipe_for_conda_has_the_same_requirements():
    recipe = yaml.safe_load((ROOT / "release/conda/recipe.yaml").read_text("utf-8"))
    for place, needed, beside in (
        ("host", BUILT_BY, {"python", "pip"}),
        ("run", PROJECT["dependencies"], {"python"}),
    ):
        told = set()
        for name, least, beyond in map(requirement, needed):
            bounds = [f">={least}"] * bool(least) + [f"<{beyond}"] * bool(beyond)
            told.add(" ".join((OTHER_NAMES.get(name, name), ",".join(bounds))).strip())
        assert set(recipe["requirements"][place]) == told | beside
    assert recipe["about"]["license"] == PROJECT["license"]
    assert recipe["about"]["license_file"] == PROJECT["license-files"]
    (command,) = PROJECT["scripts"].items()
    assert recipe["build"]["python"]["entry_points"] == [" = ".join(command)]


def test_recipe_for_spack_has_the_same_requirements():
    text = (ROOT / "release/spack/package.py").read_text("utf-8")
    told = dict(re.findall(r'depends_on\("(?:py-)?([\w-]+)(?:@([\d.]+):[^"]*)?"', text))
    needed = [requirement(each)[:2] for each in (*BUILT_BY, *PROJECT["dependencies"])]
    expected = {"pil" if name == "pillow" else name: least or "" for name, least in needed}
    python = PROJECT["requires-python"].removeprefix(">=")
    assert told == expected | {"c": "", "python": python}
    assert f'license("{PROJECT["license"]}")' in text


def test_only_what_is_ready_can_be_published():
    workflow = yaml.safe_load((ROOT / ".github/workflows/publish.yml").read_text("utf-8"))
    check, publish = workflow["jobs"]["check"], workflow["jobs"]["publish"]
    commands = [step["run"] for step in check["steps"] if "run" in step]
    assert any(re.search(r"python release/ready\.py --tag \S+ dist/\*$", each) for each in commands)
    assert any("twine check --strict dist/*" in each for each in commands)
    assert publish["needs"] == "check"
    assert publish["permissions"] == {"id-token": "write"}
    assert "write" not in str(workflow["permissions"]) + str(check["permissions"])
    uploaded = [step["with"] for step in check["steps"] if "upload-artifact" in str(step)]
    downloaded = [step["with"] for step in publish["steps"] if "download-artifact" in str(step)]
    assert downloaded[0] in uploaded


def test_page_of_licences_has_every_requirement_of_users_with_the_licence_it_has():
    """The whole list, with what they need in turn, is compared every week."""
    import licences

    told = licences.told(licences.PAGE.read_text("utf-8"))
    extras = PROJECT["optional-dependencies"]
    names = [
        *PROJECT["dependencies"],
        *(each for name in licences.EXTRAS[1:] for each in extras[name]),
    ]
    direct = {re.match(r"[\w.-]+", each)[0].lower().replace("_", "-") for each in names} - {"carom"}
    now = licences.needed()
    assert len(direct) > 20
    assert direct <= set(told) & set(now)
    assert {name: told[name] for name in direct} == {name: now[name] for name in direct}
    assert "unknown" not in now.values()
    only_extras = {name for name, kind in now.items() if "GPL" in kind}
    assert only_extras.isdisjoint(licences.needed(("",)))


def test_page_of_licences_names_what_has_a_licence_of_its_own():
    page = (ROOT / "docs/licences.md").read_text("utf-8")
    for path in (ROOT / "src/carom").rglob("*"):
        if path.suffix in (".h", ".hpp", ".cpp") and "GPL-2.0-only" in path.read_text("utf-8"):
            assert f"`carom/adapters/{path.parent.name}`" in page
    for path in (ROOT / "src/carom/data/measured").glob("*.csv"):
        assert re.search(r"(?m)^# source: .*\(\d{4}\)", path.read_text("utf-8")), path.name
