//! The allow-list: what an expression may do to floats.
//!
//! Drivers agree bit for bit on `+`, `-`, `*`, negation, `abs` and moving data, once contraction
//! is forbidden. Comparisons, `floor`, conversions and the bits of a float agree only on snapped
//! values in range, so they live in the trusted libraries, behind functions that see to that.

use naga::valid::FunctionInfo;
use naga::{
    BinaryOperator as Op, Expression as E, Handle, Literal, MathFunction as Mf, Module,
    RelationalFunction, Scalar, ScalarKind, TypeInner, UnaryOperator,
};

/// A function under inspection.
pub(super) struct Body<'a> {
    pub(super) module: &'a Module,
    pub(super) function: &'a naga::Function,
    pub(super) info: &'a FunctionInfo,
    /// Whether it is defined in a library that may compare, floor and convert floats.
    pub(super) trusted: bool,
}

/// What was found, and what to use instead.
pub(super) type Refusal = (String, &'static str);

impl Body<'_> {
    pub(super) fn type_of(&self, expression: Handle<E>) -> &TypeInner {
        self.info[expression].ty.inner_with(&self.module.types)
    }

    fn scalar_of(&self, expression: Handle<E>) -> Option<Scalar> {
        match *self.type_of(expression) {
            TypeInner::Scalar(scalar) | TypeInner::Vector { scalar, .. } => Some(scalar),
            TypeInner::Matrix { scalar, .. } => Some(scalar),
            _ => None,
        }
    }

    fn is_float(&self, expression: Handle<E>) -> bool {
        self.scalar_of(expression)
            .is_some_and(|s| s.kind == ScalarKind::Float)
    }

    /// Whether an expression's own operation is refused; its operands are judged by themselves.
    /// Kinds of expression that are not named here are refused, those of later nagas included.
    pub(super) fn judge(&self, handle: Handle<E>) -> Result<(), Refusal> {
        match self.function.expressions[handle] {
            E::Literal(Literal::F64(_) | Literal::F16(_)) => {
                Err(("a float that is not f32".to_owned(), "use f32"))
            }
            E::Literal(_)
            | E::Constant(_)
            | E::ZeroValue(_)
            | E::Compose { .. }
            | E::Access { .. }
            | E::AccessIndex { .. }
            | E::Splat { .. }
            | E::Swizzle { .. }
            | E::FunctionArgument(_)
            | E::GlobalVariable(_)
            | E::LocalVariable(_)
            | E::Load { .. }
            | E::Select { .. }
            | E::CallResult(_)
            | E::AtomicResult { .. }
            | E::WorkGroupUniformLoadResult { .. }
            | E::ArrayLength(_) => Ok(()),
            E::Unary { op, expr } => match op {
                UnaryOperator::Negate => Ok(()),
                _ if !self.is_float(expr) => Ok(()),
                _ => Err((format!("float operator {op:?}"), ARITHMETIC)),
            },
            E::Binary { op, left, right } => self.judge_binary(op, left, right),
            E::Relational { fun, .. } => match fun {
                RelationalFunction::All | RelationalFunction::Any => Ok(()),
                _ => Err((
                    function_found(&wgsl_name(fun)),
                    "keep values finite and snapped, so that there is nothing to ask",
                )),
            },
            E::Math { fun, arg, .. } => {
                let touches_floats = self.is_float(arg) || self.is_float(handle);
                match fun {
                    _ if !touches_floats => Ok(()),
                    Mf::Abs => Ok(()),
                    Mf::Floor if self.trusted => Ok(()),
                    _ => {
                        let name = wgsl_name(fun);
                        Err((function_found(&name), instead_of_function(&name)))
                    }
                }
            }
            E::As {
                expr,
                kind,
                convert,
            } => self.judge_cast(expr, kind, convert),
            E::Derivative { .. } => Err(("a derivative".to_owned(), ARITHMETIC)),
            E::ImageSample { .. } | E::ImageLoad { .. } | E::ImageQuery { .. } => Err((
                "an image operation".to_owned(),
                "read from a storage buffer",
            )),
            E::Override(_) => Err((
                "an override".to_owned(),
                "write #{WORKGROUP_SIZE}u, or use an immediate",
            )),
            ref other => {
                let kind = format!("{other:?}");
                let kind = kind.split([' ', '(', '{']).next().unwrap_or_default();
                Err((
                    format!("an operation that is not on the list of exact ones ({kind})"),
                    ARITHMETIC,
                ))
            }
        }
    }

    fn judge_binary(&self, op: Op, left: Handle<E>, right: Handle<E>) -> Result<(), Refusal> {
        if !self.is_float(left) && !self.is_float(right) {
            return Ok(());
        }
        let comparison = |sign: &str, instead| {
            if self.trusted {
                Ok(())
            } else {
                Err((format!("float comparison `{sign}`"), instead))
            }
        };
        match op {
            Op::Add | Op::Subtract | Op::Multiply => Ok(()),
            Op::Divide => Err((
                "float division `/`".to_owned(),
                "multiply by motes::exact::reciprocal",
            )),
            Op::Modulo => Err((
                "float remainder `%`".to_owned(),
                "use x - n * motes::exact::floor_exact(x * motes::exact::reciprocal(n))",
            )),
            Op::Less => comparison("<", "use motes::exact::less(a, b)"),
            Op::Greater => comparison(">", "use motes::exact::less(b, a)"),
            Op::LessEqual => comparison("<=", "use motes::exact::less_equal(a, b)"),
            Op::GreaterEqual => comparison(">=", "use motes::exact::less_equal(b, a)"),
            Op::Equal => comparison("==", "compare motes::exact::bits_of"),
            Op::NotEqual => comparison("!=", "compare motes::exact::bits_of"),
            _ => Err((format!("float operator {op:?}"), ARITHMETIC)),
        }
    }

    fn judge_cast(
        &self,
        from: Handle<E>,
        to: ScalarKind,
        convert: Option<naga::Bytes>,
    ) -> Result<(), Refusal> {
        let from_float = self.is_float(from);
        let to_float = to == ScalarKind::Float;
        let from_bool = self.scalar_of(from).map(|s| s.kind) == Some(ScalarKind::Bool);
        match (from_float, to_float, convert) {
            (false, false, _) => Ok(()),
            // A float of the same width, or a bitcast of bits to a float.
            (true, true, None | Some(4)) | (false, true, None) => Ok(()),
            (true, true, _) => Err(("a float that is not f32".to_owned(), "use f32")),
            _ if self.trusted => Ok(()),
            (true, false, None) => {
                Err(("bitcast of a float".to_owned(), "use motes::exact::bits_of"))
            }
            (true, false, Some(_)) if to == ScalarKind::Bool => Err((
                "conversion of a float to bool".to_owned(),
                "compare motes::exact::bits_of with 0u",
            )),
            (true, false, Some(_)) => Err((
                "conversion of a float to an integer".to_owned(),
                "use motes::exact::to_i32",
            )),
            (false, true, Some(_)) if from_bool => Err((
                "conversion of a bool to float".to_owned(),
                "use select(0.0f, 1.0f, condition)",
            )),
            (false, true, Some(_)) => Err((
                "conversion of an integer to float".to_owned(),
                "use motes::exact::f32_of_u32 or f32_of_i32",
            )),
        }
    }
}

