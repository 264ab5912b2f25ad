//! Composition by naga_oil: one shader and the libraries it imports become one naga module.
//!
//! `WORKGROUP_SIZE` is substituted as a number, so that shaders write `#{WORKGROUP_SIZE}u`. WGSL's
//! own `override` is refused: naga_oil 0.23 carries an entry point's workgroup size overrides
//! over without renumbering the expressions they point to.

use std::cell::RefCell;
use std::collections::{HashMap, HashSet};

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, ComposerError, ComposerErrorInner, NagaModuleDescriptor,
    ShaderDefValue, get_preprocessor_data,
};

use super::error::{Finding, Location, ShaderError, Step};
use super::locate::{Locator, line_of, offset_in_module};
use super::mangle::{self, demangle};
use super::sources::{LIBRARIES, Source};
use super::text;

/// What may stand in a shader beyond the core of WGSL: immediates, 64-bit integers for devices that
/// have them; and `quantizeToF16` and its
/// kind, so that the lint can say what to use instead.
pub(super) const CAPABILITIES: Capabilities = Capabilities::IMMEDIATES
    .union(Capabilities::SHADER_INT64)
    .union(Capabilities::SHADER_INT64_ATOMIC_ALL_OPS)
    .union(Capabilities::SHADER_FLOAT16_IN_FLOAT32);

/// A shader as the composer wants it.
pub(super) struct Input<'a> {
    /// Name, as errors show it.
    pub(super) name: &'a str,
    /// File, as errors show it.
    pub(super) file: &'a str,
    /// The file's text.
    pub(super) text: &'a str,
    /// What it may import from; each stands after those that it imports itself.
    pub(super) libraries: &'a [Source<'a>],
    /// What `#{WORKGROUP_SIZE}` stands for.
    pub(super) workgroup_size: u32,
    /// The switches of [`SWITCHES`] that are off.
    pub(super) off: &'a [&'static str],
    /// Whether `#if WIDE == true` holds.
    pub(super) wide: bool,
}

/// What a shader may leave out, by `const STREAKS: bool = #{STREAKS};`, when a plan has no use for
/// it: drivers drop the code, and software drivers would otherwise run it masked.
pub(super) const SWITCHES: &[&str] = &[
    "THRESHOLDS",
    "BOUNDS",
    "RATE_SPREADS",
    "DRAGS",
    "MANY_SYSTEMS",
    "MANY_ROWS",
    "MANY_WINDS",
    "FLOWS",
    "NOISES",
    "OCTAVES",
    "FOLDS",
    "PLACED",
    "CURLS",
    "STREAKS",
    "RECTANGLES",
    "LIGHT_DISTANCES",
    "LAYERS",
    "MESHES",
    "CROWDS",
    "THRONGS",
    "SIXTEENS",
    "PLANET",
    "GROUND",
    "SURFACES",
    "DETAILS",
    "SKEWS",
    "INNERS",
    "TEXTURES",
    "COLOR_NOISES",
    "STRIPS",
    "DEPTHS",
    "TORUS",
    "COVERS",
    "TRIANGLES",
    "MIRRORS",
    "CONES",
    "MARKS",
    "STROKES",
    "SHADES",
    "CLUSTERS",
    "SMOKES",
    "GRAINS",
    "PILLARS",
    "MANY_SURFACES",
    "LAMPS",
    "LIGHTS",
    "MORE_LIGHTS",
    "MOST_LIGHTS",
    "TRAILS",
    "VIEWS",
    "NEAREST",
    "GOALS",
    "OBSTACLES",
    "SOLIDS",
    "BLOWN",
];

/// A composed and validated module.
pub(super) struct Composed {
    pub(super) module: naga::Module,
    pub(super) info: ModuleInfo,
    pub(super) locator: Locator,
    /// The shader's own import path, when it is a listed library.
    pub(super) own_path: Option<String>,
    /// (file, text) of the shader and of every library that it takes something from.
    pub(super) texts: Vec<(String, String)>,
}

