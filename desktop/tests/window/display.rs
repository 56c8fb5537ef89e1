//! An X server without a screen (Xvfb).

use std::{
    io::{BufRead, BufReader},
    process::{Child, Command, Stdio},
};

/// A running server, ended when dropped.
pub struct Display {
    server: Child,
    name: String,
}

impl Display {
    pub fn new() -> Self {
        let mut server = Command::new("Xvfb")
            // Xvfb chooses a free display number and prints it when it is ready.
            .args(["-displayfd", "1", "-screen", "0", "2560x1600x24", "-nolisten", "tcp", "-noreset"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("Xvfb: {error}: run `sh desktop/setup.sh`, which installs it"));
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.trim().is_empty(), "Xvfb ended before it was ready: {:?}", server.wait());
        Self { server, name: format!(":{}", number.trim()) }
    }

    /// Value of the `DISPLAY` variable.
    pub fn name(&self) -> &str {
        &self.name
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}
