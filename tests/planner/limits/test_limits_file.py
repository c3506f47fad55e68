"""What a limits file may say, and how it is refused."""

from math import inf
from pathlib import Path

import numpy as np
import pytest

from planner.errors import LimitsError
from planner.files.toml_file import MAX_FILE_BYTES
from planner.limits.limits import Approach, Finger, Limits, Table, Zone
from planner.limits.limits_file import read_limits
from planner.objects.object_file import read_object_file
from planner.objects.rigid_object import RigidObject
from tests.strategies.parts import NAME, box, rigid_object
from tests.strategies.planar_objects import RECTANGLE, planar_object
from tests.tools.commands import ASSETS

EVERYTHING = f"""
spacing = 0.015
span = 0.12
exclude_geoms = ["pa*", "{NAME}"]
[[keep_out]]
lower = [0, -inf, 0]
upper = [1, inf, 0.5]
[table]
normal = [0, 0, 2]
height = -0.02
clearance = 0.008
[approach]
radius = 0.008
length = 0.06
[[finger]]
strength = 2
geoms = ["{NAME}"]
torsion = 0.0035
[[finger]]
patch = 0.004
within = {{lower = [0, 0, 0], upper = [1, 1, 1]}}
"""


def brick() -> RigidObject:
    return rigid_object(box((0.03, 0.02, 0.01)))


def written(folder: Path, text: str) -> Path:
    path = folder / "hand.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_file_may_say_everything(tmp_path: Path) -> None:
    limits = read_limits(written(tmp_path, EVERYTHING), brick())
    assert limits == Limits(
        spacing=0.015,
        span=0.12,
        exclude_geoms=("pa*", NAME),
        keep_out=(Zone(lower=(0, -inf, 0), upper=(1, inf, 0.5)),),
        table=Table(normal=(0, 0, 2), height=-0.02, clearance=0.008),
        approach=Approach(radius=0.008, length=0.06),
        fingers=(
            Finger(strength=2, geoms=(NAME,), torsion=0.0035),
            Finger(within=Zone(lower=(0, 0, 0), upper=(1, 1, 1)), patch=0.004),
        ),
    )
    np.testing.assert_array_equal(limits.strengths, [2, 1])


def test_a_file_may_say_nothing(tmp_path: Path) -> None:
    assert read_limits(written(tmp_path, ""), brick()) == Limits()
    assert Limits().strengths.shape == (0,)
    assert (Limits().spacing, Limits().span) == (0, inf)


