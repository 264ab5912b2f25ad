//! A difference in words.

use std::fmt;

use super::{Difference, Place, Sign};

impl fmt::Display for Sign {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Statistics(expected, got) => {
                write!(f, "statistics: expected {expected:?}, got {got:?}")
            }
            Self::StateDigest(expected, got) => {
                write!(
                    f,
                    "digest of the state: expected {expected:016x}, got {got:016x}"
                )
            }
            Self::ImageDigest(expected, got) => {
                write!(
                    f,
                    "digest of the image: expected {expected:016x}, got {got:016x}"
                )
            }
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = self.expected.len().max(self.got.len());
        writeln!(f, "stage:   {}", self.stage)?;
        writeln!(
            f,
            "buffer:  {} ({} of {words} words differ)",
            self.buffer, self.differing_words
        )?;
        write!(f, "element: {}", self.element)?;
        if self.expected.len() != self.got.len() {
            let (expected, got) = (self.expected.len(), self.got.len());
            write!(f, "\nlength:  expected {expected} words, got {got}")?;
        }
        if !self.other_buffers.is_empty() {
            write!(f, "\nalso:    {}", self.other_buffers.join(", "))?;
        }
        Ok(())
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "frame:   {}", self.frame)?;
        writeln!(f, "seen in: {}", self.sign)?;
        match &self.place {
            Some(place) => place.fmt(f),
            None => write!(
                f,
                "stage:   unknown; run again, stage by stage, the frame came out equal, so the \
                 difference depends on timing or on chance"
            ),
        }
    }
}