thread_local! {
    /// A composer with [`LIBRARIES`], which it keeps parsed. Making one costs more than composing a kernel.
    static COMPOSER: RefCell<Option<Composer>> = const { RefCell::new(None) };
}

/// Composes a shader with what it imports, and validates the whole.
pub(super) fn compose(input: &Input) -> Result<Composed, ShaderError> {
    if let Some(line) = text::override_line(input.text) {
        let at = Location {
            file: input.file.to_owned(),
            line,
        };
        let found = "an override; write #{WORKGROUP_SIZE}u, or use an immediate".to_owned();
        return Err(ShaderError::one(input.name, Step::Compose, at, found));
    }
    if !std::ptr::eq(input.libraries, LIBRARIES) {
        return compose_by(&mut composer(input)?, input);
    }
    COMPOSER.with_borrow_mut(|kept| {
        let composer = match kept {
            Some(composer) => composer,
            None => kept.insert(composer(input)?),
        };
        compose_by(composer, input)
    })
}

/// A composer that knows the shader's libraries.
fn composer(input: &Input) -> Result<Composer, ShaderError> {
    let mut composer = Composer::default();
    composer.capabilities = CAPABILITIES;
    for library in input.libraries {
        let descriptor = ComposableModuleDescriptor {
            source: library.text,
            file_path: library.file,
            ..Default::default()
        };
        let added = composer.add_composable_module(descriptor).map(|_| ());
        if let Err(e) = added {
            return Err(explain(input, &composer, &e));
        }
    }
    Ok(composer)
}

fn compose_by(composer: &mut Composer, input: &Input) -> Result<Composed, ShaderError> {
    let text = Locator::anchored(input.text);
    let size = ShaderDefValue::UInt(input.workgroup_size);
    let mut shader_defs = HashMap::from([("WORKGROUP_SIZE".to_owned(), size)]);
    for switch in SWITCHES {
        let on = ShaderDefValue::Bool(!input.off.contains(switch));
        shader_defs.insert((*switch).to_owned(), on);
    }
    shader_defs.insert("WIDE".to_owned(), ShaderDefValue::Bool(input.wide));
    let made = composer.make_naga_module(NagaModuleDescriptor {
        source: &text,
        file_path: input.file,
        shader_defs: shader_defs.clone(),
        ..Default::default()
    });
    let module = match made {
        Ok(module) => module,
        Err(e) => return Err(explain(input, composer, &e)),
    };
    let locator = Locator::new(composer, input.file, &text, shader_defs, &module);
    let info = validate(input.name, &module, &locator)?;
    let mut texts = vec![(input.file.to_owned(), input.text.to_owned())];
    texts.extend(texts_of(composer, input, &module));
    let is_library = input.libraries.iter().any(|l| l.file == input.file);
    let own_path = is_library.then(|| get_preprocessor_data(input.text).0);
    Ok(Composed {
        module,
        info,
        locator,
        own_path: own_path.flatten(),
        texts,
    })
}

/// Validates a module, with the capabilities of kernels.
pub(super) fn validate(
    name: &str,
    module: &naga::Module,
    locator: &Locator,
) -> Result<ModuleInfo, ShaderError> {
    Validator::new(ValidationFlags::all(), CAPABILITIES)
        .validate(module)
        .map_err(|e| {
            let at = e
                .spans()
                .last()
                .map_or_else(|| locator.top(), |(span, _)| locator.locate(*span));
            ShaderError::one(name, Step::Compose, at, demangle(&chain(e.as_inner())))
        })
}

