"""What Carom reads of the private parts of other packages: only what is named here, and it exists.

A new version of numba that lacks one of them breaks the build; this says which.
"""

import ast
from pathlib import Path

import pytest
from llvmlite import binding
from numba import njit
from numba.core import codegen, compiler, cpu, dispatcher, registry

import carom
from carom.native.emission import CODE

PACKAGE = Path(carom.__file__).parent
OWN = {  # private to Carom: classes that share a file or a folder
    "laws/exact.py": {"_hold"},
    "laws/header.py": {"_rule"},
    "impacts/wear.py": {"_slip_borders"},
    "verify/errors.py": {"_why"},
}
PUBLIC = {"_replace", "_asdict", "_fields", "_make", "_value_", "_exit"}  # documented by Python
NUMBA = {
    "native/emission.py": {
        *("_dynfunc", "_FunctionCompiler", "_codegen", "_data_layout", "_final_module"),
        *("_optimize_functions", "_optimize_final_module", "_get_module_for_linking"),
        *("_get_host_cpu_name", "_get_host_cpu_features"),
    },
    "dimensionless/numerics/kernels.py": {"_numba_type_"},
}
PATCHED = {"_optimize_functions", "_optimize_final_module", "_finalize_specific", "_add_module"}
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


@pytest.mark.parametrize("name", FILES)
def test_only_named_internals_are_read(name):
    found = set(private_names(ast.parse((PACKAGE / name).read_text(encoding="utf-8"))))
    assert found - PUBLIC == OWN.get(name, set()) | NUMBA.get(name, set())


def test_the_internals_of_numba_exist():
    compiled = njit(lambda x: x + 1.0)
    compiled.compile("(float64,)")
    library = CODE(compiled.overloads[compiled.signatures[0]])
    own = registry.cpu_target.target_context.codegen()
    read = {compiled: {"_numba_type_"}, dispatcher: {"_FunctionCompiler"}}
    read[library] = {"_codegen", "_final_module", "_get_module_for_linking", *PATCHED} - {
        "_add_module"
    }
    read[own] = {"_data_layout", "_get_host_cpu_name", "_get_host_cpu_features"}
    read[codegen.JITCPUCodegen], read[codegen.CPUCodeLibrary] = (
        {"_add_module"},
        {"_optimize_functions"},
    )
    read[dispatcher._FunctionCompiler] = {"_customize_flags"}
    read[cpu.CPUContext] = {"get_executable"}
    missing = {
        f"{getattr(owner, '__name__', type(owner).__name__)}.{name}"
        for owner, names in read.items()
        for name in names
        if not hasattr(owner, name)
    }
    assert not missing
    assert {"no_cpython_wrapper", "no_cfunc_wrapper"} <= set(vars(compiler.Flags))
    assert isinstance(own._get_host_cpu_features(), str)
    assert isinstance(library._get_module_for_linking(), binding.ModuleRef)
