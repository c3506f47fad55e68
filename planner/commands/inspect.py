"""`grasp-inspect`: what the planner sees of an object."""

from dataclasses import dataclass
from pathlib import Path

from planner.commands.object_options import ObjectOptions
from planner.terminal.command_line import ExitCode, Given, parse, run


@dataclass(frozen=True, kw_only=True)
class Options(ObjectOptions):
    """What does the planner see? The first thing to type when something looks wrong.

    Lists the bodies of an object's file, the geoms that collide, mass, size and surface, how well candidates fit, and
    every warning there is.
    """

    candidates: str = "300"
    """Where fingers may go, as in grasp-plan."""

    fingertip: Given[float] = None
    """Radius in metres of the fingertip that must fit beside other parts' walls; by default 0.5 % of the object's
    size."""

    seed: int = 0
    """Seed of the even candidates."""

    out: Given[Path] = None
    """A picture to draw, NAME.png: edges of what collides, and the candidates (needs the extra `plots`)."""


def inspect_command(options: Options) -> ExitCode:
    """Print what is seen, from the file to the candidates; what cannot be read ends the list with its reason."""
    from planner.candidates.choice import make_candidates
    from planner.commands.inspect_report import bodies, candidate_lines, object_lines, planar_lines
    from planner.files.atomic_write import require_writable  # here: the help must not wait for MuJoCo
    from planner.objects.object_file import PLANAR, read_object_file
    from planner.objects.rigid_object import RigidObject
    from planner.pictures.figures import save_figure
    from planner.pictures.object_picture import object_picture
    from planner.terminal.warnings_as_logs import heard_warnings

    if options.out is not None:
        require_writable(options.out)
    print(f"file        {options.object}")
    with heard_warnings() as warnings:
        try:
            if options.object.suffix.lower() != PLANAR:
                print("\n".join(bodies(options.source)))
            seen = read_object_file(options.source)
            print("\n".join(object_lines(seen) if isinstance(seen, RigidObject) else planar_lines(seen)))
            candidates = make_candidates(seen, options.candidates, None, options.seed, options.fingertip)
            print("\n".join(candidate_lines(seen, candidates, options.fingertip)))
        finally:
            print("\n".join(f"warning     {warning}" for warning in warnings) or "warning     none")
    if options.out is not None:
        save_figure(options.out, object_picture(seen, candidates.contacts, f"{len(candidates)} candidates"))
        print(f"wrote       {options.out}")
    return ExitCode.DONE


def main() -> None:
    """Entry point of `grasp-inspect`."""
    options = parse(Options, "grasp-inspect")
    run(lambda: inspect_command(options))
