//! A session: updates the app, plays scripts, and carries out the app's requests, on any kind of window.

use std::{
    path::PathBuf,
    sync::Arc,
    time::{Duration, Instant},
};

use egui::{Rect, pos2, vec2};
use glimpse::{DisplayImage, Gpu};
use glimpse_app::{
    App, Capture, Painting, Request, Update, Wake,
    script::{Ask, Player, ShellEvent},
};

use crate::{Result, Screen, Setup, Surface, surface::Acquired, touch::Finger};

/// The app, the script that plays it, and the platform's setup.
pub struct Session {
    /// The application.
    pub app: App,
    player: Option<Player>,
    setup: Setup,
    started: Instant,
    /// Converts the mouse into touches while a phone is emulated.
    finger: Finger,
    /// The emulated screen is rotated by 90 degrees.
    turned: bool,
    /// A picture of the frame is to be compared.
    comparing: bool,
    /// Files to save the window's content in, once it shows something.
    shots: Vec<PathBuf>,
}

/// The result of presenting a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// It is presented, or there is no surface.
    Yes,
    /// The surface has no texture at present: try again after [`RETRY`].
    NotNow,
    /// The surface is lost: create a new one.
    Lost,
}

/// Time to wait before a surface without a texture is tried again.
pub const RETRY: Duration = Duration::from_millis(100);

/// What the window's owner has to do after a frame.
#[derive(Default)]
pub struct Leftover {
    /// An event that the script simulates.
    pub event: Option<ShellEvent>,
    /// Switch between full screen and window.
    pub full_screen: bool,
    /// Create a new device, as the last one is lost.
    pub new_device: bool,
    /// Show a file dialog.
    pub dialog: bool,
    /// End the program.
    pub quit: bool,
}

impl Session {
    /// Creates the app without a device: see [`Session::attach`]. `wake` is called on other threads when the session
    /// has to be updated.
    #[must_use]
    pub fn new(mut setup: Setup, wake: Wake) -> Self {
        let recent = std::mem::take(&mut setup.recent);
        let app = App::new(setup.files.clone(), wake, &setup.scene, recent, setup.choices);
        let player = setup.script.take().map(Player::new);
        Self {
            app,
            player,
            setup,
            started: Instant::now(),
            finger: Finger::default(),
            turned: false,
            comparing: false,
            shots: Vec::new(),
        }
    }

    /// The platform's setup.
    #[must_use]
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// A script is being played: frames follow each other without a pause.
    pub fn is_scripted(&self) -> bool {
        self.player.is_some()
    }

    /// Takes a device and the format of targets, as [`App::attach`].
    pub fn attach(&mut self, gpu: &Arc<Gpu>, format: wgpu::TextureFormat) {
        gpu.add_cached_kernels(self.setup.cached_kernels.iter().copied());
        self.app.attach(gpu.clone(), format);
    }

    /// Rotates the emulated screen by 90 degrees.
    pub fn turn(&mut self) {
        self.turned = !self.turned;
    }

    /// The emulated screen in its present rotation.
    pub fn screen(&self) -> Option<Screen> {
        let screen = self.setup.screen?;
        if !self.turned {
            return Some(screen);
        }
        let ([width, height], [left, top, right, bottom]) = (screen.pixels, screen.insets);
        Some(Screen { pixels: [height, width], insets: [top, right, bottom, left], ..screen })
    }

    /// Completes the input for a view of `size` pixels, plays a step of the script, updates the app, and carries out
    /// its requests.
    ///
    /// # Errors
    /// A step of the script failed, or a picture that it requested could not be saved.
    pub fn frame(
        &mut self,
        mut input: egui::RawInput,
        size: [u32; 2],
        pixels_per_point: f32,
    ) -> Result<(Update, Leftover)> {
        let screen = self.screen();
        let lying = size[0] >= size[1];
        let chosen =
            self.setup.view.map(|[width, height]| if lying { [width, height] } else { [height, width] });
        self.app.set_view(chosen.or(screen.map(|screen| screen.pixels)));
        let native = match screen {
            // The view has as many points as the phone's, whatever the size of the window.
            Some(screen) => screen.pixels_per_point * size[0] as f32 / screen.pixels[0] as f32,
            None => pixels_per_point,
        };
        let points = native * self.app.context().zoom_factor();
        let view = Rect::from_min_size(pos2(0.0, 0.0), vec2(size[0] as f32, size[1] as f32) / points);
        if let Some(screen) = screen {
            // Input positions are in points of the window, not of the emulated screen.
            self.finger.translate(&mut input.events, pixels_per_point / native, view.center());
            let [left, top, right, bottom] = screen.insets;
            input.safe_area_insets =
                Some(egui::SafeAreaInsets(egui::epaint::MarginF32 { left, right, top, bottom }));
        }
        input.viewports.entry(input.viewport_id).or_default().native_pixels_per_point = Some(native);
        input.screen_rect = Some(view);
        let mut leftover = Leftover::default();
        let now = self.play(&mut input, view, &mut leftover)?;
        input.time = Some(now.as_secs_f64());
        let mut update = self.app.update(input, now);
        if self.player.is_some() {
            self.app.wait();
            update.requests.extend(self.app.take_requests());
        }
        for request in std::mem::take(&mut update.requests) {
            self.handle_request(request, &mut leftover)?;
        }
        if self.comparing {
            let place = self.player.as_ref().map(Player::place).unwrap_or_default();
            let problem = self.app.problem().unwrap_or("no picture of it");
            return Err(format!("{place}: expected a frame to compare, found {problem}"));
        }
        Ok((update, leftover))
    }

