//! Arguments that are a scene: shells offer the names of those built in, and files.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, StringValueParser, TypedValueParser};
use clap::{Arg, Command, Error};

use crate::scene::BUILTIN;

/// Takes any text; the built-in names are only offered.
#[derive(Clone, Copy, Debug)]
pub(super) struct SceneName;

impl TypedValueParser for SceneName {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, Error> {
        StringValueParser::new().parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let names = BUILTIN.iter();
        Some(Box::new(names.map(|scene| PossibleValue::new(scene.name))))
    }
}
