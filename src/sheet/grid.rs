//! Which things lie near a place: a grid over the drawing, so that a label asks its neighbours only.

use kurbo::{Point, Rect};

use super::overlap::clip;

/// Side of a cell, mm: about a label.
const CELL: f64 = 4.0;
/// What the borders of cells may miss by rounding, mm.
const ROUNDING: f64 = 1e-6;
/// Cells along a side at most; on larger paper the cells grow.
const MOST: f64 = 256.0;

/// Numbered things by the cells that they touch.
#[derive(Debug, Default)]
pub(super) struct Grid {
    area: Rect,
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<usize>>,
}

impl Grid {
    /// An empty grid over this area; what lies outside is kept in the cells of its edge.
    pub(super) fn new(area: Rect) -> Self {
        let cell = CELL.max(area.width() / MOST).max(area.height() / MOST);
        let count = |length: f64| (length / cell).floor().clamp(0.0, MOST) as usize + 1;
        let (columns, rows) = (count(area.width()), count(area.height()));
        Self { area, cell, columns, rows, cells: vec![Vec::new(); columns * rows] }
    }

    fn column(&self, x: f64) -> usize {
        ((x - self.area.x0) / self.cell).floor().clamp(0.0, (self.columns - 1) as f64) as usize
    }

    fn row(&self, y: f64) -> usize {
        ((y - self.area.y0) / self.cell).floor().clamp(0.0, (self.rows - 1) as f64) as usize
    }

    fn touched(&self, own: Rect) -> impl Iterator<Item = usize> + use<> {
        let columns = self.columns;
        let (left, right) = if columns == 0 { (1, 0) } else { (self.column(own.x0), self.column(own.x1)) };
        let rows = if columns == 0 { 0..0 } else { self.row(own.y0)..self.row(own.y1) + 1 };
        rows.flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }

    /// Adds a thing that fills a box.
    pub(super) fn add(&mut self, id: usize, own: Rect) {
        for cell in self.touched(own) {
            self.cells[cell].push(id);
        }
    }

    /// Adds a stroke; `half` is half its width.
    pub(super) fn add_stroke(&mut self, id: usize, a: Point, b: Point, half: f64) {
        let own = Rect::from_points(a, b).inflate(half, half);
        for cell in self.touched(own) {
            if self.meets(cell, a, b, half) {
                self.cells[cell].push(id);
            }
        }
    }

    /// Adds to `into` what may touch a stroke grown by `half`; something more than once.
    pub(super) fn find_along(&self, a: Point, b: Point, half: f64, into: &mut Vec<usize>) {
        let own = Rect::from_points(a, b).inflate(half, half);
        for cell in self.touched(own).filter(|cell| self.meets(*cell, a, b, half)) {
            into.extend_from_slice(&self.cells[cell]);
        }
    }

    /// Adds to `into` what may touch a box; something more than once.
    pub(super) fn find(&self, own: Rect, into: &mut Vec<usize>) {
        for cell in self.touched(own) {
            into.extend_from_slice(&self.cells[cell]);
        }
    }

    /// Whether a stroke grown by `half` touches a cell. The cells of the edge reach on for ever.
    fn meets(&self, cell: usize, a: Point, b: Point, half: f64) -> bool {
        let (row, column) = (cell / self.columns, cell % self.columns);
        let edge = row == 0 || column == 0 || row + 1 == self.rows || column + 1 == self.columns;
        let corner = (self.area.x0 + column as f64 * self.cell, self.area.y0 + row as f64 * self.cell);
        let grown = half + ROUNDING;
        edge || clip(a, b, Rect::from_origin_size(corner, (self.cell, self.cell)).inflate(grown, grown))
            .is_some()
    }

    /// Takes away a thing that was added with this box.
    pub(super) fn remove(&mut self, id: usize, own: Rect) {
        for cell in self.touched(own) {
            self.cells[cell].retain(|other| *other != id);
        }
    }

    /// The things that may touch a box, each once, in their order.
    pub(super) fn near(&self, own: Rect, into: &mut Vec<usize>) {
        into.clear();
        self.find(own, into);
        into.sort_unstable();
        into.dedup();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_finds_what_touches_it_and_what_lies_beyond_the_edge() {
        let mut grid = Grid::new(Rect::new(0.0, 0.0, 100.0, 50.0));
        grid.add_stroke(0, Point::new(0.0, 0.0), Point::new(100.0, 50.0), 0.25);
        grid.add(1, Rect::new(60.0, 10.0, 65.0, 12.0));
        grid.add(2, Rect::new(300.0, 300.0, 301.0, 301.0));
        let near = |grid: &Grid, own| {
            let mut found = Vec::new();
            grid.near(own, &mut found);
            found
        };
        assert_eq!(near(&grid, Rect::new(49.0, 24.0, 51.0, 26.0)), [0]);
        assert_eq!(near(&grid, Rect::new(62.0, 9.0, 66.0, 13.0)), [1]);
        assert_eq!(near(&grid, Rect::new(250.0, 250.0, 310.0, 310.0)), [0, 2]);
        grid.remove(1, Rect::new(60.0, 10.0, 65.0, 12.0));
        assert!(near(&grid, Rect::new(62.0, 9.0, 66.0, 13.0)).is_empty());
        assert!(near(&Grid::default(), Rect::new(0.0, 0.0, 1.0, 1.0)).is_empty());
    }
}
