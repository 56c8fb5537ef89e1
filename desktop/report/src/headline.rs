//! The first sentence of the page: the time of adaptive sampling over that of full ray tracing at equal error.

use glimpse_measure::output::{counted, listed};

use crate::equal_error::EqualError;
use crate::interval::Estimate;

/// A scene and its comparison, or why there is none.
pub type Compared<'s> = (&'s str, &'s Result<EqualError, String>);

/// What an interval of a ratio shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finding {
    /// Less time: all of the interval is below 1.
    Less,
    /// More time: all of the interval is above 1.
    More,
    /// Neither: 1 is within the interval, or there is none.
    Open,
}

impl Finding {
    /// Reads a ratio of times.
    pub fn of(ratio: &Estimate) -> Self {
        match ratio.interval {
            Some([_, high]) if high < 1.0 => Self::Less,
            Some([low, _]) if low > 1.0 => Self::More,
            _ => Self::Open,
        }
    }

    /// Word of the page's table.
    pub fn word(self) -> &'static str {
        match self {
            Self::Less => "less time",
            Self::More => "more time",
            Self::Open => "not told apart",
        }
    }
}

/// States in one sentence how the times at equal error compare, on all scenes together and on which of them.
pub fn sentence(scenes: &[Compared<'_>]) -> String {
    let found: Vec<_> = scenes.iter().filter_map(|(name, of)| Some((*name, of.as_ref().ok()?))).collect();
    let lacking: Vec<_> = scenes.iter().filter(|(_, of)| of.is_err()).map(|(name, _)| *name).collect();
    if found.is_empty() {
        let scenes = counted(scenes.len(), "scene");
        return format!(
            "Adaptive sampling and full tracing have no error in common on the {scenes} measured: their times at equal \
             error cannot be compared."
        );
    }
    let ratio = together(&found);
    let interval = match ratio.interval {
        Some(_) => format!("95 % interval {}", ratio.range(2)),
        None => "no interval, as each setting was timed once".to_owned(),
    };
    let over = if found.len() == 1 {
        format!(" on {}", found[0].0)
    } else {
        format!(", the geometric mean of {} scenes", found.len())
    };
    let mut text = format!(
        "At equal error, adaptive sampling took {:.2} of full tracing's time ({interval}){over}",
        ratio.mean
    );
    let of = |finding| -> Vec<String> {
        let those = found.iter().filter(|(_, of)| Finding::of(&of.ratio()) == finding);
        those.map(|(name, of)| format!("{name} ({:.2})", of.ratio().mean)).collect()
    };
    let [less, more, open] = [Finding::Less, Finding::More, Finding::Open].map(of);
    if ratio.interval.is_some() && found.len() == 1 {
        text += match Finding::of(&ratio) {
            Finding::Less => ": less time",
            Finding::More => ": more time, not less",
            Finding::Open => ": the frame times do not tell which takes less",
        };
    } else if ratio.interval.is_some() {
        text += &format!(": less on {} of {}", less.len(), found.len());
        if !more.is_empty() {
            text += &format!("; more on {}", listed(&more));
        }
        if !open.is_empty() {
            text += &format!("; not told apart on {}", listed(&open));
        }
    }
    if !lacking.is_empty() {
        text += &format!("; no error in common on {}", listed(&lacking));
    }
    text + "."
}

/// Geometric mean over the scenes, in each round.
fn together(found: &[(&str, &EqualError)]) -> Estimate {
    let rounds = found.iter().map(|(_, of)| of.log_ratios.len()).min().unwrap_or_default();
    let mean = |round| found.iter().map(|(_, of)| of.log_ratios[round]).sum::<f64>() / found.len() as f64;
    Estimate::of_logarithms(&(0..rounds).map(mean).collect::<Vec<_>>())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(ratios: &[f64]) -> Result<EqualError, String> {
        Ok(EqualError { log_ratios: ratios.iter().map(|r| r.ln()).collect(), psnr_db: [30.0, 40.0] })
    }

    fn said(scenes: &[(&str, Result<EqualError, String>)]) -> String {
        sentence(&scenes.iter().map(|(name, of)| (*name, of)).collect::<Vec<_>>())
    }

    #[test]
    fn every_outcome_has_a_true_sentence() {
        let (fast, slow) = (of(&[0.499, 0.5, 0.501]), of(&[1.99, 2.0, 2.01]));
        let (open, none) = (of(&[0.5, 1.0, 2.0]), Err("full tracing reaches ...".to_owned()));
        let start = "At equal error, adaptive sampling took";
        assert_eq!(
            said(&[("a", fast.clone())]),
            format!("{start} 0.50 of full tracing's time (95 % interval 0.50 to 0.50) on a: less time.")
        );
        assert_eq!(
            said(&[("a", slow.clone())]),
            format!(
                "{start} 2.00 of full tracing's time (95 % interval 1.98 to 2.02) on a: more time, not less."
            )
        );
        assert!(
            said(&[("a", open.clone())]).ends_with("on a: the frame times do not tell which takes less.")
        );
        let mixed = said(&[
            ("a", fast.clone()),
            ("b", slow.clone()),
            ("c", open.clone()),
            ("d", none.clone()),
            ("e", fast.clone()),
        ]);
        assert!(
            mixed.starts_with(&format!("{start} 0.84 of full tracing's time (95 % interval ")),
            "{mixed}"
        );
        assert!(
            mixed.ends_with(
                "the geometric mean of 4 scenes: less on 2 of 4; more on b (2.00); not told apart on c (1.00); no error \
                 in common on d."
            ),
            "{mixed}"
        );
        assert!(
            said(&[("b", slow.clone()), ("c", slow)])
                .ends_with(": less on 0 of 2; more on b (2.00), c (2.00).")
        );
        let nothing = said(&[("a", none.clone()), ("b", none)]);
        assert!(nothing.contains("no error in common on the 2 scenes"), "{nothing}");
        assert!(
            said(&[("a", of(&[0.5]))])
                .contains("took 0.50 of full tracing's time (no interval, as each setting")
        );
        assert!(
            !said(&[("a", of(&[0.5])), ("b", of(&[0.5]))]).contains("less on"),
            "one frame shows nothing"
        );
    }
}
