//! The names that naga_oil gives to imported items, and back.
//!
//! An item of an imported module is called `item` + `X_naga_oil_mod_X` + the module's path in
//! base 32 (RFC 4648, no padding) + `X`.

const MARK: &str = "X_naga_oil_mod_X";

/// Splits a name into the import path of its module (`None`: the shader's own) and the item.
pub(super) fn split(name: &str) -> (Option<String>, &str) {
    let Some((item, rest)) = name.split_once(MARK) else {
        return (None, name);
    };
    // `X` is also a letter of base 32, so the code ends at the last one.
    let code = rest.rfind('X').map_or(rest, |end| &rest[..end]);
    (decode(code), item)
}

/// The item's name without its module.
pub(super) fn item(name: &str) -> &str {
    split(name).1
}

/// A text with every mangled name in it replaced by `module::item`.
pub(super) fn demangle(text: &str) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut out = String::with_capacity(text.len());
    let mut word = String::new();
    for c in text.chars().chain(std::iter::once('\n')) {
        if is_word(c) {
            word.push(c);
            continue;
        }
        match split(&word) {
            (Some(module), item) => {
                out.push_str(&module);
                out.push_str("::");
                out.push_str(item);
            }
            (None, _) => out.push_str(&word),
        }
        word.clear();
        out.push(c);
    }
    out.pop();
    out
}

fn decode(code: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(code.len() * 5 / 8);
    let (mut bits, mut count) = (0u32, 0u32);
    for c in code.bytes() {
        let digit = match c {
            b'A'..=b'Z' => c - b'A',
            b'2'..=b'7' => c - b'2' + 26,
            _ => return None,
        };
        bits = (bits << 5 | u32::from(digit)) & 0xffff;
        count += 5;
        if count >= 8 {
            count -= 8;
            bytes.push((bits >> count) as u8);
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use naga_oil::compose::Composer;

    #[test]
    fn names_are_split_as_naga_oil_joins_them() {
        for module in ["motes::exact", "motes::rng", "a", "motes::transcendental"] {
            let name = Composer::decorated_name(Some(module), "snap3");
            assert_eq!(split(&name), (Some(module.to_owned()), "snap3"));
            let text = format!("no `{name}`, or {name}");
            assert_eq!(
                demangle(&text),
                format!("no `{module}::snap3`, or {module}::snap3")
            );
        }
        assert_eq!(split("snap3"), (None, "snap3"));
    }
}
