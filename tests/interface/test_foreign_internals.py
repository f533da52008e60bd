"""What Carom reads of the private parts of other packages: only what is named here, and it exists.

A new version of numba that lacks one of them breaks the build; this says which.
"""

import ast
from pathlib import Path

import pytest
from llvmlite import binding
from numba import njit
from numba.core import compiler, registry

import carom
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.kernels import Kernel
from carom.native import numba_internals
from carom.native.emission import object_code
from carom.native.numba_internals import CODE, PATCHES

PACKAGE = Path(carom.__file__).parent
OWN = {  # private to Carom: what its files know of each other's classes, and users do not see
    "cli/sweep.py": {"_doubts"},
    "impacts/contacts/fields.py": {"_edge", "_rim", "_slid", "_slipping", "_viscous"},
    "impacts/contacts/load_paths.py": {"_describe"},
    "dimensionless/lossy/law.py": {"_scale_free"},
    "impacts/body_impact.py": {"_ellipse", "_losses"},
    "impacts/exact.py": {"_loss", "_losses", "_source"},
    "impacts/outcome.py": {"_describe"},
    "impacts/validity.py": {"_ellipse", "_loss", "_size_ratio", "_strength"},
    "impacts/wear.py": {"_slip_borders"},
    "many/laws/exact.py": {"_hold", "_of", "_rule", "_scale_free", "_table"},
    "many/laws/header.py": {"_one_chi", "_rule"},
    "many/sweeps/any_shape.py": {"_choices", "_description"},
    "many/sweeps/points.py": {"_loss"},
    "many/sweeps/problem.py": {"_choices", "_description", "_sampled"},
    "many/sweeps/records.py": {"_coords"},
    "many/sweeps/wearing.py": {"_describe", "_loss"},
    "verify/benchmark.py": {"_builder"},
    "verify/engines/lammps.py": {"_called"},
    "verify/entries.py": {"_damped"},
    "verify/errors.py": {"_most_steps", "_why"},
    "verify/pack/writing.py": {"_arguments", "_called"},
    "verify/scoring/velocities.py": {"_describe"},
    **{
        f"lab/fitting/{name}.py": {"_best"}
        for name in ("advice", "comparison", "datasets", "report")
    },
    "lab/fitting/report_file.py": {"_best"},
    "lab/fitting/joint_result.py": {"_sections"},
    "page/uploads.py": {"_best"},
}
PUBLIC = {"_replace", "_asdict", "_fields", "_make", "_value_", "_exit"}  # documented by Python
NUMBA = {
    "native/numba_internals.py": {
        *("_dynfunc", "_FunctionCompiler", "_codegen", "_data_layout", "_final_module"),
        *("_optimize_functions", "_optimize_final_module", "_get_module_for_linking"),
        *("_get_host_cpu_name", "_get_host_cpu_features"),
    },
    "dimensionless/numerics/kernels.py": {"_numba_type_"},
}
PATCHED = {each.name for each in PATCHES}
TYPING = {"__metadata__", "__origin__", "__args__", "__value__", "__parameters__"}
FILES = sorted(path.relative_to(PACKAGE).as_posix() for path in PACKAGE.rglob("*.py"))


def private_names(tree):
    """Names that begin with an underscore, read of anything but an object of its own class."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and node.attr.startswith("_"):
            base = node.value
            own = isinstance(base, ast.Name) and base.id in ("self", "cls")
            inherited = isinstance(base, ast.Call) and ast.unparse(base) == "super()"
            if not own and not inherited and (not node.attr.endswith("__") or node.attr in TYPING):
                yield node.attr
        elif isinstance(node, ast.ImportFrom) and not (node.module or "carom").startswith("carom"):
            yield from (
                name
                for name in (*(node.module or "").split("."), *(each.name for each in node.names))
                if name.startswith("_") and not name.endswith("__")
            )


@pytest.mark.first_case
@pytest.mark.parametrize("name", FILES)
def test_only_named_internals_are_read(name):
    names = set(private_names(ast.parse((PACKAGE / name).read_text(encoding="utf-8"))))
    assert names - PUBLIC == OWN.get(name, set()) | NUMBA.get(name, set())


def test_the_internals_of_numba_exist():
    compiled = njit(lambda x: x + 1.0)
    compiled.compile("(float64,)")
    library = CODE(compiled.overloads[compiled.signatures[0]])
    own = registry.cpu_target.target_context.codegen()
    read = [(each.owner, each.name) for each in PATCHES]
    read += [(compiled, "_numba_type_"), (library, "_codegen"), (library, "_final_module")]
    read += [(library, "_get_module_for_linking"), (own, "_data_layout")]
    read += [(own, "_get_host_cpu_name"), (own, "_get_host_cpu_features")]
    missing = [f"{owner}.{name}" for owner, name in read if not hasattr(owner, name)]
    assert not missing
    assert {"no_cpython_wrapper", "no_cfunc_wrapper"} <= set(vars(compiler.Flags))
    assert isinstance(own._get_host_cpu_features(), str)
    assert isinstance(library._get_module_for_linking(), binding.ModuleRef)


@pytest.fixture
def reached(monkeypatch):
    """Which of the patches the build comes to, as it goes on."""
    names = set()

    def watched(each):
        def call(*args):
            names.add(each.name)
            return each.value(*args)

        return each._replace(value=call)

    monkeypatch.setattr(numba_internals, "PATCHES", tuple(map(watched, PATCHES)))
    return names


def test_the_build_comes_to_every_patch(reached):
    """One that numba goes round would do nothing, and say nothing."""
    assert len(object_code([Kernel(hertz.time.py_func, ("float64",))])) > 1000
    assert reached == PATCHED
