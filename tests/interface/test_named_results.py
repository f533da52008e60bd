"""Results that say by which code and contact law they were computed: in files, reports, figures."""

import json
from functools import cache

import numpy as np
import pandas as pd
import pytest
from tests.checks import refused

import carom
from carom.plots.scores import plot_score
from carom.verify.scoring import score

CHI = 1.44
PSI = np.array([0.25, 0.75, 1.5, 3.0, 6.0])
LAWS = {"mindlin": carom.dem.LammpsMindlin("mindlin"), "exact": carom.dem.ExactContactLaw(32)}
NAMES = ["$x_1$", "$", "_hidden", "a" * 300, "two\nlines", "µ-DEM", "%d {0} \\alpha"]


@cache
def rebounds():
    return [psi for law in LAWS.values() for psi in law.rebound(PSI, CHI, steps=500)]


def both(code="LAMMPS"):
    """Columns with the results of two laws."""
    return {
        "psi_1": [*PSI, *PSI],
        "psi_2": rebounds(),
        "code": [code] * (2 * PSI.size),
        "law": [name for name in LAWS for _ in PSI],
    }


def one(**more):
    return {name: values[: PSI.size] for name, values in both().items() if "psi" in name} | more


def labels(result):
    return legend_of(plot_score(result.to_dataset()))


def legend_of(figure):
    legends = [*figure.legends, *(axis.get_legend() for axis in figure.axes)]
    return [text.get_text() for each in legends if each for text in each.get_texts()]


def written(path, columns, comments=""):
    path.write_text(comments + pd.DataFrame(columns).to_csv(index=False))
    return path


def test_columns_tell_codes_and_laws_apart():
    result = score(both(), chi=CHI)
    (mindlin, exact), laws = result.by_origin, result.to_dict()["laws"]
    assert [mindlin.name, exact.name] == ["LAMMPS, mindlin", "LAMMPS, exact"]
    assert mindlin.max_error == result.max_error > 0.5 > 0.01 > exact.max_error
    assert [(law["code"], law["law"], law["points"]) for law in laws] == [
        ("LAMMPS", "mindlin", 5),
        ("LAMMPS", "exact", 5),
    ]
    assert laws[1]["max_error"] == exact.max_error
    text = str(result)
    assert "By law" in text
    assert text.splitlines()[-1].startswith("FAIL: max |error in psi_2| = 0.5")
    assert "with LAMMPS, mindlin in row 2" in text.splitlines()[-1]
    assert result.notes == ()


def test_the_legend_names_code_law_and_error():
    assert labels(score(both(), chi=CHI))[:3] == [
        r"exact, $\chi$ = 1.44",
        r"LAMMPS, mindlin ($\psi_2$ off by 0.58)",
        r"LAMMPS, exact ($\psi_2$ off by 7.7e-05)",
    ]
    assert labels(score(one(), chi=CHI))[1] == r"results ($\psi_2$ off by 0.58)"
    assert labels(score(one(), chi=CHI, law="own"))[1] == r"own ($\psi_2$ off by 0.58)"
    exact = score({"psi_1": PSI, "psi_2": carom.rebound(PSI, CHI)}, chi=CHI, code="carom")
    assert labels(exact)[1] == r"carom ($\psi_2$ off by less than 1e-06)"
    assert labels(score(LAWS["mindlin"], chi=CHI))[1].startswith("mindlin ")


@pytest.mark.first_case
@pytest.mark.parametrize("name", NAMES)
def test_any_name_can_be_drawn(name, tmp_path):
    result = score(one(), chi=CHI, code=name, law=name)
    figure = result.plot()
    carom.plots.save_figure(figure, tmp_path / "score.svg")
    assert any("off by 0.58" in label for label in legend_of(figure))
    errors = carom.verify.error_map(named(name), [0.5, 1.0], [1.2, 1.4], steps=20)
    carom.plots.save_figure(carom.plots.plot_error_map(errors), tmp_path / "map.svg")


def named(name):
    return carom.dem.FunctionLaw(lambda contact, state: (0.0, state), name=name)