const ARITHMETIC: &str = "use + - * and the functions of motes::exact";

/// How findings name a built-in function.
pub(super) fn function_found(name: &str) -> String {
    format!("`{name}` of floats")
}

/// What to use instead of a built-in function of floats.
pub(super) fn instead_of_function(name: &str) -> &'static str {
    match name {
        "min" => "use motes::exact::min_exact",
        "max" => "use motes::exact::max_exact",
        "clamp" | "saturate" => "use motes::exact::clamp_exact",
        "floor" | "ceil" | "round" | "trunc" => "use motes::exact::floor_exact",
        "fract" | "modf" => "use x - motes::exact::floor_exact(x)",
        "sign" | "step" => "use select and motes::exact::less",
        "mix" => "write a + (b - a) * t",
        "fma" => "write a * b + c",
        "dot" => "use motes::exact::dot3",
        "cross" => "use motes::exact::cross3",
        "length" | "distance" => "use motes::exact::length3",
        "normalize" => "use motes::exact::normalize_exact",
        "sqrt" => "use motes::exact::square_root",
        "inverseSqrt" => "use motes::exact::inverse_square_root",
        "sin" => "use motes::transcendental::sin_turns",
        "cos" | "tan" => "use motes::transcendental::cos_turns and sin_turns",
        "exp" | "exp2" | "ldexp" => "use motes::transcendental::exp2_exact",
        "log" | "log2" => "use motes::transcendental::log2_exact",
        "pow" => "use exp2_exact(y * log2_exact(x)) of motes::transcendental",
        _ if name.contains("pack") => "pack integers with shifts and masks",
        _ => ARITHMETIC,
    }
}

/// A function's name in naga, `InverseSqrt`, as in WGSL, `inverseSqrt`.
fn wgsl_name(function: impl std::fmt::Debug) -> String {
    let name = format!("{function:?}");
    if name == "SmoothStep" {
        return "smoothstep".to_owned();
    }
    let mut chars = name.chars();
    let first = chars.next().map(|c| c.to_ascii_lowercase());
    first.into_iter().chain(chars).collect()
}
