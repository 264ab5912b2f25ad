//! From naga's spans back to files and lines.
//!
//! naga_oil parses each module behind a generated header that declares its imports, and adds the
//! module's number, shifted by [`SPAN_SHIFT`], to every span. A span therefore tells the module,
//! and an offset into header and preprocessed text. The header's length is found from an anchor,
//! a declaration whose place in the text is known: a constant that is added to the shader itself,
//! any function of a library. Preprocessing keeps lines, so a line of the preprocessed text is a
//! line of the file.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::sync::LazyLock;

use naga_oil::compose::preprocess::Preprocessor;
use naga_oil::compose::{Composer, ShaderDefValue};

use super::error::Location;
use super::mangle;

/// Bits of a span below the module's number; naga_oil 0.23's private constant of this name.
const SPAN_SHIFT: u32 = 21;

/// Name of the constant that anchors the shader itself.
pub(super) const ANCHOR: &str = "motes_anchor";

static PREPROCESSOR: LazyLock<Preprocessor> = LazyLock::new(Preprocessor::default);

/// Where each module's text begins in naga's spans.
pub(super) struct Locator {
    shader_defs: HashMap<String, ShaderDefValue>,
    files: HashMap<usize, File>,
}

struct File {
    path: String,
    text: String,
    /// A declaration's offset in its module's spans, and how it reads.
    anchor: Option<(usize, String)>,
    preprocessed: OnceCell<Preprocessed>,
}

struct Preprocessed {
    text: String,
    /// Length of the generated header before it; `None` where there is no anchor.
    header_len: Option<usize>,
}

impl Locator {
    /// The shader's text with an anchor behind its last line.
    pub(super) fn anchored(text: &str) -> String {
        format!("{text}\nconst {ANCHOR}: u32 = 0u;\n")
    }

    /// Prepares the look-up for a module that `composer` made of `text`.
    pub(super) fn new(
        composer: &Composer,
        file: &str,
        text: &str,
        shader_defs: HashMap<String, ShaderDefValue>,
        module: &naga::Module,
    ) -> Self {
        let new_file = |path: &str, text: &str| File {
            path: path.to_owned(),
            text: text.to_owned(),
            anchor: None,
            preprocessed: OnceCell::new(),
        };
        let own = new_file(file, &text.replace("\r\n", "\n"));
        let mut files = HashMap::from([(0, own)]);
        for (index, name) in &composer.module_index {
            if let Some(set) = composer.module_sets.get(name) {
                files.insert(*index, new_file(&set.file_path, &set.sanitized_source));
            }
        }
        let mut anchor = |span: naga::Span, declaration: String| {
            let start = span.to_range().map_or(0, |range| range.start);
            if let Some(file) = files.get_mut(&(start >> SPAN_SHIFT)) {
                let place = (offset_in_module(start), declaration);
                file.anchor.get_or_insert(place);
            }
        };
        for (handle, constant) in module.constants.iter() {
            if constant.name.as_deref() == Some(ANCHOR) {
                let span = module.constants.get_span(handle);
                anchor(span, format!("const {ANCHOR}:"));
            }
        }
        for (handle, function) in module.functions.iter() {
            let (path, item) = mangle::split(function.name.as_deref().unwrap_or_default());
            if path.is_some() {
                let span = module.functions.get_span(handle);
                anchor(span, format!("fn {item}("));
            }
        }
        Self { shader_defs, files }
    }

    /// File and line of a span; line 1 where a span is unknown.
    pub(super) fn locate(&self, span: naga::Span) -> Location {
        let start = span.to_range().map_or(0, |range| range.start);
        let Some(file) = self.files.get(&(start >> SPAN_SHIFT)) else {
            return self.top();
        };
        let Preprocessed { text, header_len } = file
            .preprocessed
            .get_or_init(|| file.preprocess(&self.shader_defs));
        let offset = header_len.map_or(0, |len| offset_in_module(start).saturating_sub(len));
        Location {
            file: file.path.clone(),
            line: line_of(text, offset),
        }
    }

    /// The first line of the shader itself.
    pub(super) fn top(&self) -> Location {
        Location {
            file: self.files[&0].path.clone(),
            line: 1,
        }
    }
}

impl File {
    fn preprocess(&self, shader_defs: &HashMap<String, ShaderDefValue>) -> Preprocessed {
        // What the composer has accepted can be preprocessed again; should it fail, lines read 1.
        let clean = PREPROCESSOR.extract_wgsl_directives(&self.text);
        let clean = clean.map(|(clean, _)| clean).unwrap_or_default();
        let text = PREPROCESSOR
            .preprocess(&clean, shader_defs)
            .map(|output| output.preprocessed_source)
            .unwrap_or_default();
        let header_len = self.anchor.as_ref().and_then(|(offset, declaration)| {
            offset.checked_sub(position_of_declaration(&text, declaration)?)
        });
        Preprocessed { text, header_len }
    }
}

/// Takes the anchor's name away, so that compaction drops it.
pub(super) fn release_anchor(module: &mut naga::Module) {
    for (_, constant) in module.constants.iter_mut() {
        if constant.name.as_deref() == Some(ANCHOR) {
            constant.name = None;
        }
    }
}

/// Where a declaration stands in a text, outside of line comments.
fn position_of_declaration(text: &str, declaration: &str) -> Option<usize> {
    text.match_indices(declaration)
        .map(|(at, _)| at)
        .find(|&at| {
            let line_start = text[..at].rfind('\n').map_or(0, |n| n + 1);
            !text[line_start..at].contains("//")
        })
}

/// The part of a span's start that counts bytes within its module.
pub(super) fn offset_in_module(start: usize) -> usize {
    start & ((1 << SPAN_SHIFT) - 1)
}

/// The line, from 1, that a byte offset falls on.
pub(super) fn line_of(text: &str, offset: usize) -> u32 {
    let before = &text.as_bytes()[..offset.min(text.len())];
    1 + before.iter().filter(|&&byte| byte == b'\n').count() as u32
}
