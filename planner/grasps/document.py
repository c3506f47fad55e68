"""The published shape of a grasp file: its keys, types and units. Reading and writing are in `grasp_file`."""

from typing import Annotated

import msgspec

from planner.candidates.candidates import CandidateChoice
from planner.files.source_file import SourceFile
from planner.grasps.grasp import ProofCheck, SearchRecord
from planner.search.result import Status

FORMAT = "rhograsp.grasp"
FORMAT_VERSION = 3

Positive = Annotated[float, msgspec.Meta(gt=0)]
Count = Annotated[int, msgspec.Meta(ge=0)]
Vector = list[float]


class ObjectRecord(msgspec.Struct, frozen=True, kw_only=True):
    """The object the grasp is for."""

    mjcf: str
    """Path of the object's file (MJCF, or a planar outline), relative to the grasp file's folder where possible."""
    sha256: str
    body: str
    mass: float
    center_of_mass: Vector | None = None
    """Body frame [m]; null in files of before it was kept."""
    given_mass: float | None = None
    """What the user gave in place of the file's mass [kg]."""
    given_center_of_mass: Vector | None = None
    """What the user gave in place of the file's centre of mass, body frame [m]."""
    locked_joints: list[str] = []
    """Joints between the object's bodies that are frozen, by name, or "all"; empty for none."""
    keyframe: str | None = None
    """Keyframe of the object's file at which they are frozen; null for its initial configuration qpos0."""


class TaskRecord(msgspec.Struct, frozen=True, kw_only=True):
    """The required external force set."""

    name: str
    preset: str | None = None
    """The preset that it is on this object, where it was chosen by that name."""
    file: SourceFile | None = None
    """The task file that it was read from; with neither preset nor file, the wrenches are the caller's own."""
    reference_point: Vector
    """Point that moments are about, body frame [m]."""
    wrenches: list[Vector]
    """Vertices, (force, moment) in body axes [N, N m]."""


class ContactRecord(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """One fingertip contact; a hard finger where torsion is left out."""

    position: Vector
    normal: Vector
    """Inward unit normal."""
    friction: Positive
    geom: str
    candidate: Count
    strength: Positive | None = None
    """The finger here must be able to push with strength times rho; left out where it is 1."""
    torsion: Positive | None = None
    """Torsional friction gamma: most torque about the normal per normal force [m]; left out where there is none."""


class KindRecord(msgspec.Struct, frozen=True, kw_only=True):
    """Fingers that are alike, and how many of the candidates are for them, whose torsional friction is theirs."""

    fingers: Annotated[int, msgspec.Meta(ge=1)]
    candidates: Annotated[int, msgspec.Meta(ge=1)]
    strength: Positive


class CandidatesRecord(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Where fingers might have gone: one row or number for each candidate."""

    positions: list[Vector]
    normals: list[Vector]
    """Inward unit normals."""
    friction: Vector
    torsion: Vector | None = None
    """Torsional friction gamma [m]; left out where no finger has any."""


class CertificateRecord(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """All candidates, and the cuts that prove the lower bound.

    The bound is about all subsets of candidates with the right number of fingers of each kind and whose distances keep
    spacing and span.
    """

    candidates: CandidatesRecord
    cuts: list[Vector]
    """Directions lambda, (force, moment) in body axes."""
    kinds: list[KindRecord] = []
    """Kinds of fingers, whose candidates follow each other; left out where all fingers are alike."""
    spacing: Positive | None = None
    """Least distance between two contacts [m]; left out where there is none."""
    span: Positive | None = None
    """Greatest distance between two contacts [m]; left out where there is none."""


class PlannerRecord(msgspec.Struct, frozen=True, kw_only=True):
    """What made the file."""

    version: str
    packages: dict[str, str]
    command: str | None = None
    """The command line, as a shell takes it; null where the grasp was made from Python."""


class GraspDocument(msgspec.Struct, frozen=True, kw_only=True):
    """A grasp file. Positions, normals and forces in the body frame, SI.

    rho is the force level: finger i must be able to push with strength_i rho, its strength being 1 where not given.

    forces[j] and torques[j] balance task.wrenches[j]: sum f = -force and
    sum (p - reference_point) x f + torque normal = -moment.
    """

    format: str
    format_version: int
    object: ObjectRecord
    task: TaskRecord
    contacts: list[ContactRecord]
    """Empty when the status is infeasible or no grasp was found."""
    rho: float | None
    """The force level needed, the largest |f_i| / strength_i [N]; null without contacts."""
    lower_bound: float
    """Proven lower bound on rho of every subset of the candidates [N]."""
    gap: float | None
    """rho / lower_bound - 1; null without contacts."""
    status: Status
    critical_wrench: int | None
    """Index of the wrench that needs rho."""
    phi: Vector
    """Least force level for each wrench [N]."""
    forces: list[list[Vector]]
    """Contact forces, one row of forces per wrench [N]."""
    torques: list[Vector] | None = None
    """Torques of the contacts about their inward normals, one row per wrench [N m]; null where no finger has torsional
    friction."""
    candidate_choice: CandidateChoice | None = None
    """How the candidates were chosen; null where it is not known."""
    search: SearchRecord
    certificate: CertificateRecord
    proof_check: ProofCheck | None = None
    """What was checked of the certificate when the grasp was planned; null where that is not known, or no bound is
    claimed."""
    planner: PlannerRecord
