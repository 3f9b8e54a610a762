"""Walls as meshes of their own shapes: what a case draws of boxes, planes, cylinders, cones, spheres and prisms is sampled as a distance and
contoured, so that shapes that touch become one and `subtract` and `outside` hold; surfaces out of CAD are taken as they are."""

from pathlib import Path

import numpy as np

LONGEST, MOST_SAMPLES = 110, 3e6  # samples along the longest side of what is shown; of all
SLIVER = 0.2  # of a step: corners nearer than this are one
SPARED = 0.85  # of the triangles, those of flat faces first
SHARP = 20.0  # degrees between faces that are shaded as an edge
OFF, AWAY = 0.137, 0.75  # of a step: so that faces on round numbers do not lie on samples; outside of the shapes


class UnknownShape(Exception):
    """A wall that cannot be drawn by its shapes."""


def rotation(vector):
    """The matrix that turns about a vector by its length [rad]."""
    angle = np.linalg.norm(vector)
    if angle == 0:
        return np.eye(3)
    x, y, z = np.asarray(vector) / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def box_distance(shape, points):
    low, high = np.array(shape["min"], float), np.array(shape["max"], float)
    beyond = np.maximum(low - points, points - high)
    return np.linalg.norm(np.maximum(beyond, 0), axis=1) + np.minimum(beyond.max(axis=1), 0)


def plane_distance(shape, points):
    normal = np.array(shape["normal"], float)
    return (points - np.array(shape["point"])) @ (normal / np.linalg.norm(normal))


def round_distance(shape, points):
    """Of a cylinder or a frustum."""
    start, end = np.array(shape["start"], float), np.array(shape["end"], float)
    length = np.linalg.norm(end - start)
    axis = (end - start) / length
    along = (points - start) @ axis
    across = np.linalg.norm(points - start - along[:, None] * axis, axis=1)
    first, last = (shape.get("radius", 0.0),) * 2 if shape["shape"] == "cylinder" else (shape["start_radius"], shape["end_radius"])
    slope = (last - first) / length
    return np.maximum((across - first - slope * along) / np.hypot(1, slope), np.maximum(-along, along - length))


def sphere_distance(shape, points):
    return np.linalg.norm(points - np.array(shape["center"]), axis=1) - shape["radius"]


def prism_distance(shape, points):
    axis = "xyz".index(shape["along"])
    plane = {0: (1, 2), 1: (0, 2), 2: (0, 1)}[axis]
    flat, corners = points[:, plane], np.array(shape["points"], float)
    nearest, inside = np.full(len(points), np.inf), np.zeros(len(points), bool)
    for a, b in zip(corners, np.roll(corners, -1, axis=0)):
        edge, away = b - a, flat - a
        part = np.clip(away @ edge / (edge @ edge), 0, 1)
        nearest = np.minimum(nearest, np.linalg.norm(away - part[:, None] * edge, axis=1))
        if a[1] != b[1]:
            crosses = (a[1] > flat[:, 1]) != (b[1] > flat[:, 1])
            inside ^= crosses & (flat[:, 0] < edge[0] * (flat[:, 1] - a[1]) / edge[1] + a[0])
    low, high = sorted((shape["from"], shape["to"]))
    return np.maximum(np.where(inside, -nearest, nearest), np.maximum(low - points[:, axis], points[:, axis] - high))


DISTANCES = {"box": box_distance, "plane": plane_distance, "cylinder": round_distance, "frustum": round_distance, "sphere": sphere_distance,
             "prism": prism_distance}


def placed(shape, points):
    """Points of space in the frame of a shape before it was moved and turned."""
    about = np.array(shape.get("rotate_about", [0, 0, 0]), float)
    turned = (points - about) @ rotation(shape.get("rotate", [0, 0, 0])) + about
    return turned - np.array(shape.get("translate", [0, 0, 0]), float)


def distance(wall, points):
    """To the wall, negative inside [m], shape (points,); of its shapes but surfaces out of CAD. The zero is exact, the rest near it."""
    def of(shape):
        if shape.get("shape") not in DISTANCES:
            raise UnknownShape(shape.get("shape"))
        found = DISTANCES[shape["shape"]](shape, placed(shape, points))
        return -found if shape.get("outside") else found

    result = np.full(len(points), np.inf)
    for shape in wall["shapes"]:
        if shape.get("shape") != "stl":
            result = np.minimum(result, of(shape))
    for shape in wall.get("subtract", []):
        result = np.maximum(result, -of(shape))
    return result


def contoured(wall, box, spacing, pyvista, flat=False):
    """The mesh of a wall's shapes in a box, lower and upper corner [m], closed where the box cuts them; None where there is nothing.

    Contoured a step outside of them, where distances are right beside seams and corners too, and drawn in by that step. `flat`: what y = 0 shows, drawn out along y."""
    size = box[1] - box[0]
    step = min(size.max() / LONGEST, spacing)
    step = max(step, (size.prod() / MOST_SAMPLES) ** (1 / 3))
    counts = np.ceil(size / step).astype(int) + 5
    grid = pyvista.ImageData(dimensions=counts, spacing=(step,) * 3, origin=box[0] - (2 + OFF) * step)

    def far(points):
        inside = distance(wall, points * [1, 0, 1] if flat else points)
        return np.maximum(inside, box_distance({"min": box[0], "max": box[1]}, points))

    values = far(np.asarray(grid.points, float))
    if not (values.min() < AWAY * step < values.max()):
        return None
    mesh = grid.contour([AWAY * step], values, method="flying_edges")
    points = np.asarray(mesh.points, float)
    for _ in range(3):  # at an edge of the box one face after the other
        points = points - far(points)[:, None] * slope(far, points, step)
    mesh.points = points
    whole = mesh.clean(tolerance=SLIVER * step, absolute=True, polys_to_lines=False, lines_to_points=False)
    whole = whole.decimate_pro(SPARED, feature_angle=SHARP, preserve_topology=True)
    return shaded(whole, far, step, pyvista)


