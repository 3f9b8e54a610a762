"""The free surface as a smooth mesh, shaded, among the walls: pictures of one view at some times.

The mesh is that of pysplashsurf (weighted smoothing: F. Loeschner et al., Eurographics 2023); VTK draws it off screen."""

import numpy as np

from plotting import walls as shapes

LONGEST, FINER, EDGE = 1200, 2, 0.02  # pixels along the longer side of a view, each the mean of FINER x FINER drawn; its white edge, a share
RADIUS, SMOOTHING, CUBE, THRESHOLD = 0.5, 2.0, 0.6, 0.6  # of a particle in spacings; the others in radii
SMOOTHINGS, WALL_SMOOTHINGS, NORMALS = 15, 25, 8
WALL, WHITE, VEIL = "#c3c9cf", 255, 0.3  # VEIL: how much of a wall is seen where it hides fluid


class SurfaceError(Exception):
    """There is nothing to draw a surface with, or of; the message says what."""


def tools():
    """pysplashsurf and pyvista. Raises SurfaceError when one is missing."""
    try:
        import pysplashsurf
        import pyvista
    except ImportError as missing:
        raise SurfaceError(f"{missing}: `scripts/install --pictures` brings what draws surfaces") from missing
    return pysplashsurf, pyvista


def moves(wall):
    """Whether a wall of the case moves."""
    return wall.get("motion", {}).get("type", "rest") != "rest"


class Meshes:
    """Surfaces of a run's fluid and walls, in metres: walls by the shapes of the case, else by their particles. What does not change is
    meshed once."""

    def __init__(self, run, quantity, cube=CUBE):
        self._splash, self.pyvista = tools()
        self.run, self.quantity, self._cube = run, quantity, cube
        self._shapes, self._joined, self._particles = {}, (None, None), (None, None)

    def _surface(self, positions, values, smoothings):
        origin = positions.mean(axis=0)  # single precision is used inside
        made, _ = self._splash.reconstruction_pipeline(
            np.ascontiguousarray(positions - origin), attributes_to_interpolate={"value": np.ascontiguousarray(values, float)},
            particle_radius=RADIUS * self.run.spacing, smoothing_length=SMOOTHING, cube_size=self._cube,
            iso_surface_threshold=THRESHOLD, mesh_cleanup=True, decimate_barnacles=True, mesh_smoothing_iters=smoothings,
            compute_normals=True, normals_smoothing_iters=NORMALS)
        faces = np.asarray(made.mesh.triangles).astype(np.int64)
        mesh = self.pyvista.PolyData(np.asarray(made.mesh.vertices) + origin,
                                     np.column_stack([np.full(len(faces), 3), faces]).ravel())
        mesh.point_data["value"] = np.asarray(made.point_attributes["value"])
        return mesh

    def fluid(self, step):
        positions = self.run.fluid.positions(step)
        if len(positions) == 0:
            return None
        return self._surface(positions, self.quantity.factor * self.quantity.values[step], SMOOTHINGS)

    def walls(self, step, box):
        """Of what is in a box, lower and upper corner [m], as one mesh; None where there is nothing."""
        if self.run.walls is None:
            return None
        at = min(step, len(self.run.walls.times) - 1)
        now, start = self.run.walls.positions(at), self.run.walls.positions(0)
        if "Wall" not in self.run.walls.names:
            return self._of_particles(now, box)
        which, first = self.run.walls.field("Wall", at), self.run.walls.field("Wall", 0)
        walls = self.run.case.get("wall", [])
        parts, rest = [], which >= len(walls)  # inlets have walls of their own
        for number, wall in enumerate(walls):
            its, began = now[which == number], start[first == number]
            if len(its) == 0:
                continue
            try:
                mesh = self._of_shapes(number, wall, began, box)
                parts.append(shapes.moved(mesh, began, its))
            except shapes.UnknownShape:
                rest |= which == number
        return self._join([*parts, self._of_particles(now[rest], box)])

    def _of_shapes(self, number, wall, began, box):
        """A wall at the start: of one that moves all that the domain shows, of one at rest what is in the box."""
        if number not in self._shapes:
            if moves(wall):
                box = np.array([began.min(axis=0), began.max(axis=0)]) + np.array([[-0.6], [0.6]]) * self.run.spacing
            self._shapes[number] = shapes.mesh_of(wall, box, self.run.spacing, self.pyvista, self.run.dimensions == 2)
        if self._shapes[number] is None:
            raise shapes.UnknownShape("nothing of it is in the box")
        return self._shapes[number]

    def _join(self, parts):
        """One mesh; the same one where the parts are the same."""
        parts = [part for part in parts if part is not None]
        known, mesh = self._joined
        if known is None or len(known) != len(parts) or any(a is not b for a, b in zip(known, parts)):
            mesh = None if not parts else parts[0] if len(parts) == 1 else self.pyvista.merge(parts, merge_points=False)
            self._joined = (parts, mesh)
        return mesh

    def _of_particles(self, positions, box):
        positions = positions[((positions > box[0]) & (positions < box[1])).all(axis=1)]
        if len(positions) == 0:
            return None
        known, mesh = self._particles
        if known is None or known.shape != positions.shape or not np.array_equal(known, positions):
            mesh = self._surface(positions, np.zeros(len(positions)), WALL_SMOOTHINGS)
            self._particles = (positions, mesh)
        return mesh


