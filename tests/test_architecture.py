"""The house keeps its shape: arrows point down, every room has a caption, no function asks for too much."""

import ast
import inspect
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from tests.tools.commands import ROOT

FLOORS = (
    ("planner.errors", "planner.arrays", "planner.counted", "planner.millimetres", "planner.progress"),
    ("planner.files",),
    ("planner.contacts",),
    ("planner.contact_models",),
    ("planner.objects",),
    ("planner.wrench_sets",),
    ("planner.task",),
    ("planner.forces",),
    ("planner.candidates",),
    ("planner.search",),
    ("planner.limits",),
    ("planner.grasps",),
    ("planner.grasp_problem",),
    ("planner.verification",),
    ("planner.planning",),
    ("planner.exchange",),
    ("planner.pictures",),
    ("planner.terminal",),
    ("planner.commands",),
    ("sim.scene",),
    ("sim.trial",),
    ("sim.validation",),
    ("sim.squeeze", "sim.benches"),
    ("sim.studies",),
    ("sim.report", "sim.render"),
    ("sim.view",),
    ("sim.commands",),
)
"""The house from the ground up: a room may use those on its floor and on floors below."""

MOST_PARAMETERS = 6
"""What a function may ask for, `self` aside."""

FILES = sorted(path for package in ("planner", "sim") for path in (ROOT / package).rglob("*.py"))


def floor_of(module: str) -> int | None:
    """The floor of a module; None for the two front doors."""
    for floor, rooms in enumerate(FLOORS):
        if any(f"{module}.".startswith(f"{room}.") for room in rooms):
            return floor
    return None


def module_of(path: Path) -> str:
    """Its dotted name."""
    return ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")


def imports(tree: ast.AST) -> Iterator[str]:
    """Modules of this project that a file imports, wherever in it and for whatever purpose."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


@cache
def parsed(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def test_arrows_point_down() -> None:
    for path in FILES:
        module = module_of(path)
        floor = floor_of(module)
        if module in ("planner", "sim"):
            continue  # the front doors open on every floor
        assert floor is not None, f"{module} is on no floor: add its room to FLOORS"
        for used in imports(parsed(path)):
            if used.split(".")[0] in ("planner", "sim"):
                below = floor_of(used)
                assert below is not None, f"{module} imports the front door {used}"
                assert below <= floor, f"{module} (floor {floor}) imports {used} (floor {below})"


def test_no_two_files_import_each_other_in_a_circle() -> None:
    graph = {module_of(path): set(top_level_imports(path)) for path in FILES}
    done: set[str] = set()

    def visit(module: str, path: tuple[str, ...]) -> None:
        assert module not in path, f"a circle: {' -> '.join((*path, module))}"
        if module in done or module not in graph:
            return
        for used in sorted(graph[module]):
            visit(used, (*path, module))
        done.add(module)

    for module in sorted(graph):
        visit(module, ())


def top_level_imports(path: Path) -> Iterator[str]:
    """What a file needs to be imported itself: imports inside functions and for the type checker are left out."""
    for node in parsed(path).body:
        yield from imports(node) if isinstance(node, ast.Import | ast.ImportFrom) else ()


def test_every_file_says_what_it_is() -> None:
    for path in FILES:
        caption = ast.get_docstring(parsed(path))
        assert caption, f"{path} has no caption"
        assert len(inspect.cleandoc(caption).splitlines()[0]) <= 120, f"{path} has a long caption"


def test_no_function_asks_for_too_much() -> None:
    for path in FILES:
        for node in ast.walk(parsed(path)):
            if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
                arguments = node.args
                names = [each.arg for each in (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)]
                asked = [name for name in names if name not in ("self", "cls")]
                assert len(asked) <= MOST_PARAMETERS, f"{path}: {node.name} takes {len(asked)}: {', '.join(asked)}"


def test_every_array_says_what_it_holds() -> None:
    for package in ("planner", "sim", "scripts", "tests"):
        for path in sorted((ROOT / package).rglob("*.py")):
            bare = arrays_of_anything(parsed(path))
            assert not bare or path.name == "restricted_pickle.py", f"{path}, lines {bare}: see planner/arrays.py"


def arrays_of_anything(tree: ast.AST) -> list[int]:
    """Lines that name NumPy's class itself, which mypy takes for an array of anything."""
    return [node.lineno for node in ast.walk(tree) if isinstance(node, ast.Attribute) and node.attr == "ndarray"]


def test_no_test_module_imports_another() -> None:
    for path in (ROOT / "tests").rglob("test_*.py"):
        for used in imports(parsed(path)):
            assert not used.rpartition(".")[2].startswith("test_"), f"{path} imports {used}"


def test_a_circle_and_an_upward_arrow_would_be_seen() -> None:
    forces, search = floor_of("planner.forces.minimax"), floor_of("planner.search.cuts")
    assert forces is not None and search is not None and forces < search
    assert list(imports(ast.parse("def f():\n    from sim.scene import scene"))) == ["sim.scene"]


def test_an_array_of_anything_would_be_seen() -> None:
    assert arrays_of_anything(ast.parse("Rule = Callable[[Floats], np.ndarray]\ndef f(x: np.ndarray | None): ...")) == [
        1,
        2,
    ]
