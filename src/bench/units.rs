//! Numbers as people read them.

/// Three significant digits, no fewer before the point: `0.0123`, `1.23`, `12.3`, `1234`.
pub(super) fn digits(value: f64) -> String {
    let size = value.abs();
    let decimals = match size {
        _ if !size.is_finite() => return "-".to_owned(),
        _ if size >= 99.95 => 0,
        _ if size >= 9.995 => 1,
        _ if size >= 0.9995 => 2,
        _ if size >= 0.09995 => 3,
        _ => 4,
    };
    format!("{value:.decimals$}")
}

/// [`digits`] with a unit's prefix: `12.3 M`.
pub(super) fn prefixed(value: f64) -> String {
    let prefixes = [(1e9, " G"), (1e6, " M"), (1e3, " k")];
    for (size, prefix) in prefixes {
        // 999,999 is a million.
        if value.abs() >= size * 0.9995 {
            return format!("{}{prefix}", digits(value / size));
        }
    }
    match value.fract() == 0.0 {
        true => format!("{value}"),
        false => digits(value),
    }
}

/// A count in groups of three digits: `1,000,000`.
pub(super) fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Bytes in binary units: `412 MiB`.
pub(super) fn binary_bytes(bytes: u64) -> String {
    let units = ["GiB", "MiB", "KiB"];
    for (power, unit) in [30, 20, 10].into_iter().zip(units) {
        let size = 1u64 << power;
        if bytes >= size {
            return format!("{} {unit}", digits(bytes as f64 / size as f64));
        }
    }
    format!("{bytes} bytes")
}

/// A share in percent: `12.3 %`.
pub(super) fn percent(share: f64) -> String {
    format!("{:.1} %", share * 100.0)
}

/// The name, its middle left out where it has more letters than that.
pub(super) fn shortened(name: &str, most: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    if letters.len() <= most {
        return name.to_owned();
    }
    let head = (most - 1) / 2;
    let tail = letters.len() - (most - 1 - head);
    let part = |letters: &[char]| letters.iter().collect::<String>();
    format!("{}…{}", part(&letters[..head]), part(&letters[tail..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits() {
        let values = [
            0.0, 0.01234, 0.1, 0.99951, 9.994, 9.996, 99.96, 1234.5, -2.5,
        ];
        let expected = [
            "0.0000", "0.0123", "0.100", "1.00", "9.99", "10.0", "100", "1234", "-2.50",
        ];
        assert_eq!(values.map(digits), expected);
        let counts = [0.0, 7.0, 999.0, 999.9, 1e3, 999_999.0, 12_345_678.0, 1e9];
        let expected = [
            "0", "7", "999", "1.00 k", "1.00 k", "1.00 M", "12.3 M", "1.00 G",
        ];
        assert_eq!(counts.map(prefixed), expected);
    }

    #[test]
    fn counts_are_grouped_and_bytes_are_binary() {
        let counts = [0, 999, 1000, 12_345, 1_000_000];
        assert_eq!(
            counts.map(grouped),
            ["0", "999", "1,000", "12,345", "1,000,000"]
        );
        let bytes = [12, 1024, 3 << 20, 5 << 29];
        assert_eq!(
            bytes.map(binary_bytes),
            ["12 bytes", "1.00 KiB", "3.00 MiB", "2.50 GiB"]
        );
    }

    #[test]
    fn long_names_lose_their_middle() {
        assert_eq!(shortened("advance", 7), "advance");
        assert_eq!(shortened("particles/advance", 9), "part…ance");
    }
}
