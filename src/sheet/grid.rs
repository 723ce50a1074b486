//! Which things lie near a place: a grid over the drawing, so that a label asks its neighbours only.

use std::ops::ControlFlow;

use kurbo::{Point, Rect};

use super::overlap::clip;

/// Side of a cell, mm: about a label.
const CELL: f64 = 4.0;
/// What the borders of cells may miss by rounding, mm.
const ROUNDING: f64 = 1e-6;
/// Cells at most, about; on larger paper the cells grow. A strip of many metres has as many as a square: where they grew with
/// its length alone a long chain's names would lie in some few of them, and each would be asked for by all.
const MOST: f64 = 65_536.0;

/// No entry.
const NONE: u32 = 0;

/// Numbered things by the cells that they touch.
#[derive(Debug, Default)]
pub(super) struct Grid {
    area: Rect,
    cell: f64,
    columns: usize,
    rows: usize,
    /// The first entry of each cell; counted from one, as all entries are.
    first: Vec<u32>,
    entries: Vec<Entry>,
    /// The first of the entries that were taken away.
    vacant: u32,
}

/// A thing in a cell.
#[derive(Debug, Clone, Copy)]
struct Entry {
    id: u32,
    next: u32,
}

/// Who was found already in the query that is being answered: a thing lies in many cells.
#[derive(Debug, Default)]
pub(super) struct Met {
    in_query: Vec<u32>,
    query: u32,
}

impl Met {
    /// Begins a query among so many things.
    pub(super) fn begin(&mut self, count: usize) {
        if self.in_query.len() < count || self.query == u32::MAX {
            self.in_query = vec![0; count.max(2 * self.in_query.len())];
            self.query = 0;
        }
        self.query += 1;
    }

    /// Whether a thing is met for the first time.
    pub(super) fn first_time(&mut self, id: usize) -> bool {
        self.in_query
            .get_mut(id)
            .is_some_and(|in_query| std::mem::replace(in_query, self.query) != self.query)
    }
}

impl Grid {
    /// An empty grid over this area; what lies outside is kept in the cells of its edge.
    pub(super) fn new(area: Rect) -> Self {
        let (width, height) = (area.width(), area.height());
        let cell = CELL.max((width * height / MOST).sqrt()).max(width / MOST).max(height / MOST);
        let count = |length: f64| (length / cell).clamp(0.0, MOST) as usize + 1;
        let (columns, rows) = (count(width), count(height));
        let first = vec![NONE; columns * rows];
        Self { area, cell, columns, rows, first, entries: Vec::new(), vacant: NONE }
    }

    /// An empty one over the same area.
    pub(super) fn blank(&self) -> Self {
        Self::new(self.area)
    }

    /// How many entries its cells have.
    #[cfg(test)]
    pub(super) fn entries(&self) -> usize {
        self.entries.len()
    }

    fn column(&self, x: f64) -> usize {
        ((x - self.area.x0) / self.cell).clamp(0.0, (self.columns - 1) as f64) as usize
    }

    fn row(&self, y: f64) -> usize {
        ((y - self.area.y0) / self.cell).clamp(0.0, (self.rows - 1) as f64) as usize
    }

    fn touched(&self, own: Rect) -> impl Iterator<Item = usize> + use<> {
        let columns = self.columns;
        let (left, right) = if columns == 0 { (1, 0) } else { (self.column(own.x0), self.column(own.x1)) };
        let rows = if columns == 0 { 0..0 } else { self.row(own.y0)..self.row(own.y1) + 1 };
        rows.flat_map(move |row| (left..=right).map(move |column| row * columns + column))
    }

    fn put(&mut self, id: usize, cell: usize) {
        let Ok(id) = u32::try_from(id) else { return };
        let entry = Entry { id, next: self.first[cell] };
        self.first[cell] = match self.vacant {
            NONE => {
                self.entries.push(entry);
                self.entries.len() as u32
            }
            vacant => {
                self.vacant = self.entry(vacant).next;
                self.entries[vacant as usize - 1] = entry;
                vacant
            }
        };
    }

    fn entry(&self, at: u32) -> Entry {
        self.entries[at as usize - 1]
    }

    /// Adds a thing that fills a box.
    pub(super) fn add(&mut self, id: usize, own: Rect) {
        for cell in self.touched(own) {
            self.put(id, cell);
        }
    }

    /// Adds a stroke; `half` is half its width.
    pub(super) fn add_stroke(&mut self, id: usize, a: Point, b: Point, half: f64) {
        let own = Rect::from_points(a, b).inflate(half, half);
        for cell in self.touched(own) {
            if self.meets(cell, a, b, half) {
                self.put(id, cell);
            }
        }
    }

