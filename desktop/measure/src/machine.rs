//! The machine of a measurement, and the day.

use std::time::{SystemTime, UNIX_EPOCH};

/// Model of the processor as the operating system names it, with the number of threads that run at a time.
pub fn cpu() -> String {
    let cpuinfo = std::fs::read_to_string("/proc/cpuinfo").ok();
    let model = cpuinfo.as_deref().and_then(model_of);
    let model = model.or_else(|| std::env::var("PROCESSOR_IDENTIFIER").ok());
    let model = model.unwrap_or_else(|| format!("unknown {} processor", std::env::consts::ARCH));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!("{model}, {}", crate::output::counted(threads, "thread"))
}

/// The model of the first processor in the text of Linux's `/proc/cpuinfo`.
fn model_of(cpuinfo: &str) -> Option<String> {
    let value = |line: &str| {
        let (key, value) = line.split_once(':')?;
        ["model name", "Hardware"].contains(&key.trim()).then(|| value.trim().to_owned())
    };
    cpuinfo.lines().find_map(value).filter(|model| !model.is_empty())
}

/// Today in UTC, as `2026-01-31`.
pub fn today() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    day(seconds / 86_400)
}

/// The day that is `days` after 1970-01-01 in the Gregorian calendar.
fn day(mut days: u64) -> String {
    let leap = |year: u64| {
        u64::from(year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400)))
    };
    let mut year = 1970;
    while days >= 365 + leap(year) {
        days -= 365 + leap(year);
        year += 1;
    }
    let mut month = 1;
    for length in [31, 28 + leap(year), 31, 30, 31, 30, 31, 31, 30, 31, 30] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    format!("{year}-{month:02}-{:02}", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar() {
        let days = [0, 58, 59, 364, 365, 789, 790, 11_016, 11_017, 20_788];
        let dates = [
            "1970-01-01",
            "1970-02-28",
            "1970-03-01",
            "1970-12-31",
            "1971-01-01",
            "1972-02-29",
            "1972-03-01",
            "2000-02-29",
            "2000-03-01",
            "2026-12-01",
        ];
        assert_eq!(days.map(day), dates);
        assert!(today().as_str() > "2026-01-01");
    }

    #[test]
    fn the_model_is_that_of_the_first_processor() {
        let text = "processor\t: 0\nmodel\t\t: 85\nmodel name\t: A CPU @ 2 GHz\n\nmodel name\t: B\n";
        assert_eq!(model_of(text).as_deref(), Some("A CPU @ 2 GHz"));
        assert_eq!(model_of("processor\t: 0\nmodel name\t:\n"), None);
        assert!(cpu().contains(" thread"), "{}", cpu());
    }
}
