//! The structure of JPEG files (ITU T.81, annex B).

/// The bytes of the first image of a JPEG file, up to its EOI marker; `None` if it has none. Phones append videos and
/// depth maps to their pictures.
pub(super) fn whole(bytes: &[u8]) -> Option<&[u8]> {
    const SOI: u8 = 0xd8;
    const EOI: u8 = 0xd9;
    const SOS: u8 = 0xda;
    let mut at = 0;
    loop {
        // Any number of 0xff may stand before a marker's code.
        at += bytes.get(at..)?.iter().position(|byte| *byte != 0xff)?;
        let code = bytes[at];
        at += 1;
        match code {
            EOI => return bytes.get(..at),
            SOI => continue,
            _ => {}
        }
        let length = bytes.get(at..at + 2)?;
        at += usize::from(u16::from_be_bytes([length[0], length[1]])).max(2);
        if code == SOS {
            at += scan(bytes.get(at..)?)?;
        } else if bytes.get(at) != Some(&0xff) {
            return None;
        }
    }
}

/// Number of bytes of entropy-coded data, up to a marker other than those that restart.
fn scan(bytes: &[u8]) -> Option<usize> {
    let is_marker = |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 0xd0..=0xd7 | 0xff);
    bytes.windows(2).position(is_marker)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: [u8; 6] = [0xff, 0xd8, 0xff, 0xe0, 0, 2];
    const SCAN: [u8; 10] = [0xff, 0xda, 0, 3, 7, 1, 0xff, 0, 0xff, 0xd3];
    const END: [u8; 2] = [0xff, 0xd9];

    #[test]
    fn a_picture_ends_with_its_own_end_marker() {
        let picture = [&HEADER[..], &SCAN, &SCAN, &END].concat();
        assert_eq!(whole(&picture), Some(&*picture));
        for behind in [&SCAN[..], &[0xff, 0xda], &HEADER, &END, b"video"] {
            assert_eq!(whole(&[&*picture, behind].concat()), Some(&*picture), "{behind:?}");
        }
        // A thumbnail inside of a segment is no end.
        let segment = [&[0xff, 0xe1, 0, 6][..], &END, &END].concat();
        let thumbnail = [&HEADER[..], &segment, &SCAN].concat();
        assert_eq!(whole(&thumbnail), None);
        assert!(whole(&[&*thumbnail, &END].concat()).is_some());
    }

    #[test]
    fn what_is_cut_off_is_not_whole() {
        let picture = [&HEADER[..], &SCAN, &END].concat();
        for length in 0..picture.len() {
            assert_eq!(whole(&picture[..length]), None, "{length}");
        }
        assert_eq!(whole(&[0xff; 100]), None);
    }
}