    fn each<V>(&self, cell: usize, visit: &mut V) -> ControlFlow<()>
    where
        V: FnMut(usize) -> ControlFlow<()>,
    {
        let mut at = self.first[cell];
        while at != NONE {
            let entry = self.entry(at);
            visit(entry.id as usize)?;
            at = entry.next;
        }
        ControlFlow::Continue(())
    }

    /// Visits what may touch a stroke grown by `half`, until it is told to stop; something more than once.
    pub(super) fn visit_along<V>(&self, a: Point, b: Point, half: f64, mut visit: V) -> ControlFlow<()>
    where
        V: FnMut(usize) -> ControlFlow<()>,
    {
        let own = Rect::from_points(a, b).inflate(half, half);
        // Most cells of a sheet are empty.
        let mut cells =
            self.touched(own).filter(|cell| self.first[*cell] != NONE && self.meets(*cell, a, b, half));
        cells.try_for_each(|cell| self.each(cell, &mut visit))
    }

    /// Visits what may touch a box, until it is told to stop; something more than once.
    pub(super) fn visit<V>(&self, own: Rect, mut visit: V) -> ControlFlow<()>
    where
        V: FnMut(usize) -> ControlFlow<()>,
    {
        self.touched(own).try_for_each(|cell| self.each(cell, &mut visit))
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
            let (mut before, mut at) = (NONE, self.first[cell]);
            while at != NONE {
                let Entry { id: other, next } = self.entry(at);
                if other as usize == id {
                    match before {
                        NONE => self.first[cell] = next,
                        before => self.entries[before as usize - 1].next = next,
                    }
                    self.entries[at as usize - 1].next = self.vacant;
                    self.vacant = at;
                } else {
                    before = at;
                }
                at = next;
            }
        }
    }

    /// The things among the first `count` that may touch a box and are `wanted`, each once, in their order.
    pub(super) fn near(
        &self,
        own: Rect,
        count: usize,
        met: &mut Met,
        into: &mut Vec<usize>,
        mut wanted: impl FnMut(usize) -> bool,
    ) {
        into.clear();
        met.begin(count);
        let _ = self.visit(own, |id| {
            if met.first_time(id) && wanted(id) {
                into.push(id);
            }
            ControlFlow::Continue(())
        });
        into.sort_unstable();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of many metres has cells about as large as a label, and no more of them than large paper has.
    #[test]
    fn long_paper_has_small_cells() {
        for (width, height) in [(200.0, 300.0), (16_000.0, 80.0), (100_000.0, 0.0), (90_000.0, 90_000.0)] {
            let grid = Grid::new(Rect::new(0.0, 0.0, width, height));
            let cells = grid.columns * grid.rows;
            assert!(cells <= 4 * MOST as usize, "{width} by {height}: {cells} cells");
            assert!(grid.cell <= CELL || cells as f64 > 0.9 * MOST, "{width} by {height}: {}", grid.cell);
        }
        assert!(Grid::new(Rect::new(0.0, 0.0, 16_000.0, 80.0)).cell < 1.2 * CELL);
    }

    #[test]
    fn a_box_finds_what_touches_it_and_what_lies_beyond_the_edge() {
        let mut grid = Grid::new(Rect::new(0.0, 0.0, 100.0, 50.0));
        grid.add_stroke(0, Point::new(0.0, 0.0), Point::new(100.0, 50.0), 0.25);
        grid.add(1, Rect::new(60.0, 10.0, 65.0, 12.0));
        grid.add(2, Rect::new(300.0, 300.0, 301.0, 301.0));
        let near = |grid: &Grid, own| {
            let mut found = Vec::new();
            grid.near(own, 3, &mut Met::default(), &mut found, |_| true);
            found
        };
        assert_eq!(near(&grid, Rect::new(49.0, 24.0, 51.0, 26.0)), [0]);
        assert_eq!(near(&grid, Rect::new(62.0, 9.0, 66.0, 13.0)), [1]);
        assert_eq!(near(&grid, Rect::new(250.0, 250.0, 310.0, 310.0)), [0, 2]);
        grid.remove(1, Rect::new(60.0, 10.0, 65.0, 12.0));
        assert!(near(&grid, Rect::new(62.0, 9.0, 66.0, 13.0)).is_empty());
        assert!(near(&Grid::default(), Rect::new(0.0, 0.0, 1.0, 1.0)).is_empty());
        grid.add(1, Rect::new(60.0, 10.0, 65.0, 12.0));
        assert_eq!(near(&grid, Rect::new(62.0, 9.0, 66.0, 13.0)), [1]);
    }
}
