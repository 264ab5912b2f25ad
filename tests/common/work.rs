//! How much work the kernels of a device list for those after them, told from the state alone.

use motes::gpu::dispatch::dispatch_for;
use motes::layout::Counts;

/// How a run is cut into pages and workgroups.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    pub(crate) workgroup_size: u32,
    pub(crate) page_len: u32,
    pub(crate) page_count: u32,
}

impl Cut {
    /// As a device cuts pools of `capacity` particles into pages of at most `page_bytes`.
    pub(crate) fn new(workgroup_size: u32, page_bytes: u64, capacity: u32) -> Self {
        let page_len =
            (page_bytes / 32 / 2048 * 2048).min(u64::from(capacity).next_multiple_of(2048)) as u32;
        Self {
            workgroup_size,
            page_len,
            page_count: capacity.div_ceil(page_len),
        }
    }

    fn triple(&self, invocations: u32) -> [u32; 3] {
        let (x, y) = dispatch_for(invocations, self.workgroup_size);
        [x, y, u32::from(invocations > 0)]
    }

    /// Particles of a page among the first `count`.
    fn of_page(&self, page: u32, count: u32) -> u32 {
        count
            .saturating_sub(page * self.page_len)
            .min(self.page_len)
    }

    /// Dispatches for the scan's two levels, then emit's and cull's, page by page.
    pub(crate) fn after_offsets(&self, counts: &Counts) -> Vec<u32> {
        let words = counts.total.div_ceil(32);
        let runs = words.div_ceil(64);
        let newborns = |page| self.of_page(page, counts.total) - self.of_page(page, counts.live);
        let culled = |page| self.of_page(page, counts.total).div_ceil(32);
        let pages = 0..self.page_count;
        [runs, runs.div_ceil(64)]
            .into_iter()
            .chain(pages.clone().map(newborns))
            .chain(pages.map(culled))
            .flat_map(|invocations| self.triple(invocations))
            .collect()
    }

    /// Dispatches for the splat, page by page, then the advance's for every pair of pages: those
    /// present in the source where it has survivors that go to the target, of a page with a second
    /// target those to the end of the word that has the last who go to the first.
    pub(crate) fn after_pages(&self, alive: &[bool]) -> Vec<u32> {
        let live = alive.iter().filter(|alive| **alive).count() as u32;
        let mut list: Vec<u32> = (0..self.page_count)
            .map(|page| self.of_page(page, live))
            .collect();
        let mut place = 0;
        for source in 0..self.page_count {
            let present = self.of_page(source, alive.len() as u32);
            let start = (source * self.page_len) as usize;
            let mut lasts = vec![None; self.page_count as usize];
            let of_page = alive.iter().skip(start).take(present as usize);
            for (at, _) in of_page.enumerate().filter(|(_, alive)| **alive) {
                lasts[(place / self.page_len) as usize] = Some(at as u32);
                place += 1;
            }
            let of = |target: u32| {
                let Some(last) = lasts[target as usize] else {
                    return 0;
                };
                let goes_on = lasts[target as usize + 1..].iter().any(Option::is_some);
                let reached = if goes_on {
                    (last / 32 + 1) * 32
                } else {
                    present
                };
                reached.min(present)
            };
            list.extend((0..=source).map(of));
        }
        list.into_iter()
            .flat_map(|invocations| self.triple(invocations))
            .collect()
    }
}
