"""Rules of the house that import-linter (pyproject.toml) cannot say."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
CORE = sorted((ROOT / "simc_core").rglob("*.py"))
PAGES = sorted((ROOT / "pages").rglob("*.py"))


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


@pytest.mark.parametrize("path", [*CORE, *PAGES], ids=name)
def test_python_control_is_for_interop_alone(path):
    assert not uses(path, "control") or path == ROOT / "simc_core" / "interop.py"


@pytest.mark.parametrize("path", [ROOT / "app.py", *PAGES], ids=name)
def test_session_and_address_are_touched_in_one_module_only(path):
    attributes = {node.attr for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Attribute)}
    assert (
        not {"session_state", "query_params"} & attributes or path == ROOT / "pages" / "common" / "session" / "state.py"
    )


@pytest.mark.parametrize("path", [*CORE, *PAGES], ids=name)
def test_no_imports_inside_functions_and_no_star(path):
    tree = ast.parse(path.read_text())
    functions = [node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    assert not [n for f in functions for n in ast.walk(f) if isinstance(n, ast.Import | ast.ImportFrom)]
    assert not [n for n in ast.walk(tree) if isinstance(n, ast.ImportFrom) and n.names[0].name == "*"]


@pytest.mark.parametrize("path", [*CORE, *PAGES], ids=name)
def test_functions_have_names_and_are_found_by_them(path):
    """No dispatch through functions named _: who reads `margins(cascade)` finds in `margins` what it does."""
    assert "functools.singledispatch" not in imported(path)
    assert not [n for n in ast.walk(ast.parse(path.read_text())) if isinstance(n, ast.FunctionDef) and n.name == "_"]


@pytest.mark.parametrize("path", PAGES, ids=name)
def test_numbers_are_typed_in_one_kind_of_field(path):
    """Streamlit's own number fields drop a decimal comma: parts/number_field.py is for all."""
    attributes = {node.attr for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Attribute)}
    assert not {"number_input", "NumberColumn"} & attributes


@pytest.mark.parametrize("path", PAGES, ids=name)
def test_a_download_starts_no_run(path):
    """A download that is made when asked for waits for an answer, which a run that begins then might lose."""
    calls = [node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Call)]
    for call in calls:
        if isinstance(call.func, ast.Attribute) and call.func.attr == "download_button":
            assert [each.value.value for each in call.keywords if each.arg == "on_click"] == ["ignore"]


def test_no_number_field_of_the_browser_either():
    assert not [path for path in (ROOT / "pages").rglob("*.js") if 'type="number"' in path.read_text()]


def test_the_entry_point_only_starts_the_router():
    assert len((ROOT / "app.py").read_text().splitlines()) <= 25


def test_lines_of_scripts_are_as_short_as_those_of_python():
    scripts = [file for file in (ROOT / "pages").rglob("*.js") if "vendor" not in file.parts]
    assert len(scripts) > 20
    long = [
        f"{file.name}:{n}"
        for file in scripts
        for n, line in enumerate(file.read_text().split("\n"), 1)
        if len(line) > 120
    ]
    assert not long
