"""MJCF objects as MuJoCo compiles them: the one room of the planner that knows MuJoCo.

reader            from a file to a rigid object
compiled          the compiled model and the body that is the object; bounded_compile, compile_effort: within limits
body_tree         which bodies belong together; model_tree, body_poses, names: of a compiled model
obj_file, mesh_file, appearance, visual, filled_hollows      meshes and looks, and what is doubtful about them
collision, touch  where MuJoCo collides, and what a small ball touches
decompose, writer convex parts in a file of their own
"""
