//! How the JSON of a record is laid out, so that people can read it and diffs stay small.

use std::io;

use serde_json::ser::{Formatter, PrettyFormatter};

/// A key a line, but numbers of an array on one.
#[derive(Default)]
pub(super) struct Readable {
    lines: PrettyFormatter<'static>,
    /// For each array that is open, whether it has stayed on one line.
    arrays: Vec<bool>,
    /// A value of an array is about to be written; whether it is the first.
    pending: Option<bool>,
}

type Done = io::Result<()>;

impl Readable {
    /// Before a scalar: on the line of the one before.
    fn scalar<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        match self.pending.take() {
            Some(false) => to.write_all(b", "),
            _ => Ok(()),
        }
    }

    /// Before an object or an array: on a line of its own.
    fn compound<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        match self.pending.take() {
            Some(first) => {
                if let Some(flat) = self.arrays.last_mut() {
                    *flat = false;
                }
                self.lines.begin_array_value(to, first)
            }
            None => Ok(()),
        }
    }
}

macro_rules! scalars {
    ($($write:ident($value:ty)),*) => {$(
        fn $write<W: ?Sized + io::Write>(&mut self, to: &mut W, value: $value) -> Done {
            self.scalar(to)?;
            self.lines.$write(to, value)
        }
    )*};
}

impl Formatter for Readable {
    scalars!(
        write_bool(bool),
        write_u32(u32),
        write_u64(u64),
        write_f64(f64)
    );

    fn write_null<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.scalar(to)?;
        self.lines.write_null(to)
    }

    fn begin_string<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.scalar(to)?;
        self.lines.begin_string(to)
    }

    fn begin_array<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.compound(to)?;
        self.arrays.push(true);
        self.lines.begin_array(to)
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.arrays.pop();
        self.lines.end_array(to)
    }

    fn begin_array_value<W: ?Sized + io::Write>(&mut self, _: &mut W, first: bool) -> Done {
        // What goes before it depends on what it is.
        self.pending = Some(first);
        Ok(())
    }

    fn end_array_value<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        match self.arrays.last() {
            Some(false) => self.lines.end_array_value(to),
            _ => Ok(()),
        }
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.compound(to)?;
        self.lines.begin_object(to)
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.lines.end_object(to)
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, to: &mut W, first: bool) -> Done {
        self.lines.begin_object_key(to, first)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.lines.begin_object_value(to)
    }

    fn end_object_value<W: ?Sized + io::Write>(&mut self, to: &mut W) -> Done {
        self.lines.end_object_value(to)
    }
}