def direction(flat):
    """To the viewer: as in the oblique view of the particles; along y in two dimensions."""
    if flat:
        return np.array([0.0, -1.0, 0.0])
    azimuth, elevation = np.radians([-38, 24])
    return np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])


def box_of(runs, steps):
    """Lower and upper corner of what is shown: the fluid at all steps of all runs, and some spacings of walls around it."""
    every, margin = [], 0.0
    for run, its_steps in zip(runs, steps):
        every += [run.fluid.positions(step) for step in its_steps]
        margin = max(margin, 4.5 * run.spacing)
    every = np.concatenate([p for p in every if len(p)] or [np.zeros((1, 3))])
    low, high = np.quantile(every, [0.001, 0.999], axis=0)  # single drops may be far away
    return np.array([low - margin, high + margin])


def axes_of(flat):
    """Unit vectors of a view to the right, up, and to the viewer."""
    towards = direction(flat)
    right = np.cross([0, 0, 1], towards)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(towards, right), towards])


def frame_of(runs, steps, box):
    """What a view of a box holds, and walls that move near it: lowest and highest place to the right, and up [m], shape (2, 2)."""
    right, up, _ = axes_of(runs[0].dimensions == 2)
    corners = np.stack(np.meshgrid(*box.T), axis=-1).reshape(-1, 3)
    low, high = box - 0.6 * np.array([[1], [-1]]) * (box[1] - box[0])
    for run, its_steps in zip(runs, steps):
        moving = [k for k, wall in enumerate(run.case.get("wall", [])) if moves(wall)] if run.walls and "Wall" in run.walls.names else []
        for step in its_steps if moving else []:
            at = min(step, len(run.walls.times) - 1)
            points = run.walls.positions(at)[np.isin(run.walls.field("Wall", at), moving)]
            corners = np.concatenate([corners, np.clip(points, low, high)])
    flat = corners @ np.array([right, up]).T
    edge = EDGE * np.ptp(flat, axis=0).max()
    return np.array([flat.min(axis=0) - edge, flat.max(axis=0) + edge])


