"""What MuJoCo simulates: an object that floats, and an end effector that touches it.

units            the experiment's own metre and newton
physics          how contacts and solver are set
floating_object  the object: its geoms (part_geom), its inertia, how it may move (object_joints)
fingertips       an end effector: spheres that slide
scene            both, composed and compiled
static_check     does every fingertip touch what was planned?
"""