/// (file, text) of the libraries that something in the module comes from.
fn texts_of(composer: &Composer, input: &Input, module: &naga::Module) -> Vec<(String, String)> {
    let functions = module.functions.iter().map(|(_, f)| f.name.as_deref());
    let constants = module.constants.iter().map(|(_, c)| c.name.as_deref());
    let types = module.types.iter().map(|(_, ty)| ty.name.as_deref());
    let names = functions.chain(constants).chain(types).flatten();
    let paths: HashSet<_> = names.filter_map(|name| mangle::split(name).0).collect();
    let sets = paths
        .iter()
        .filter_map(|path| composer.module_sets.get(path));
    let files: HashSet<_> = sets.map(|set| set.file_path.as_str()).collect();
    let libraries = input.libraries.iter().filter(|l| files.contains(l.file));
    libraries
        .map(|l| (l.file.to_owned(), l.text.to_owned()))
        .collect()
}

/// An error with all its causes, in one line.
fn chain(error: &dyn std::error::Error) -> String {
    let mut out = error.to_string();
    let mut cause = error.source();
    while let Some(e) = cause {
        out.push_str(": ");
        out.push_str(&e.to_string());
        cause = e.source();
    }
    out
}

/// A composer's error, with the file and line it speaks of.
fn explain(input: &Input, composer: &Composer, error: &ComposerError) -> ShaderError {
    let mut found = match &error.inner {
        ComposerErrorInner::WgslParseError(e) => e.message().to_owned(),
        ComposerErrorInner::ShaderValidationError(e)
        | ComposerErrorInner::HeaderValidationError(e) => chain(e.as_inner()),
        ComposerErrorInner::InvalidIdentifier { original, .. } => format!(
            "`{original}`: a name in a library may not end in a digit, for naga would rename it"
        ),
        other => other.to_string(),
    };
    if let ComposerErrorInner::WgslParseError(e) = &error.inner {
        for (_, label) in e.labels().filter(|(_, label)| !label.is_empty()) {
            found.push_str(": ");
            found.push_str(label);
        }
    }
    let text = error.source.source(composer);
    let mut line = line_of(&text, offset_of(error));
    if let ComposerErrorInner::ImportNotFound(path, _) = &error.inner {
        // naga_oil's offset counts lines with their definitions already substituted.
        line = text::line_with(&text, path).unwrap_or(line);
    }
    let at = Location {
        file: error.source.path(composer).clone(),
        line,
    };
    ShaderError::one(input.name, Step::Compose, at, demangle(&found))
}

/// Where in the source named by the error, in bytes.
fn offset_of(error: &ComposerError) -> usize {
    use ComposerErrorInner as E;
    let within = |span: Option<naga::Span>| {
        let start = span.and_then(|s| s.to_range()).map_or(0, |r| r.start);
        offset_in_module(start).saturating_sub(error.source.offset())
    };
    match &error.inner {
        E::WgslParseError(e) => within(e.labels().next().map(|(span, _)| span)),
        E::ShaderValidationError(e) | E::HeaderValidationError(e) => {
            within(e.spans().last().map(|(span, _)| *span))
        }
        E::InvalidIdentifier { at, .. } => within(Some(*at)),
        E::DecorationInSource(range) => range.start,
        E::ImportParseError(_, pos)
        | E::ImportNotFound(_, pos)
        | E::NotEnoughEndIfs(pos)
        | E::TooManyEndIfs(pos)
        | E::ElseWithoutCondition(pos)
        | E::UnknownShaderDef { pos, .. }
        | E::UnknownShaderDefOperator { pos, .. }
        | E::InvalidShaderDefComparisonValue { pos, .. }
        | E::OverrideNotVirtual { pos, .. }
        | E::InvalidShaderDefDefinitionValue { pos, .. }
        | E::DefineInModule(pos) => *pos,
        _ => 0,
    }
}

/// A finding at the place of a span.
pub(super) fn finding(locator: &Locator, span: naga::Span, found: &str, instead: &str) -> Finding {
    Finding {
        at: locator.locate(span),
        found: found.to_owned(),
        instead: instead.to_owned(),
    }
}
