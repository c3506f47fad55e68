"""Does a ball on a straight path keep clear of a convex set?

Along the path, the distance f(t) of the ball's centre from a convex set is convex. Two of its tangents, one falling
and one rising, meet below its minimum and near it: if they meet above the radius, the path is clear; if f is below
the radius there, it is not; else the tangent there takes the place of one of the two. Source: Kelley, The
cutting-plane method for solving convex programs (1960), in one dimension.
"""

from collections.abc import Callable

from planner.arrays import Floats
from planner.limits.obstacles import Obstacle
from planner.objects.vectors import norm, unit

MOST_TANGENTS = 60
"""Tangents drawn before a minimum so near to the level counts as below it."""


def keeps_clear(obstacle: Obstacle, start: Floats, end: Floats, radius: float) -> bool:
    """Whether every point of a segment is at least `radius` away from a convex set.

    Exact but for the rounding of nearest points, and false where undecided.

    Args:
        obstacle: The set.
        start: Shape (d,) [m].
        end: Shape (d,), another point [m].
        radius: Positive [m].
    """
    direction = unit(end - start)

    def distance(along: float) -> tuple[float, float]:
        point = start + along * direction
        away = point - obstacle.nearest(point)
        return float(norm(away)), float(direction @ unit(away))

    return stays_above(distance, float(norm(end - start)), radius)


def stays_above(function: Callable[[float], tuple[float, float]], end: float, level: float) -> bool:
    """Whether a convex function is nowhere below a level.

    Args:
        function: Its value and a slope of it at a point of [0, end].
        end: Positive.
        level: The level.
    """
    left, right = 0.0, end
    (left_value, left_slope), (right_value, right_slope) = function(left), function(right)
    if min(left_value, right_value) < level:
        return False
    for _ in range(MOST_TANGENTS):
        if left_slope >= 0 or right_slope <= 0:  # the minimum is at that end
            return True
        rise = right_value - left_value - left_slope * (right - left)  # of the right end above the left tangent
        meet = right - rise / (right_slope - left_slope)
        if left_value + left_slope * (meet - left) >= level:
            return True
        value, slope = function(meet)
        if value < level:
            return False
        if slope < 0:
            left, left_value, left_slope = meet, value, slope
        else:
            right, right_value, right_slope = meet, value, slope
    return False
