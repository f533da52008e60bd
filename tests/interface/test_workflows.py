"""The workflows run what the README and the continuous integration of this folder run."""

import re
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
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
    (command,) = re.findall(
        r"(?m)^.*sphinx-build.*$", (ROOT / "README.md").read_text(encoding="utf-8")
    )
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
