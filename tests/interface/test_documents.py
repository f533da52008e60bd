"""What the documents and the workflows say about the code is what the code says."""

import re
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
PAGES = [str(path.relative_to(ROOT)) for path in sorted((ROOT / "docs").rglob("*.md"))]
ARCHITECTURE = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
sys.path.insert(0, str(ROOT / "docs/make"))


def test_diagram_of_phases_is_drawn_from_the_table():
    from phase_diagram import page

    text = (ROOT / "docs/theory/sequences.md").read_text(encoding="utf-8")
    assert "<!-- begin: transitions -->" in text
    assert text == page()


READMES = ["README.md", "CONTRIBUTING.md", "studies/README.md"]


@pytest.mark.parametrize("document", [*READMES, *PAGES])
def test_what_links_lead_to_is_there(document):
    """Pictures, too, but for those of the gallery, which sphinx makes."""
    path = ROOT / document
    targets = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", path.read_text(encoding="utf-8"))
    missing = [target for target in targets if not (path.parent / target).exists()]
    assert [target for target in missing if not target.startswith("gallery/")] == []


def test_the_tree_of_the_architecture_is_that_of_the_sources():
    from tree import page

    assert page(ARCHITECTURE) == ARCHITECTURE
    assert "    lossy/ " in ARCHITECTURE


def test_the_architecture_is_short():
    assert len(ARCHITECTURE.split()) <= 3000


def test_paths_in_the_architecture_are_there():
    paths = re.findall(r"`((?:src|tests|docs|studies|benchmarks|examples)/[\w./]+)`", ARCHITECTURE)
    assert [path for path in paths if not (ROOT / path).exists()] == []


def test_short_paths_in_the_architecture_are_there():
    """Those below src/carom; one is made by the build."""
    paths = set(re.findall(r"`([a-z_]+/[\w./]*)`", ARCHITECTURE))
    here = {path for path in paths for top in ("src/carom", ".") if (ROOT / top / path).exists()}
    assert paths - here <= {"lib/"}


def test_names_in_the_architecture_are_there():
    """Files of tests, tables, functions and classes that are named without their place."""
    names = set(re.findall(r"`([A-Z][A-Z_]+|_?[a-z]+_[a-z_]+|test_\w+\.py)`", ARCHITECTURE))
    files = [path for top in ("src", "tests") for path in (ROOT / top).rglob("*.py")]
    said = "\n".join(path.read_text(encoding="utf-8") for path in files)
    places = {name for path in files for name in (path.name, path.parent.name)}
    assert names - {*re.findall(r"\w+", said)} - places == set()


def test_ten_files_to_read_are_there():
    section = re.search(r"(?ms)^#+ Ten files to read$(.*?)(?=^#|\Z)", ARCHITECTURE)
    paths = re.findall(r"`(src/carom/[\w/]+\.py)`", section[1])
    assert len(paths) == len(set(paths)) == 10
    assert [path for path in paths if not (ROOT / path).is_file()] == []


WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
ON = True  # the key `on`, as YAML 1.1 reads it


def read(path):
    return yaml.safe_load(path.read_text(encoding="utf-8"))


def steps(workflow):
    return [step for job in workflow["jobs"].values() for step in job["steps"]]


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_workflow_has_the_name_of_its_file_and_steps_that_do_something(path):
    workflow = read(path)
    assert workflow["name"] == path.stem
    assert ON in workflow
    for step in steps(workflow):
        assert ("run" in step) != ("uses" in step)
        assert re.fullmatch(r"[\w-]+/[\w-]+@v[\d.]+", step.get("uses", "a/b@v1"))


def test_same_actions_have_the_same_version_everywhere():
    used = {step["uses"] for path in WORKFLOWS for step in steps(read(path)) if "uses" in step}
    assert len({action.partition("@")[0] for action in used}) == len(used)


def test_manual_is_built_by_the_command_of_the_readme():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (command,) = re.findall(r"(?m)^.*sphinx-build.*$", readme)
    manual = read(ROOT / ".github/workflows/manual.yml")
    assert command in [step.get("run") for step in steps(manual)]
    assert set(manual[ON]) == {"push", "pull_request"}


def test_manual_is_built_with_a_python_that_is_tested():
    tested = read(ROOT / ".github/workflows/ci.yml")["jobs"]["green"]["strategy"]["matrix"]
    (built,) = (
        step["with"]["python-version"]
        for step in steps(read(ROOT / ".github/workflows/manual.yml"))
        if "setup-python" in step.get("uses", "")
    )
    assert built in tested["python"]


def test_only_the_job_that_publishes_may_write():
    manual = read(ROOT / ".github/workflows/manual.yml")
    assert manual["permissions"] == {"contents": "read"}
    assert "permissions" not in manual["jobs"]["build"]
    publish = manual["jobs"]["publish"]
    assert publish["permissions"] == {"pages": "write", "id-token": "write"}
    assert publish["needs"] == "build"
    assert "github.event_name == 'push'" in publish["if"]
    assert "refs/heads/main" in publish["if"]


RECIPE = (ROOT / "docs/how-to/own-law.md").read_text(encoding="utf-8")


def block(language):
    (actual,) = re.findall(rf"^```{language}\n(.*?)^```$", RECIPE, re.MULTILINE | re.DOTALL)
    return actual


def test_the_workflow_has_the_lines_of_the_shell_in_their_order():
    steps = re.findall(r"- run: (.*)", block("yaml"))
    assert steps[0].startswith("pip install carom")
    assert steps[1:] == block("sh").splitlines()


def test_what_is_uploaded_is_what_the_lines_leave():
    listed = re.search(r"path: \|\n((?: +\S+\n?)+)", block("yaml"))[1].split()
    left = re.findall(r"(?:--plot |--output |results\.csv )(\S+\.\w+)", block("sh"))
    assert sorted(listed) == sorted(left)


def test_the_exit_codes_are_those_of_the_page(run):
    """0 for results that pass, 1 for those that fail, 2 for a file that cannot be used."""
    Path("own.csv").write_text("psi_1,psi_2\n5.5,-0.26\n6,0.24\n7,1.24\n")
    words = ["verify", "score", "own.csv", "--chi"]
    assert [run(*words, chi)[0] for chi in ("1.44", "1.3")] == [0, 1]
    Path("own.csv").write_text("omega\n1\n")
    assert run(*words, "1.44")[0] == 2
