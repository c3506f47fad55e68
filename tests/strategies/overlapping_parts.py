"""An object whose parts overlap."""

from tests.strategies.mjcf_files import world

OVERLAPPING = world(
    '<body name="outer" pos="1 2 3" euler="10 20 30"><freejoint/>'
    '<geom type="box" size=".05 .06 .07"/><geom type="cylinder" size=".04 .1" euler="20 0 0"/>'
    '<body pos=".05 0 0" euler="0 0 70"><geom type="mesh" mesh="lump" euler="1 2 3"/></body></body>',
    '<mesh name="lump" scale=".03 .05 .04" vertex="1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1 .8 .8 .8 -.8 -.8 .8"/>',
)
