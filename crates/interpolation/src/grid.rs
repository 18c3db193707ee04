//! Where the vertices lie.

use manylights_harmonics::Real;

/// A regular grid of vertices over a box, two or more along each axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid<R> {
    /// The vertex with the smallest coordinates, metres.
    pub origin: [R; 3],
    /// Between neighbours along each axis, metres, positive.
    pub spacing: [R; 3],
    /// Along each axis.
    pub vertices: [usize; 3],
}

/// Where a point lies in a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<R> {
    /// Of its vertex with the smallest coordinates, along each axis.
    pub cell: [usize; 3],
    /// From that vertex, in units of the spacing: 0 to 1.
    pub local: [R; 3],
    /// Whether the point is outside, where the nearest point of the grid stands for it.
    pub is_outside: bool,
}

impl<R: Real> Grid<R> {
    /// Over the box between two corners, so many vertices along each axis.
    ///
    /// # Panics
    /// For fewer than two vertices, or a box without extent along an axis.
    pub fn over([least, most]: [[R; 3]; 2], vertices: [usize; 3]) -> Self {
        assert!(
            vertices.iter().all(|&count| count >= 2),
            "a cell has two vertices along each axis"
        );
        let spacing = [0, 1, 2].map(|i| (most[i] - least[i]) / R::of((vertices[i] - 1) as f64));
        assert!(spacing.iter().all(|&step| step > R::zero()), "a box without extent: {spacing:?}");
        Self { origin: least, spacing, vertices }
    }

    /// Over the box between two corners, in all at most the cube of `vertices`, so spread that cells are near to
    /// cubes: the axis with the largest spacing gets one more as long as they fit. No other numbers have a
    /// smaller largest spacing; a cube has so many along each axis.
    ///
    /// # Panics
    /// As [`over`](Self::over).
    pub fn of_cubes([least, most]: [[R; 3]; 2], vertices: usize) -> Self {
        let sides = [0, 1, 2].map(|i| (most[i] - least[i]).to_f64());
        let spacing = |axis: usize, count: usize| sides[axis] / (count - 1) as f64;
        let mut counts = [2; 3];
        loop {
            let all: usize = counts.iter().product();
            let fits = |axis: &usize| all / counts[*axis] * (counts[*axis] + 1) <= vertices.pow(3);
            let wider =
                |a: &usize, b: &usize| spacing(*a, counts[*a]).total_cmp(&spacing(*b, counts[*b]));
            let Some(widest) = [0, 1, 2].into_iter().filter(fits).max_by(wider) else {
                return Self::over([least, most], counts);
            };
            counts[widest] += 1;
        }
    }

    /// Number of vertices.
    pub fn count(&self) -> usize {
        self.vertices.iter().product()
    }

    /// Position of a vertex in the order of the grid: x fastest.
    pub fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.vertices[1] + y) * self.vertices[0] + x
    }

    /// Of all vertices in the order of the grid, metres.
    pub fn positions(&self) -> impl Iterator<Item = [R; 3]> + '_ {
        (0..self.count()).map(|index| {
            let [width, height, _] = self.vertices;
            let vertex = [index % width, index / width % height, index / (width * height)];
            [0, 1, 2].map(|i| self.origin[i] + R::of(vertex[i] as f64) * self.spacing[i])
        })
    }

    /// Where a point lies. Of a point on a face it is the cell with the smaller coordinates' upper neighbour,
    /// but for the last face.
    pub fn place(&self, point: [R; 3]) -> Place<R> {
        let along = |i: usize| {
            let cells = self.vertices[i] - 1;
            let position = (point[i] - self.origin[i]) / self.spacing[i];
            let inside = position.max(R::zero()).min(R::of(cells as f64));
            let cell = inside.floor().to_usize().unwrap_or(0).min(cells - 1);
            (cell, inside - R::of(cell as f64), inside != position)
        };
        let axes = [0, 1, 2].map(along);
        Place {
            cell: axes.map(|(cell, _, _)| cell),
            local: axes.map(|(_, local, _)| local),
            is_outside: axes.iter().any(|&(_, _, moved)| moved),
        }
    }

    /// The corners of a cell in the order of the grid, in the order of [`Weights`](crate::Weights).
    pub fn corners(&self, cell: [usize; 3]) -> [usize; 8] {
        [0, 1, 2, 3, 4, 5, 6, 7]
            .map(|corner| self.index([0, 1, 2].map(|i| cell[i] + (corner >> i & 1))))
    }
}
