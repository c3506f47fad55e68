"""Where fingers may go, as points: evenly spread, on grids, listed, the paper's; confirmed by MuJoCo.

candidates        points, normals, friction, parts
choice            from what a user writes ("300", "grid:0.01", "case3", a file) to one of
even, farthest, grid, case3, listed      one way to choose per file; edges: no finger on an edge
confirmed         does MuJoCo touch the object there?
"""
