"""The rules of the house, held with ast: imports go one way, each library has its place."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CORE = sorted((ROOT / "simc_core").rglob("*.py"))
PAGES = sorted((ROOT / "pages").rglob("*.py"))
ORDER = [
    {"errors"},
    {"checks"},
    {"factors", "polynomials", "realisation"},
    {"plant", "models", "controllers", "realisation", "grid"},
    {"exact", "parse", "notation", "plant_step", "simc", "loop"},
    {"reduction", "dynamics", "zeros", "zeros_1998", "split", "story", "advice"},
    {"characteristic", "term_table", "segments"},
    {"segment_bounds", "winding", "logresponse", "search_grid", "crossings"},
    {"stability", "poles", "margins", "laurent", "nested"},
    {"half_rule", "simulation", "piece_zeros", "metrics", "model_error"},  # the half rule judges by Ms
    {"performance", "robustness", "as_built"},
    {"sweep", "tau_table", "cascade", "direct_synthesis", "fastest", "cascade_design", "nested_performance"},
    {"examples", "reference_values", "references", "cascade_examples"},
]
LEVEL = {name: level for level, names in enumerate(ORDER) for name in names}


def imported(path: Path) -> set[str]:
    """Full names of the modules a file imports, inside functions too."""
    nodes = list(ast.walk(ast.parse(path.read_text())))
    names = {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    for node in (node for node in nodes if isinstance(node, ast.ImportFrom)):
        names |= {node.module or "", *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


def uses(path: Path, library: str) -> bool:
    return any(name == library or name.startswith(library + ".") for name in imported(path))


def name(path: Path) -> str:
    return str(path.relative_to(ROOT))


@pytest.mark.parametrize("path", CORE, ids=name)
def test_core_knows_neither_streamlit_nor_pages_and_plots_only_in_figures(path):
    assert not uses(path, "streamlit")
    assert not uses(path, "pages")
    assert not uses(path, "plotly") or "figures" in path.parts
    assert not uses(path, "control") or path.name == "interop.py"


@pytest.mark.parametrize("path", CORE, ids=name)
def test_core_imports_one_way(path):
    part = path.relative_to(ROOT / "simc_core").parts[0].removesuffix(".py")
    if part in ("__init__", "figures", "interop"):  # these stand above all others
        return
    assert part in LEVEL, "a new module: enter it in ORDER"
    below = {module.split(".")[1] for module in imported(path) if module.startswith("simc_core.")}
    assert not {other for other in below if LEVEL.get(other, 99) > LEVEL[part]}


@pytest.mark.parametrize("path", [ROOT / "app.py", *PAGES], ids=name)
def test_session_and_address_are_touched_in_one_module_only(path):
    attributes = {node.attr for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Attribute)}
    assert (
        not {"session_state", "query_params"} & attributes or path == ROOT / "pages" / "common" / "session" / "state.py"
    )
    assert not uses(path, "control")


@pytest.mark.parametrize("path", [*CORE, *PAGES], ids=name)
def test_no_imports_inside_functions_and_no_star(path):
    tree = ast.parse(path.read_text())
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    assert not [n for f in functions for n in ast.walk(f) if isinstance(n, ast.Import | ast.ImportFrom)]
    assert not [n for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) and n.names[0].name == "*"]


def test_the_entry_point_only_starts_the_router():
    assert len((ROOT / "app.py").read_text().splitlines()) <= 25
