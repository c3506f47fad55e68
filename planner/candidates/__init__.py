"""Where fingers may go, as points: spread evenly, in opposed pairs, on grids, listed, the paper's; confirmed by MuJoCo.

candidates        points, normals, friction, parts
choice            from what a user writes ("300", "antipodal:300", "grid:0.01", "case3", a file) to one of
even, antipodal, grid, case3, listed      one way to choose per file; edges: no finger on an edge
farthest          how points are spread
confirmed         does MuJoCo touch the object there?
"""