def slope(far, points, step):
    """Of a distance at some points, shape (points, 3)."""
    here, little = far(points), 1e-3 * step
    return np.stack([far(points + little * axis) - here for axis in np.eye(3)], axis=1) / little


def shaded(mesh, far, step, pyvista):
    """The mesh with corners of each triangle's own, and normals that are those of the shapes there: edges stay sharp, round faces round."""
    corners = np.asarray(mesh.points, float)[mesh.faces.reshape(-1, 4)[:, 1:]]
    middle = corners.mean(axis=1, keepdims=True)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    if far(middle[:, 0] + 0.3 * step * across).sum() < 0:  # the triangles look inwards
        corners, across = corners[:, ::-1], -across
    beside = corners + 0.1 * (middle - corners) + 0.3 * step * across[:, None, :]
    made = pyvista.PolyData(corners.reshape(-1, 3), np.column_stack([np.full(len(corners), 3), np.arange(3 * len(corners)).reshape(-1, 3)]).ravel())
    normals = slope(far, beside.reshape(-1, 3), step)
    made.point_data.active_normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    return made


def plate(mesh, thickness, side, pyvista):
    """Makes a plate of an open surface, on the side that a case names: both faces and the rim."""
    mesh = mesh.clean()
    normals = mesh.compute_normals(split_vertices=False, consistent_normals=False, cell_normals=False).point_data["Normals"]
    first, last = {"back": (0.0, -1.0), "front": (0.0, 1.0), "middle": (-0.5, 0.5)}[side]
    faces, count = mesh.faces.reshape(-1, 4)[:, 1:], mesh.n_points
    points = np.concatenate([mesh.points + shift * thickness * normals for shift in (first, last)])
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    edges, seen = np.unique(edges, axis=0, return_counts=True)
    a, b = edges[seen == 1].T  # of one triangle alone: the rim
    every = np.concatenate([faces, faces + count, np.stack([a, b, b + count], axis=1), np.stack([a, b + count, a + count], axis=1)])
    return pyvista.PolyData(points, np.column_stack([np.full(len(every), 3), every]).ravel())


def surface_of_file(shape, pyvista):
    """The triangles of an STL file where the case puts them [m]. Raises UnknownShape when the file is gone."""
    path = Path(shape["file"])
    if not path.is_file() or shape.get("outside"):
        raise UnknownShape(str(path))
    mesh = pyvista.read(path)
    about = np.array(shape.get("rotate_about", [0, 0, 0]), float)
    points = np.asarray(mesh.points, float) * shape.get("scale", 1.0) + np.array(shape.get("translate", [0, 0, 0]), float)
    mesh.points = (points - about) @ rotation(shape.get("rotate", [0, 0, 0])).T + about
    return plate(mesh, shape["thickness"], shape.get("side", "back"), pyvista) if shape.get("thickness") else mesh


def with_edges(mesh):
    """Triangles with normals, faces at more than SHARP to each other apart."""
    return mesh.triangulate().compute_normals(split_vertices=True, feature_angle=SHARP, cell_normals=False)


def mesh_of(wall, box, spacing, pyvista, flat=False):
    """A wall's mesh by its shapes, or None where the box holds nothing of it. Raises UnknownShape where its shapes cannot be drawn."""
    try:
        files = [with_edges(surface_of_file(shape, pyvista)) for shape in wall["shapes"] if shape.get("shape") == "stl"]
        if files and (flat or wall.get("subtract")):
            raise UnknownShape("a section of a surface out of CAD, or one with parts taken away")
        parts = files + ([contoured(wall, box, spacing, pyvista, flat)] if len(files) < len(wall["shapes"]) else [])
    except KeyError as error:
        raise UnknownShape(str(error)) from error
    parts = [part for part in parts if part is not None and part.n_points]
    return None if not parts else parts[0] if len(parts) == 1 else pyvista.merge(parts, merge_points=False)


def pose(start, now):
    """The rigid motion that takes points to points, shapes (n, 3), by least squares: a matrix and a shift."""
    middle, there = start.mean(axis=0), now.mean(axis=0)
    left, _, right = np.linalg.svd((start - middle).T @ (now - there))
    turn = (left @ np.diag([1, 1, np.sign(np.linalg.det(left @ right))]) @ right).T
    return turn, there - turn @ middle


def moved(mesh, start, now):
    """The mesh where a wall's particles have gone since the start [m]."""
    if start.shape != now.shape or np.array_equal(start, now):
        return mesh
    turn, shift = pose(start, now)
    copy = mesh.copy()
    copy.points = np.asarray(mesh.points, float) @ turn.T + shift
    if (normals := mesh.point_data.active_normals) is not None:
        copy.point_data.active_normals = np.asarray(normals) @ turn.T
    return copy
