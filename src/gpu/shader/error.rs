//! What can be wrong with a shader, and where.

use std::fmt;

/// Where in a WGSL file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Location {
    /// Path from the repository's root, e.g. `wgsl/particles/advance.wgsl`.
    pub file: String,
    /// Line in that file, from 1.
    pub line: u32,
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Finding {
    /// Where it is.
    pub at: Location,
    /// What was found.
    pub found: String,
    /// What to use instead; may be empty where `found` says it all.
    pub instead: String,
}

/// Which step refused the shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// No such file is listed in `sources.rs`.
    Find,
    /// Preprocessing, parsing or validation.
    Compose,
    /// The rules of exactness, see `lint.rs`.
    Lint,
    /// Bindings, immediates, entry point.
    Reflect,
    /// Writing SPIR-V or WGSL from the checked module.
    Write,
}

/// A shader was refused; every finding of the step that refused it is listed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderError {
    /// The shader's name, e.g. `particles/advance`.
    pub shader: String,
    /// Which step refused it.
    pub step: Step,
    /// What is wrong, sorted by file and line; at least one.
    pub findings: Vec<Finding>,
}

impl ShaderError {
    pub(super) fn new(shader: &str, step: Step, mut findings: Vec<Finding>) -> Self {
        findings.sort();
        findings.dedup();
        Self {
            shader: shader.to_owned(),
            step,
            findings,
        }
    }

    pub(super) fn one(shader: &str, step: Step, at: Location, found: String) -> Self {
        let finding = Finding {
            at,
            found,
            instead: String::new(),
        };
        Self::new(shader, step, vec![finding])
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.at, self.found)?;
        if !self.instead.is_empty() {
            write!(f, "; {}", self.instead)?;
        }
        Ok(())
    }
}

impl fmt::Display for ShaderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let step = match self.step {
            Step::Find => "is not known",
            Step::Compose => "does not compile",
            Step::Lint => "is not exact",
            Step::Reflect => "does not meet its contract with the host",
            Step::Write => "cannot be written",
        };
        write!(f, "shader `{}` {step}", self.shader)?;
        for finding in &self.findings {
            write!(f, "\n  --> {finding}")?;
        }
        Ok(())
    }
}

impl std::error::Error for ShaderError {}
