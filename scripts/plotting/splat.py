"""Particles as shaded balls of their true size, in orthographic projection, drawn into a z-buffer."""

import numpy as np

OVERSAMPLING = 3  # pixels of the buffer along a pixel of the picture


class View:
    """An orthographic camera. `right`, `up` and `towards` (the viewer) are unit vectors in space."""

    def __init__(self, right, up):
        self.right = np.asarray(right, float)
        self.up = np.asarray(up, float)
        self.towards = np.cross(self.right, self.up)

    @staticmethod
    def oblique(azimuth, elevation):
        """Seen from a direction: `azimuth` from +x towards +y, `elevation` above the horizon, in degrees."""
        a, e = np.radians([azimuth, elevation])
        return View((-np.sin(a), np.cos(a), 0),
                    (-np.cos(a) * np.sin(e), -np.sin(a) * np.sin(e), np.cos(e)))

    def project(self, positions):
        """Coordinates across, up and towards the viewer, shape (particles, 3)."""
        return positions @ np.stack([self.right, self.up, self.towards], axis=1)


class Canvas:
    """A z-buffer over the rectangle `box` = (left, right, bottom, top), at `scale` pixels of the picture a metre."""

    def __init__(self, box, scale):
        self._left, right, self._bottom, top = box
        self._scale = scale * OVERSAMPLING
        width = max(1, round((right - self._left) * scale)) * OVERSAMPLING
        height = max(1, round((top - self._bottom) * scale)) * OVERSAMPLING
        self.depth = np.full((height, width), -np.inf)  # towards the viewer, in buffer pixels
        self.owner = np.full((height, width), -1)       # index of the particle seen, -1: none
        self.facing = np.zeros((height, width))         # cosine between the ball's surface and the viewer

    def splat(self, points, radius):
        """Draws balls of one radius; `points` as View.project gives them, in metres."""
        height, width = self.depth.shape
        reach = max(0.5, radius * self._scale)
        margin = int(np.ceil(reach))
        column = np.floor((points[:, 0] - self._left) * self._scale).astype(int)
        row = np.floor((points[:, 1] - self._bottom) * self._scale).astype(int)
        inside = (column >= margin) & (column < width - margin) & (row >= margin) & (row < height - margin)
        index = np.flatnonzero(inside)
        index = index[np.argsort(points[index, 2])]
        # Of balls with their centre on one pixel only the nearest shows: the last one wins.
        top = np.full(self.depth.size, -1)
        top[row[index] * width + column[index]] = index
        pixel = np.flatnonzero(top >= 0)
        self._stamp(pixel, top[pixel], points[top[pixel], 2] * self._scale, reach)

    def _stamp(self, pixel, particle, depth, reach):
        steps = np.arange(-int(reach), int(reach) + 1)
        down, across = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
        inside = down**2 + across**2 <= reach**2
        offset = (down * self.depth.shape[1] + across)[inside]
        bulge = np.sqrt(reach**2 - (down**2 + across**2)[inside])
        # Either way no pixel is written twice in one turn: centres lie on different pixels, and so do offsets.
        if len(pixel) < len(offset):
            for ball in range(len(pixel)):
                self._put(pixel[ball] + offset, depth[ball] + bulge, particle[ball], bulge / reach)
        else:
            for part in range(len(offset)):
                self._put(pixel + offset[part], depth + bulge[part], particle, bulge[part] / reach)

    def _put(self, target, depth, particle, facing):
        depths = self.depth.ravel()
        nearer = depth > depths[target]
        seen = target[nearer]
        depths[seen] = depth[nearer]
        for field, value in ((self.owner, particle), (self.facing, facing)):
            field.ravel()[seen] = np.broadcast_to(value, target.shape)[nearer]

    def shadow(self, relief):
        """Brightness 0..1 of each pixel: whatever stands behind something near it is darker. `relief`: a step
        in depth, in metres, that shows clearly."""
        step = relief * self._scale
        hidden = np.zeros_like(self.depth)
        filled = np.isfinite(self.depth)
        depth = np.where(filled, self.depth, self.depth[filled].min() if filled.any() else 0)
        for distance in (2, 5, 10):
            for across, down in ((1, 0), (-1, 0), (0, 1), (0, -1)):
                rise = np.roll(depth, (down * distance, across * distance), (0, 1)) - depth
                hidden += np.clip(rise / step, 0, 1)
        return np.exp(-0.09 * hidden)

    def picture(self, colours, relief, rim):
        """RGBA of shape (height, width, 4), smoothed to the resolution of the picture, row 0 at the bottom.
        `colours`: RGB of each particle; `relief`: see shadow(), None for no shadows; `rim`: how much the balls
        darken to their rims, 0..1."""
        seen = self.owner >= 0
        brightness = 1 - rim * (1 - self.facing)
        if relief is not None:
            brightness *= self.shadow(relief)
        rgba = np.zeros(self.owner.shape + (4,))
        rgba[seen, :3] = colours[self.owner[seen]] * brightness[seen, None]
        rgba[seen, 3] = 1
        height, width = self.owner.shape
        blocks = rgba.reshape(height // OVERSAMPLING, OVERSAMPLING, width // OVERSAMPLING, OVERSAMPLING, 4)
        mean = blocks.mean(axis=(1, 3))
        cover = mean[..., 3:]
        mean[..., :3] = np.divide(mean[..., :3], cover, out=np.ones_like(mean[..., :3]), where=cover > 0)
        return mean