    /// Plays a step of the script; returns the time of this frame.
    fn play(&mut self, input: &mut egui::RawInput, view: Rect, leftover: &mut Leftover) -> Result<Duration> {
        let Some(player) = &mut self.player else { return Ok(self.started.elapsed()) };
        let app = &mut self.app;
        let rests = app.rests();
        let ask = player.frame(input, view, rests, &|name| app.look(name))?;
        match ask {
            None => {}
            Some(Ask::Open(scene)) => app.open(&scene),
            Some(Ask::Set(change)) => {
                app.change(&change).map_err(|reason| format!("{}: {reason}", player.place()))?;
            }
            Some(Ask::Print(line)) => {
                (self.setup.print)(&line)?;
            }
            Some(Ask::Cost(cost)) => app.set_cost(cost),
            Some(Ask::Screenshot(file)) => app.screenshot(Some(file)),
            Some(Ask::Compare(file, bounds)) => {
                if !app.compare(file, bounds) {
                    return Err(format!("{}: expected a frame to compare, found none yet", player.place()));
                }
                self.comparing = true;
            }
            Some(Ask::Window(file)) => self.shots.push(file),
            Some(Ask::Shell(ShellEvent::LowMemory)) => app.trim(),
            Some(Ask::Shell(ShellEvent::Thermal(factor))) => app.set_thermal(factor),
            Some(Ask::Shell(event)) => leftover.event = Some(event),
            Some(Ask::Quit) => {
                leftover.quit = true;
                if let Some(file) = self.shots.first() {
                    return Err(format!("{}: expected a window to save, found none", file.display()));
                }
            }
        }
        Ok(player.now())
    }

    fn handle_request(&mut self, request: Request, leftover: &mut Leftover) -> Result<()> {
        match request {
            // A script has no user who could answer a dialog.
            Request::OpenDialog if self.player.is_some() => self.app.browse(),
            Request::OpenDialog => leftover.dialog = true,
            Request::Captured(Capture::Save(file), picture) => self.save(file, &picture)?,
            Request::Captured(Capture::Compare(file, bounds), picture) => {
                self.comparing = false;
                let place = self.player.as_ref().map(Player::place).unwrap_or_default();
                (self.setup.compare)(&file, &bounds, &picture)
                    .map_err(|reason| format!("{place}: {reason}"))?;
            }
            Request::KeepKernels => {
                let kernels = self.app.cached_kernels();
                if kernels != self.setup.cached_kernels {
                    (self.setup.keep_kernels)(&kernels);
                    self.setup.cached_kernels = kernels;
                }
            }
            Request::Remember(files) => (self.setup.remember)(&files),
            Request::FullScreen => leftover.full_screen = true,
            Request::NewDevice => leftover.new_device = true,
            Request::Quit => leftover.quit = true,
        }
        Ok(())
    }

    /// Draws the painting on the surface and presents it. Without a surface, only changes of the overlay's textures are
    /// applied.
    ///
    /// # Errors
    /// The window's content could not be read or saved.
    pub fn show(&mut self, painting: &mut Painting, surface: Option<&mut Surface>) -> Result<Shown> {
        let Some(surface) = surface else {
            self.app.paint(painting, None, [1, 1]);
            return Ok(Shown::Yes);
        };
        let picture = match surface.acquire() {
            Acquired::Picture(picture) => picture,
            other => {
                self.app.paint(painting, None, [1, 1]);
                return Ok(if matches!(other, Acquired::Lost) { Shown::Lost } else { Shown::NotNow });
            }
        };
        let view = picture.texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.app.paint(painting, Some(&view), surface.size());
        if self.wants_shot() {
            self.shoot(&surface.read(&picture)?)?;
        }
        surface.present(picture);
        // Losing the device during presentation is reported nowhere else.
        Ok(if surface.is_lost() { Shown::NotNow } else { Shown::Yes })
    }

    /// The window's content is to be saved.
    pub(crate) fn wants_shot(&self) -> bool {
        !self.shots.is_empty()
    }

    /// Saves the window's content under all names that are waiting.
    pub(crate) fn shoot(&mut self, picture: &DisplayImage) -> Result<()> {
        for file in std::mem::take(&mut self.shots) {
            // A notice would be visible in the next picture of the window.
            (self.setup.save)(Some(file), picture)?;
        }
        Ok(())
    }

    /// Saves a picture. A failure ends a script; without one it is shown as an error message.
    fn save(&mut self, file: Option<PathBuf>, picture: &DisplayImage) -> Result<()> {
        match (self.setup.save)(file, picture) {
            Ok(text) => self.app.notify(text),
            Err(line) if self.player.is_some() => return Err(line),
            Err(line) => self.app.report_problem(line),
        }
        Ok(())
    }
}
