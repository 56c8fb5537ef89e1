//! The memory that an import may take, claimed before it is allocated.

use std::cell::Cell;

use crate::{Error, Result};

/// A number of bytes that is shared by all that an import allocates.
pub(super) struct Budget {
    most: u64,
    left: Cell<u64>,
}

impl Budget {
    /// A budget of `most` bytes; `None` for as many as the limits of the format allow.
    pub fn new(most: Option<u64>) -> Self {
        let most = most.unwrap_or(u64::MAX);
        Self { most, left: Cell::new(most) }
    }

    /// Claims bytes for the rest of the import; `what` is the element that needs them.
    pub fn claim(&self, what: &str, bytes: u64) -> Result<()> {
        self.take(bytes).map_err(|reason| Error::scene(what, reason))
    }

    /// Claims bytes for the rest of the import, or says why not.
    pub fn take(&self, bytes: u64) -> std::result::Result<(), String> {
        self.allows(bytes)?;
        self.left.set(self.left.get() - bytes);
        Ok(())
    }

    /// Fails if so many bytes are not left, for memory that is freed again.
    pub fn needs(&self, what: &str, bytes: u64) -> Result<()> {
        self.allows(bytes).map_err(|reason| Error::scene(what, reason))
    }

    fn allows(&self, bytes: u64) -> std::result::Result<(), String> {
        let left = self.left.get();
        if bytes <= left {
            return Ok(());
        }
        let [most, left, bytes] = [self.most, left, bytes].map(mebibytes);
        let expected = format!("expected an import in {most} of memory (option `memory`)");
        Err(format!("{expected}, found a need of {bytes} more where {left} are left"))
    }

    /// Bytes that are left.
    pub fn left(&self) -> u64 {
        self.left.get()
    }
}

fn mebibytes(bytes: u64) -> String {
    format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20))
}

/// Bytes that the JSON of a document of this text may take when it is read: most for many small objects, as a list of
/// structs doubles its capacity when it is full.
pub(super) fn of_json(text: &[u8]) -> u64 {
    let count = |byte: u8| text.iter().filter(|b| **b == byte).count() as u64;
    8 * text.len() as u64 + 2048 * count(b'{') + 192 * count(b',')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_claimed_is_gone_and_what_is_refused_is_not() {
        let budget = Budget::new(Some(10 << 20));
        budget.claim("a", 6 << 20).expect("fits");
        let error = budget.claim("image 3", 5 << 20).unwrap_err().to_string();
        assert!(
            error.contains("image 3") && error.contains("10.0 MiB") && error.contains("4.0 MiB"),
            "{error}"
        );
        budget.needs("b", 4 << 20).expect("is left");
        budget.claim("b", 4 << 20).expect("is left");
        assert_eq!(budget.left(), 0);
        Budget::new(None).claim("c", 1 << 60).expect("no budget");
    }
}