@pytest.mark.parametrize("path", sorted((ASSETS / "limits").glob("*.toml")), ids=lambda path: path.stem)
def test_the_shipped_files_fit_the_assets_of_their_names(path: Path) -> None:
    limits = read_limits(path, read_object_file(ASSETS / path.stem / f"{path.stem}.xml"))
    assert limits.table is not None
    assert limits.approach is not None


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("spacing = ", "Invalid value"),
        ("spacings = 1", "unknown field `spacings`"),
        ("[table]\nnormal = [0, 0, 1]\nclearence = 1", r"`clear(e|a)nce`.*\$\.table"),
        ("spacing = '1'", r"Expected `float`, got `str` - at `\$\.spacing`"),
        ("spacing = -0.1", r"spacing is -0\.1; it must not be negative"),
        ("spacing = nan", "spacing is nan"),
        ("spacing = inf", "spacing is inf; .* at most 1e.06 m"),
        ("span = 0", "span is 0.0; .* must be positive"),
        ("span = nan", "span is nan"),
        ("span = 0.1\nspacing = 0.2", r"span is 0\.1; .* not less than the least, spacing = 0\.2 m"),
        ("exclude_geoms = 'handle'", r"Expected `array`, got `str` - at `\$\.exclude_geoms`"),
        ("exclude_geoms = ['handle']", f"the object has no geom 'handle'; it has {NAME}"),
        ("[[finger]]\ngeoms = ['P*']", rf"no geom 'P\*'; it has {NAME}"),
        ("[[keep_out]]\nlower = [0, 0, 0]", "missing required field `upper`"),
        ("[[keep_out]]\nlower = [0, 0]\nupper = [1, 1]", "keep_out.lower has 2 numbers; points of this object have 3"),
        ("[[keep_out]]\nlower = [0, 0]\nupper = [1, 1, 1]", "every coordinate of lower must be less"),
        ("[[keep_out]]\nlower = [0]\nupper = [1]", "lower has 1 numbers; it must have 3, or 2 for a planar object"),
        ("[[keep_out]]\nlower = [0, 0, 1]\nupper = [1, 1, 1]", r"lower \[0.0, 0.0, 1.0\] to upper .* must be less"),
        ("[[keep_out]]\nlower = [0, 0, nan]\nupper = [1, 1, 1]", r"lower is \[0.0, 0.0, nan\]; .* must be a number"),
        ("[table]\nnormal = [0, 1]\nclearance = 1", "table.normal has 2 numbers; points of this object have 3"),
        ("[table]\nnormal = [0, 0, 0]\nclearance = 1", "table.normal is .*; its length must be between"),
        ("[table]\nnormal = [0, 0, inf]\nclearance = 1", "table.normal is .*; its length must be between"),
        ("[table]\nnormal = [0, 0, nan]\nclearance = 1", "table.normal is .* must be a number"),
        ("[table]\nnormal = [0, 0, 1]\nclearance = 0", r"table.clearance is 0\.0; it must be positive"),
        ("[table]\nnormal = [0, 0, 1]\nclearance = 1\nheight = inf", "table.height is inf; it must be finite"),
        ("[approach]\nradius = 0\nlength = 1", r"approach.radius is 0\.0; it must be positive and at most"),
        ("[approach]\nradius = 1\nlength = -1", r"approach.length is -1\.0; it must be positive"),
        ("[approach]\nradius = 1\nlength = inf", "approach.length is inf; it must be positive"),
        ("[approach]\nradius = 1", "missing required field `length`"),
        ("[finger]\nstrength = 1", r"Expected `array`, got `object` - at `\$\.finger`"),
        ("[[finger]]\nstrength = 0", r"strength is 0\.0; it must be positive"),
        ("[[finger]]\nstrength = nan", "strength is nan"),
        ("[[finger]]\ngeoms = []", "geoms are an empty list; leave geoms out"),
        ("[[finger]]\nwithin = {lower = [0, 0], upper = [1, 1]}", "finger.within.lower has 2 numbers"),
        ("[[finger]]\ntorsion = 0.002\npatch = 0.004", "torsion 0.002 and patch 0.004 both say .*give one of them"),
        ("[[finger]]\ntorsion = -0.002", r"a finger's torsion is -0\.002; it is a length, 0 or more"),
        ("[[finger]]\npatch = nan", "a finger's patch is nan"),
        ("[[finger]]\npatch = 1e5", r"a finger's patch is 100000\.0; .* at most 10000 m"),
        (9 * "[[finger]]\n", r"9 tables \[\[finger\]\]; at most 8"),
        ("a = " + 5000 * "[", "limits file"),
        ("spacing = 1" + 400 * "0", "limits file"),
        ("spacing = 0 #" + MAX_FILE_BYTES * "#", f"larger than {MAX_FILE_BYTES} bytes"),
    ],
)
def test_a_broken_file_is_refused_with_its_name_and_what_is_allowed(tmp_path: Path, text: str, message: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(LimitsError, match=message) as caught:
        read_limits(path, brick())
    assert str(path) in str(caught.value)


def test_limits_are_read_from_a_path_given_as_text(tmp_path: Path) -> None:
    assert read_limits(str(written(tmp_path, "span = 0.1")), brick()).span == 0.1


def test_a_complaint_about_the_content_shows_a_whole_file_that_works(tmp_path: Path) -> None:
    with pytest.raises(LimitsError) as caught:
        read_limits(written(tmp_path, "spam = 0.1"), brick())
    _, sample = str(caught.value).split("can be: ")
    assert read_limits(written(tmp_path, sample), brick()).span == 0.12


def test_a_planar_object_has_planar_limits(tmp_path: Path) -> None:
    planar = planar_object(RECTANGLE)
    path = written(tmp_path, "[table]\nnormal = [0, 1]\nclearance = 0.01")
    assert read_limits(path, planar).table == Table(normal=(0, 1), clearance=0.01)
    with pytest.raises(LimitsError, match=r"table\.normal has 3 numbers; points of this object have 2"):
        read_limits(written(tmp_path, "[table]\nnormal = [0, 0, 1]\nclearance = 0.01"), planar)
    with pytest.raises(LimitsError, match="about the normal, which is for objects in space"):
        read_limits(written(tmp_path, "[[finger]]\npatch = 0.004"), planar)
    assert read_limits(written(tmp_path, "[[finger]]\ntorsion = 0"), planar).fingers == (Finger(torsion=0),)


@pytest.mark.parametrize("path", ["nowhere.toml", ".", "a\0b", 5000 * "x"])
def test_what_is_no_file_is_refused(path: str) -> None:
    with pytest.raises(LimitsError, match="cannot be read"):
        read_limits(Path(path), brick())


def test_a_file_that_is_no_text_is_refused(tmp_path: Path) -> None:
    (tmp_path / "hand.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(LimitsError, match="limits file"):
        read_limits(tmp_path / "hand.toml", brick())
