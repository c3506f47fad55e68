"""MJCF text of objects of several bodies that belong together."""

MUG = """<body name="mug" pos="1 2 3" euler="20 30 40"><freejoint/>
  <geom name="wall" type="cylinder" size=".04 .05" mass=".4"/>
  <body name="handle" pos=".055 0 0" euler="0 0 90"><geom name="bar" type="box" size=".005 .005 .03" mass=".02"/>
    <body name="knob" pos="0 0 .04"><geom name="ball" size=".005" mass=".01"/></body>
  </body>
</body>"""


BOTTLE = """<body name="bottle"><freejoint/><geom name="wall" type="cylinder" size=".03 .07" mass=".4"/>
  <body name="cap" pos="0 0 .075"><joint name="screw" axis="0 0 1"/><joint name="pull" type="slide"/>
    <geom name="lid" type="box" size=".015 .01 .01" mass=".02"/>
    <body name="ring" pos="0 0 .02"><joint name="flip" axis="0 1 0"/><geom name="loop" size=".004" mass=".001"/></body>
  </body>
</body>"""


KEYS = '<keyframe><key name="open" qpos="0 0 0 1 0 0 0 1.5707963267948966 .1 0"/></keyframe></mujoco>'
