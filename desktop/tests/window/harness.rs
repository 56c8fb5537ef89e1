//! Plays scripts with the program, in a window or without one, and checks how it ended.

use std::{
    fs::{self, File},
    io::{BufRead, BufReader},
    path::PathBuf,
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

use glimpse::{DisplayImage, Picture};
use tempfile::TempDir;

use crate::display::Display;

/// Timeout, after which the program is considered hung.
const TIMEOUT: Duration = Duration::from_secs(600);

/// A working folder, and a display for tests with a window.
pub struct ScriptHarness {
    folder: TempDir,
    display: Option<Display>,
}

/// Exit code and output of the program.
pub struct Ended {
    pub code: Option<i32>,
    pub stdout: Vec<String>,
    pub stderr: String,
}

impl Ended {
    /// Values printed by the script for a name, in order.
    pub fn told(&self, name: &str) -> Vec<&str> {
        let value = |line: &'_ String| line.strip_prefix(name)?.strip_prefix(" = ").map(str::len);
        let of = |line| value(line).map(|length: usize| &line[line.len() - length..]);
        self.stdout.iter().filter_map(of).collect()
    }
}

impl ScriptHarness {
    pub fn with_window() -> Self {
        Self { folder: tempfile::tempdir().unwrap(), display: Some(Display::new()) }
    }

    pub fn headless() -> Self {
        Self { folder: tempfile::tempdir().unwrap(), display: None }
    }

    /// Value of the `DISPLAY` variable.
    pub fn display(&self) -> &str {
        self.display.as_ref().map(Display::name).expect("a harness with a window")
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn picture(&self, name: &str) -> DisplayImage {
        let bytes = fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        Picture::decode(&bytes).unwrap().into_display()
    }

    /// Plays a script, which must succeed without messages on stderr.
    pub fn plays(&self, arguments: &str, script: &str) -> Ended {
        self.plays_watched(arguments, script, |_| {})
    }

    /// Plays a script as [`ScriptHarness::plays`]; `line` is called with the process id for every line of
    /// output.
    pub fn plays_watched(&self, arguments: &str, script: &str, line: impl FnMut(u32)) -> Ended {
        let ended = self.run(arguments, script, line);
        assert!(ended.code == Some(0) && ended.stderr.is_empty(), "{:?}: {}", ended.code, ended.stderr);
        ended
    }

    /// Plays a script, which must fail with one line on stderr.
    pub fn fails(&self, arguments: &str, script: &str, code: i32) -> String {
        let Ended { code: found, stderr, .. } = self.run(arguments, script, |_| {});
        assert_eq!(found, Some(code), "{stderr}");
        assert!(!stderr.contains("this is a bug"), "{stderr}");
        let line = stderr.strip_prefix("glimpse: error: ").unwrap_or_else(|| panic!("{stderr}"));
        assert_eq!(line.lines().count(), 1, "{line}");
        line.trim_end().to_owned()
    }

    /// Runs `glimpse view ARGUMENTS` with a script.
    fn run(&self, arguments: &str, script: &str, mut line: impl FnMut(u32)) -> Ended {
        fs::write(self.path("a.script"), script).unwrap();
        let mut command = self.glimpse();
        command.arg("view").args(arguments.split_whitespace()).args(["--script", "a.script"]);
        if let Some(display) = &self.display {
            command.env("DISPLAY", display.name());
        } else {
            command.arg("--headless");
        }
        let stderr = self.path("stderr");
        let mut child = command.stderr(File::create(&stderr).unwrap()).spawn().unwrap();
        let (id, output) = (child.id(), child.stdout.take().unwrap());
        let waiting = thread::spawn(move || wait(&mut child));
        let mut stdout = Vec::new();
        for told in BufReader::new(output).lines() {
            stdout.push(told.unwrap());
            line(id);
        }
        let code = waiting.join().unwrap();
        Ended { code, stdout, stderr: fs::read_to_string(stderr).unwrap() }
    }

    /// The program in this harness's folder, without a display. Errors of wgpu are logged.
    pub fn glimpse(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_glimpse"));
        command
            .current_dir(self.folder.path())
            .env("RUST_LOG", "error")
            .env("WINIT_X11_SCALE_FACTOR", "1")
            // Freed memory goes back to the system, so that resident memory shows what is kept.
            .env("MALLOC_ARENA_MAX", "1")
            .env("MALLOC_TRIM_THRESHOLD_", "131072")
            .env("MALLOC_MMAP_THRESHOLD_", "131072")
            .env_remove("DISPLAY")
            .env_remove("WAYLAND_DISPLAY")
            .stdin(Stdio::null())
            .stdout(Stdio::piped());
        command
    }
}

/// Waits for the exit code; a hung process is killed.
fn wait(child: &mut Child) -> Option<i32> {
    let began = Instant::now();
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return status.code();
        }
        if began.elapsed() > TIMEOUT {
            child.kill().unwrap();
            let _ = child.wait();
            panic!("still running after {TIMEOUT:?}");
        }
        thread::sleep(Duration::from_millis(20));
    }
}
