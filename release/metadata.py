"""Write into CITATION.cff and codemeta.json what pyproject.toml and CHANGELOG.md say."""

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).parents[1]
CITATION, CODEMETA = ROOT / "CITATION.cff", ROOT / "codemeta.json"
PYTHON = "Programming Language :: Python :: "
LINKS = {  # of pyproject.toml, by what CodeMeta calls them
    "codeRepository": "Source",
    "issueTracker": "Issues",
    "softwareHelp": "Documentation",
    "releaseNotes": "Changelog",
}


def project() -> dict[str, Any]:
    """Return what pyproject.toml says of the package."""
    table: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    return table


def released() -> tuple[str, str]:
    """Return the version at the head of CHANGELOG.md, and its date or "unreleased"."""
    text = (ROOT / "CHANGELOG.md").read_text("utf-8")
    head = re.search(r"(?m)^## (\d+\.\d+\.\d+) - (unreleased|\d{4}-\d\d-\d\d)$", text)
    if head is None:
        raise SystemExit("CHANGELOG.md: no section such as ## 0.3.0 - 2026-11-27")
    return head[1], head[2]


def citation() -> str:
    """Return the text of CITATION.cff, with version, date and address as they are now."""
    lines = [f"version: {project()['version']}"]
    if (date := released()[1]) != "unreleased":
        lines.append(f"date-released: {date}")
    if source := project().get("urls", {}).get("Source"):
        lines.append(f"repository-code: {source}")
    text = CITATION.read_text("utf-8")
    text = re.sub(r"(?m)^(?:date-released|repository-code): .*\n", "", text)
    return re.sub(r"(?m)^version: .*$", "\n".join(lines), text)


def codemeta() -> str:
    """Return the text of codemeta.json, https://codemeta.github.io/terms, version 3.0."""
    about, cited = project(), yaml.safe_load(citation())
    pythons = [each.removeprefix(PYTHON) for each in about["classifiers"]]
    needed = about["dependencies"]
    licences = re.findall(r"[\w.-]+-[\w.-]+", about["license"])
    described = {
        "@context": "https://w3id.org/codemeta/3.0",
        "@type": "SoftwareSourceCode",
        "name": about["name"],
        "identifier": about["name"],
        "version": about["version"],
        "softwareVersion": about["version"],
        "description": " ".join(cited["abstract"].split()),
        "keywords": cited["keywords"],
        "license": [f"https://spdx.org/licenses/{each}" for each in licences],
        "author": [{"@type": "Organization", **author} for author in about["authors"]],
        "programmingLanguage": [
            {"@type": "ComputerLanguage", "name": "Python", "version": each}
            for each in pythons
            if re.fullmatch(r"3\.\d+", each)
        ],
        "runtimePlatform": f"Python {about['requires-python']}",
        "operatingSystem": [
            each.rpartition(" :: ")[2]
            for each in about["classifiers"]
            if each.startswith("Operating System")
        ],
        "softwareRequirements": [
            {"@type": "SoftwareApplication", "name": name, "version": least}
            for name, least in (re.match(r"([\w.-]+)(.*)", each).groups() for each in needed)
        ],
        "citation": [
            {"@type": "ScholarlyArticle", "name": each["title"]}
            | ({"@id": f"https://doi.org/{each['doi']}"} if "doi" in each else {})
            for each in cited["references"]
        ],
    }
    if "date-released" in cited:
        described["datePublished"] = str(cited["date-released"])
    if "doi" in cited:
        described["identifier"] = f"https://doi.org/{cited['doi']}"
    urls = about.get("urls", {})
    described |= {term: urls[link] for term, link in LINKS.items() if link in urls}
    return json.dumps(described, indent=2, ensure_ascii=False) + "\n"


if __name__ == "__main__":
    for path, text in ((CITATION, citation), (CODEMETA, codemeta)):  # in this order
        path.write_text(text(), "utf-8")
        print(path.name)