def taken(window):
    """What a window of VTK has drawn: colours, shape (down, across, 3), and depth from 0, near, to 1, where nothing is."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
    found = []
    for depth in (False, True):
        reader = vtkWindowToImageFilter()
        reader.SetInput(window)
        reader.ShouldRerenderOff()
        reader.ReadFrontBufferOff()
        reader.SetInputBufferTypeToZBuffer() if depth else reader.SetInputBufferTypeToRGB()
        reader.Update()
        image = reader.GetOutput()
        across, down, _ = image.GetDimensions()
        found.append(vtk_to_numpy(image.GetPointData().GetScalars()).reshape(down, across, -1)[::-1].copy())
    return found[0], found[1][:, :, 0]


class Camera:
    """One view of a box, the same at all times, that holds a frame: pictures of `longest` pixels along the longer side, on white."""

    def __init__(self, meshes, box, frame, longest=LONGEST):
        self._meshes, self._box, self._frame = meshes, box, frame
        self._flat = meshes.run.dimensions == 2
        size = frame[1] - frame[0]
        self._pixels = tuple(int(n) for n in np.maximum(2 * np.round(longest / 2 * size / size.max()), 2))  # across, down
        self._of_walls = (None, None)

    def _shot(self, mesh, **look):
        """Colours, shape (down, across, 3), and the distance from the viewer [m], infinite where nothing is."""
        plotter = self._meshes.pyvista.Plotter(off_screen=True, window_size=[FINER * n for n in self._pixels])
        plotter.set_background("white")
        plotter.add_mesh(mesh, smooth_shading=True, show_scalar_bar=False, **look)
        right, up, towards = axes_of(self._flat)
        middle = self._frame.mean(axis=0)
        size, depth = np.linalg.norm(self._box[1] - self._box[0]), self._box.mean(axis=0) @ towards
        centre = middle[0] * right + middle[1] * up + depth * towards
        plotter.camera_position = [centre + 3 * size * towards, centre, (0, 0, 1)]
        plotter.enable_parallel_projection()
        plotter.parallel_scale = (self._frame[1] - self._frame[0])[1] / 2
        near, far = 0.1 * size, 8 * size
        plotter.camera.clipping_range = (near, far)
        plotter.ren_win.Render()
        colours, depth = taken(plotter.ren_win)
        plotter.close()
        return colours, np.where(depth < 1, near + (far - near) * depth, np.inf).astype(np.float32)

    def _fluid(self, mesh):
        quantity = self._meshes.quantity
        return self._shot(mesh, scalars="value", cmap=quantity.map, clim=quantity.limits, specular=0.3, specular_power=15, ambient=0.25)

    def _walls(self, mesh):
        if self._of_walls[0] is not mesh:
            self._of_walls = (mesh, self._shot(mesh, color=WALL, ambient=0.35, diffuse=0.75))
        return self._of_walls[1]

    def picture(self, step):
        """The fluid among the walls; a wall is a veil where it hides fluid. Shape (down, across, 3), bytes."""
        across, down = self._pixels
        shape = (FINER * down, FINER * across)
        colours, depth = np.full((*shape, 3), WHITE, np.uint8), np.full(shape, np.inf, np.float32)
        fluid, walls = self._meshes.fluid(step), self._meshes.walls(step, self._box)
        if fluid is not None:
            colours, depth = self._fluid(fluid)
        if walls is not None:
            solid, place = self._walls(walls)
            before = place < depth
            veiled = before & np.isfinite(depth) & (not self._flat)
            plain = before & ~veiled
            colours[plain] = solid[plain]
            colours[veiled] = (VEIL * solid[veiled].astype(np.float32) + (1 - VEIL) * colours[veiled]).astype(np.uint8)
        return colours.reshape(down, FINER, across, FINER, 3).mean(axis=(1, 3), dtype=np.float32).astype(np.uint8)


def cropped(pictures):
    """Cuts the same white edges off all."""
    used = np.any([np.any(p < 250, axis=2) for p in pictures], axis=0)
    rows, columns = np.flatnonzero(used.any(axis=1)), np.flatnonzero(used.any(axis=0))
    if len(rows) == 0:
        return pictures
    edge = LONGEST // 80
    top, left = max(rows[0] - edge, 0), max(columns[0] - edge, 0)
    return [p[top:rows[-1] + edge, left:columns[-1] + edge] for p in pictures]
