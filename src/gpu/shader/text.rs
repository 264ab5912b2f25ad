//! What only a shader's text shows: naga folds constants before anybody sees them.
//!
//! A float literal without `f` is abstract and is folded in 64 bits, and a built-in function of
//! constants is computed by the compiling machine's own mathematics; both are gone from the IR.

use super::error::{Finding, Location};
use super::rules;

/// Built-in functions of WGSL (17.5 to 17.7) that take or make floats only, and that are refused.
const FLOAT_BUILTINS: &str = "acos acosh asin asinh atan atan2 atanh ceil cos cosh cross degrees \
    determinant distance exp exp2 faceForward fma fract frexp inverseSqrt ldexp length log log2 \
    mix modf normalize pow quantizeToF16 radians reflect refract round saturate sin sinh \
    smoothstep sqrt step tan tanh transpose trunc";

/// A token of WGSL outside of comments and preprocessor lines, with its line, from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Token<'a> {
    text: &'a str,
    line: u32,
}

/// Everything that a file's text shows to be inexact.
pub(super) fn check(file: &str, text: &str) -> Vec<Finding> {
    let tokens = tokens(text);
    let mut findings = Vec::new();
    let mut refuse = |line: u32, found: String, instead: &str| {
        findings.push(Finding {
            at: Location {
                file: file.to_owned(),
                line,
            },
            found,
            instead: instead.to_owned(),
        });
    };
    for (i, token) in tokens.iter().enumerate() {
        let previous = i.checked_sub(1).map(|p| tokens[p].text);
        let next = tokens.get(i + 1).map(|t| t.text);
        if lacks_suffix(token.text) {
            let found = format!("float literal `{}` without `f`", token.text);
            refuse(token.line, found, "write the suffix: `1.0f`");
        }
        let is_call = next == Some("(") && !matches!(previous, Some("fn" | "."));
        let is_own = || declares(&tokens, token.text);
        if is_call && FLOAT_BUILTINS.split(' ').any(|b| b == token.text) && !is_own() {
            refuse(
                token.line,
                rules::function_found(token.text),
                rules::instead_of_function(token.text),
            );
        }
    }
    findings
}

/// The line of the first `override` declaration, which composition cannot carry.
pub(super) fn override_line(text: &str) -> Option<u32> {
    let found = tokens(text).into_iter().find(|t| t.text == "override");
    found.map(|t| t.line)
}

/// The first line, from 1, that names a path such as `motes::exact` outside of line comments.
pub(super) fn line_with(text: &str, path: &str) -> Option<u32> {
    let code = text.lines().map(|line| line.split("//").next());
    let mut numbered = (1..).zip(code);
    let found = numbered.find(|(_, code)| code.is_some_and(|c| c.contains(path)));
    found.map(|(line, _)| line)
}

fn declares(tokens: &[Token], name: &str) -> bool {
    tokens
        .windows(2)
        .any(|pair| pair[0].text == "fn" && pair[1].text == name)
}

/// Whether a token is a float literal that is not marked as an `f32`.
fn lacks_suffix(token: &str) -> bool {
    let starts_number = token.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    if !starts_number || token == "." {
        return false;
    }
    let lower = token.to_ascii_lowercase();
    if let Some(digits) = lower.strip_prefix("0x") {
        let is_float = digits.contains(['.', 'p']);
        // Without an exponent, a last `f` is a digit.
        return is_float && !(digits.contains('p') && digits.ends_with('f'));
    }
    let is_float = lower.contains(['.', 'e', 'h']);
    is_float && (!lower.ends_with('f') || lower.ends_with("lf"))
}

fn tokens(text: &str) -> Vec<Token<'_>> {
    let bytes = text.as_bytes();
    let at = |i: usize| bytes.get(i).copied().unwrap_or(0);
    let is_word = |b: u8| b.is_ascii_alphanumeric() || b == b'_' || b >= 0x80;
    let mut out = Vec::new();
    let (mut i, mut line, mut depth) = (0, 1, 0u32);
    let mut line_is_blank = true;
    while i < bytes.len() {
        let start = i;
        let byte = at(i);
        if byte == b'\n' {
            line += 1;
            line_is_blank = true;
            i += 1;
            continue;
        }
        // Block comments nest (WGSL 3.2).
        if byte == b'/' && at(i + 1) == b'*' {
            depth += 1;
            i += 2;
        } else if depth > 0 {
            let closes = byte == b'*' && at(i + 1) == b'/';
            depth -= u32::from(closes);
            i += 1 + usize::from(closes);
        } else if byte.is_ascii_whitespace() {
            i += 1;
        } else if byte == b'/' && at(i + 1) == b'/'
            || byte == b'#' && line_is_blank && at(i + 1) != b'{'
        {
            while i < bytes.len() && at(i) != b'\n' {
                i += 1;
            }
        } else {
            line_is_blank = false;
            let is_number = byte.is_ascii_digit() || byte == b'.' && at(i + 1).is_ascii_digit();
            i += 1;
            if is_number {
                let is_hex = byte == b'0' && matches!(at(i), b'x' | b'X');
                while is_word(at(i)) || at(i) == b'.' || is_sign(at(i - 1), at(i), is_hex) {
                    i += 1;
                }
            } else if is_word(byte) {
                while is_word(at(i)) {
                    i += 1;
                }
            }
            let text = text.get(start..i).unwrap_or_default();
            out.push(Token { text, line });
        }
    }
    out
}

/// Whether `byte` is the sign of an exponent that `previous` opens.
fn is_sign(previous: u8, byte: u8, is_hex: bool) -> bool {
    let opens = if is_hex { b"pP" } else { b"eE" };
    matches!(byte, b'+' | b'-') && opens.contains(&previous)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_are_told_apart() {
        for good in [
            "1.0f", "1f", "2u", "3i", "4", "0x1fu", "0xeu", "0x1.8p3f", "1e-3f", "x1", ".",
        ] {
            assert!(!lacks_suffix(good), "{good}");
        }
        for bad in [
            "1.0", "1.", ".5", "1e5", "1E-5", "2.0h", "1h", "1.0lf", "0x1.8f", "0x1p3",
        ] {
            assert!(lacks_suffix(bad), "{bad}");
        }
    }

    #[test]
    fn tokens_know_their_lines_and_skip_comments() {
        let text = "a /* 1.0\n /* 2.0 */ 3.0 */ 1e-5f-b // 4.0\n  #import x\n c.d[#{N}u]";
        let got: Vec<_> = tokens(text).iter().map(|t| (t.text, t.line)).collect();
        let want = [
            ("a", 1),
            ("1e-5f", 2),
            ("-", 2),
            ("b", 2),
            ("c", 4),
            (".", 4),
            ("d", 4),
            ("[", 4),
            ("#", 4),
            ("{", 4),
            ("N", 4),
            ("}", 4),
            ("u", 4),
            ("]", 4),
        ];
        assert_eq!(got, want);
    }
}
