//! Formats numbers for the overlay, with nearly constant width.

/// Formats a count in three or four digits: `987`, `12.3 k`, `4.56 M`.
pub fn count(count: u64) -> String {
    let (unit, name) = match count {
        0..1_000 => return count.to_string(),
        1_000..1_000_000 => (1e3, "k"),
        1_000_000..1_000_000_000 => (1e6, "M"),
        _ => (1e9, "G"),
    };
    let value = count as f64 / unit;
    let decimals = if value < 10.0 { 2 } else { 1 };
    format!("{value:.decimals$} {name}")
}

/// Formats bytes in MiB.
pub fn mebibytes(bytes: u64) -> String {
    format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20))
}

/// Formats a share in percent.
pub fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// Formats a PSNR in decibels; `None` is still being measured, infinite means equal pictures.
pub fn decibels(db: Option<f64>) -> String {
    match db {
        None => "measuring".to_owned(),
        Some(db) if db.is_finite() => format!("{db:.2} dB"),
        Some(_) => "equal".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_short() {
        let counts = [0, 999, 1_000, 12_345, 4_560_000, 123_456_789, u64::MAX];
        let texts = ["0", "999", "1.00 k", "12.3 k", "4.56 M", "123.5 M", "18446744073.7 G"];
        assert_eq!(counts.map(count), texts);
    }

    #[test]
    fn equal_pictures_are_called_so() {
        assert_eq!(
            [None, Some(41.234), Some(f64::INFINITY)].map(decibels),
            ["measuring", "41.23 dB", "equal"]
        );
    }
}