def test_a_ranking_of_any_names_can_be_drawn(tmp_path):
    ranking = carom.verify.rank([named(name) for name in NAMES], psi_1=[0.5])
    carom.plots.save_figure(ranking.plot(), tmp_path / "rank.svg")


def test_comments_of_a_file_name_what_columns_do_not(tmp_path):
    comments = "# code: LAMMPS 22 Jul\n# law: mindlin, 2/3\n"
    result = score(written(tmp_path / "results.csv", one(), comments), chi=CHI)
    assert result.origins.distinct == (("LAMMPS 22 Jul", "mindlin, 2/3"),)
    result = score(written(tmp_path / "results.csv", both(), comments), chi=CHI)
    assert [origin.law for origin in result.origins.distinct] == ["mindlin", "exact"]
    result = score(written(tmp_path / "results.csv", both()), chi=CHI, code="own", law="new")
    assert result.origins.distinct == (("own", "new"),)


def test_names_are_kept_in_stored_scores(tmp_path):
    result = score(both(), chi=CHI)
    stored = carom.read(carom.save(result, tmp_path / "score.nc"))
    assert stored.law.values.tolist() == both()["law"]
    assert stored.code.values.tolist() == both()["code"]
    drawn = plot_score(stored).legends[0].get_texts()
    assert [text.get_text() for text in drawn] == labels(result)[:3]
    again = score(carom.save(result, tmp_path / "score.csv"), chi=None)
    assert again.by_origin == result.by_origin
    assert "code" not in score(one(), chi=CHI).to_dataset()


def test_names_of_velocities_and_of_a_history(pair):
    hits = [carom.impact(pair, speed=1.0, angle=angle) for angle in (0.1, 0.4, 1.0)]
    names = ("normal_speed", "tangential_speed", "spin", "tangential_speed_out", "spin_out")
    columns = {name: [getattr(hit, name) for hit in hits] for name in names}
    result = score(columns | {"law": ["a", "b", "b"]}, case=pair)
    assert [group.points for group in result.by_origin] == [1, 2]
    history = hits[1].history(40)
    forces = {name: history[name].values for name in ("time", "normal_force", "tangential_force")}
    result = score(forces | {"law": ["a"] * 40}, case=hits[1], code="own")
    assert result.by_origin[0].name == "own, a"
    assert r"own, a ($\psi_2$ off by less than 1e-06)" in labels(result)
    result = score(forces | {"law": ["a", "b"] * 20}, case=hits[1])
    assert result.notes == ("the names in law are left out: 2 of them, at most 1 are told apart",)


@pytest.mark.parametrize(
    "cells", [list(range(5)), [None] * 5, ["-"] * 5, [float("nan")] * 5, ["a", 2, None] * 2]
)
def test_a_column_of_anything_is_no_fault(cells):
    """Columns of these names were allowed before they meant something."""
    result = score(one(law=cells[:5]), chi=CHI)
    assert result.max_error == score(one(), chi=CHI).max_error
    assert result.plot() is not None


def test_more_names_than_a_figure_tells_apart_are_left_out():
    psi = np.linspace(0.1, 6.0, 40)
    table = {"psi_1": psi, "psi_2": carom.rebound(psi, CHI), "law": [f"run {i}" for i in range(40)]}
    result = score(table, chi=CHI, code="own")
    assert result.origins.distinct == (("own", ""),)
    assert "40 of them" in result.notes[0]


@pytest.mark.parametrize("name", ["", " ", 3, ["mindlin"]])
def test_a_name_that_is_none_is_refused(name):
    refused(r"^law: .* must be a text", score, one(), chi=CHI, law=name)


def test_the_command_names_them_too(run, tmp_path):
    written(tmp_path / "own.csv", one())
    values = ["verify", "score", "own.csv", "--chi", CHI, "--code", "own", "--law", "new"]
    code, out, _ = run(*values, "--json")
    assert code == 1
    assert [(law["code"], law["law"]) for law in json.loads(out)["laws"]] == [("own", "new")]
    code, out, _ = run(*values, "--tolerance", "0.6")
    assert code == 0
    assert "with own, new in line" in out
