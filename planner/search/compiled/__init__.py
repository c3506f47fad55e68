"""The loops of the search that are worth compiling: they run once per node or per candidate.

Each has a plain NumPy twin in the tests that it must agree with. They are plain loops over arrays because those compile
in a second or two, once per machine.
"""
