//! Which colours a patch needs, and how often: exactly while they are few, and by cells of nearby colours.

use std::collections::TryReserveError;

/// Bits a channel that tell cells apart.
const CELL_BITS: u32 = 6;

/// Cells of the whole colour cube.
pub(super) const CELL_COUNT: usize = 1 << (3 * CELL_BITS);

/// Colours counted exactly: as many as fit a palette beside black and transparent.
pub(super) const EXACT_COLOURS: usize = 254;

/// The cell of a packed colour.
pub(super) fn cell_of(colour: u32) -> usize {
    let [red, green, blue, _] = colour
        .to_le_bytes()
        .map(|c| u32::from(c) >> (8 - CELL_BITS));
    (red << (2 * CELL_BITS) | green << CELL_BITS | blue) as usize
}

/// Counts of the colours of a patch. Black is left out: every palette has it.
pub(super) struct Histogram {
    cells: Vec<Cell>,
    /// Cells with something in them, in order of appearance.
    touched: Vec<u32>,
    /// The different colours, sorted; meaningless once `is_exact` is false.
    colours: Vec<u32>,
    is_exact: bool,
    latest: u32,
}

/// Sums over the pixels of a cell.
#[derive(Clone, Copy, Default)]
pub(super) struct Cell {
    /// Pixels.
    pub(super) count: u32,
    sums: [u64; 3],
}

impl Cell {
    /// The mean colour of the cell's pixels, channels 0 to 255.
    pub(super) fn mean(&self) -> [f32; 3] {
        self.sums.map(|sum| sum as f32 / self.count as f32)
    }
}

/// So many of the same, or an error where there is no room for them.
pub(super) fn filled<T: Clone>(one: T, count: usize) -> Result<Vec<T>, TryReserveError> {
    let mut all = Vec::new();
    all.try_reserve_exact(count)?;
    all.resize(count, one);
    Ok(all)
}

impl Histogram {
    /// # Errors
    /// There is no room for its cells: 8 MiB.
    pub(super) fn new() -> Result<Self, TryReserveError> {
        Ok(Self {
            cells: filled(Cell::default(), CELL_COUNT)?,
            touched: Vec::new(),
            colours: Vec::new(),
            is_exact: true,
            latest: 0,
        })
    }

    pub(super) fn clear(&mut self) {
        for cell in self.touched.drain(..) {
            self.cells[cell as usize] = Cell::default();
        }
        self.colours.clear();
        self.is_exact = true;
        self.latest = 0;
    }

    /// Counts one pixel of a packed colour.
    pub(super) fn add(&mut self, colour: u32) {
        if colour == 0 {
            return;
        }
        if self.is_exact && colour != self.latest {
            self.latest = colour;
            self.remember(colour);
        }
        let cell_number = cell_of(colour);
        let cell = &mut self.cells[cell_number];
        if cell.count == 0 {
            self.touched.push(cell_number as u32);
        }
        cell.count += 1;
        let [red, green, blue, _] = colour.to_le_bytes().map(u64::from);
        cell.sums[0] += red;
        cell.sums[1] += green;
        cell.sums[2] += blue;
    }

    fn remember(&mut self, colour: u32) {
        if let Err(place) = self.colours.binary_search(&colour) {
            if self.colours.len() < EXACT_COLOURS {
                self.colours.insert(place, colour);
            } else {
                self.is_exact = false;
            }
        }
    }

    /// All colours but black, sorted, where there are at most `EXACT_COLOURS`.
    pub(super) fn exact_colours(&self) -> Option<&[u32]> {
        self.is_exact.then_some(&self.colours)
    }

    /// The cells that hold pixels, with their numbers.
    pub(super) fn filled_cells(&self) -> impl Iterator<Item = (usize, &Cell)> {
        self.touched
            .iter()
            .map(|&number| (number as usize, &self.cells[number as usize]))
    }
}
