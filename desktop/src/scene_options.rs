//! Options of a scene's file.

use std::str::FromStr;

use clap::Args;

use super::SCENE;

/// What of a scene's file is shown, and what it may cost.
#[derive(Clone, Debug, Default, PartialEq, Args)]
#[command(next_help_heading = SCENE)]
pub struct SceneOptions {
    /// Show the file's variant of materials with this name; `info` lists them
    #[arg(long, hide_short_help = true, value_name = "NAME")]
    pub variant: Option<String>,
    /// Fail where anything of the file is left out, replaced or not shown as the format has it
    #[arg(long, hide_short_help = true)]
    pub strict: bool,
    /// The most memory that the import may take, as 512MiB or 4GiB [default: half of what is available]
    #[arg(long, hide_short_help = true, value_name = "SIZE")]
    pub memory: Option<MemorySize>,
}

/// A number of bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemorySize(pub u64);

impl FromStr for MemorySize {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
        let shift = match text[digits.len()..].to_ascii_lowercase().as_str() {
            "" | "b" => Some(0),
            "k" | "kib" => Some(10),
            "m" | "mib" => Some(20),
            "g" | "gib" => Some(30),
            _ => None,
        };
        let bytes = shift.zip(digits.parse::<u64>().ok()).and_then(|(shift, n)| n.checked_mul(1 << shift));
        bytes.map(Self).ok_or_else(|| format!("expected a size like 512MiB or 4GiB, found {text}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_binary_units() {
        for (text, bytes) in [("7", 7), ("2KiB", 2048), ("512mib", 512 << 20), ("4G", 4 << 30)] {
            assert_eq!(text.parse(), Ok(MemorySize(bytes)), "{text}");
        }
        for text in ["", "MiB", "1.5GiB", "-1", "4 TB", "99999999999GiB"] {
            let error = MemorySize::from_str(text).unwrap_err();
            assert!(error.contains("512MiB") && error.ends_with(text), "{error}");
        }
    }
}
