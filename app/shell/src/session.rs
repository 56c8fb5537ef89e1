//! A frame of the app, whatever it is shown on: input in, picture out, and what was asked for done.

use std::{
    io::Write,
    path::PathBuf,
    sync::Arc,
    time::{Duration, Instant},
};

use egui::{Rect, pos2, vec2};
use glimpse::{DisplayImage, Gpu};
use glimpse_app::{
    App, Painting, Request, Update, Wake,
    script::{Ask, Player, ShellEvent},
};

use crate::{Result, Screen, Setup, Surface, surface::Acquired, touch::Finger};

/// The app, the script that plays it, and what the platform lends.
pub struct Session {
    /// The app.
    pub app: App,
    player: Option<Player>,
    setup: Setup,
    started: Instant,
    /// The mouse of a phone.
    finger: Finger,
    /// The window is being turned: what is shown is as wide as the emulated screen is high.
    turned: bool,
    /// Files for what the window shows, as soon as it shows something.
    shots: Vec<PathBuf>,
}

/// What became of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// It is shown, or there is nothing to show it on.
    Yes,
    /// The surface takes none now: to be tried again after [`RETRY`].
    NotNow,
    /// The surface is gone: a new one is to be made.
    Lost,
}

/// How long a surface that takes no picture is left alone.
pub const RETRY: Duration = Duration::from_millis(100);

/// What a frame leaves to be done by what shows it.
#[derive(Default)]
pub struct Leftover {
    /// What a script lets happen to the window.
    pub event: Option<ShellEvent>,
    /// The window as large as the screen, or not.
    pub full_screen: bool,
    /// The device is lost.
    pub new_device: bool,
    /// A person wants to choose a file.
    pub dialog: bool,
    /// The end.
    pub quit: bool,
}

impl Session {
    /// Without a device: see [`Session::attach`]. `wake` is called from other threads when there is news.
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
            shots: Vec::new(),
        }
    }

    /// What the platform lends.
    #[must_use]
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// A script is being played: frames follow each other without pause.
    pub fn is_scripted(&self) -> bool {
        self.player.is_some()
    }

    /// Takes a device, as [`App::attach`].
    pub fn attach(&mut self, gpu: &Arc<Gpu>, format: wgpu::TextureFormat) {
        self.app.attach(gpu.clone(), format);
    }

    /// Turns the screen that is emulated.
    pub fn turn(&mut self) {
        self.turned = !self.turned;
    }

    /// The screen that is emulated, as it is held now.
    pub fn screen(&self) -> Option<Screen> {
        let screen = self.setup.screen?;
        if !self.turned {
            return Some(screen);
        }
        let ([width, height], [left, top, right, bottom]) = (screen.pixels, screen.insets);
        Some(Screen { pixels: [height, width], insets: [top, right, bottom, left], ..screen })
    }

    /// Fills in what the input does not know of a view of that many pixels, plays the script, updates the app.
    ///
    /// # Errors
    /// A script that was not met.
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
            // As many points as on the phone, however large the window is.
            Some(screen) => screen.pixels_per_point * size[0] as f32 / screen.pixels[0] as f32,
            None => pixels_per_point,
        };
        let points = native * self.app.context().zoom_factor();
        let view = Rect::from_min_size(pos2(0.0, 0.0), vec2(size[0] as f32, size[1] as f32) / points);
        if let Some(screen) = screen {
            // Positions are in points of the window's own.
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
            self.grant(request, &mut leftover)?;
        }
        Ok((update, leftover))
    }

    /// The time of this frame.
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
                writeln!(std::io::stdout(), "{line}").map_err(|error| format!("standard output: {error}"))?;
            }
            Some(Ask::Cost(cost)) => app.set_cost(cost),
            Some(Ask::Screenshot(file)) => app.screenshot(Some(file)),
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

    fn grant(&mut self, request: Request, leftover: &mut Leftover) -> Result<()> {
        match request {
            Request::OpenDialog => leftover.dialog = true,
            Request::Save(file, picture) => self.save(file, &picture)?,
            Request::Remember(files) => (self.setup.remember)(&files),
            Request::FullScreen => leftover.full_screen = true,
            Request::NewDevice => leftover.new_device = true,
            Request::Quit => leftover.quit = true,
        }
        Ok(())
    }

    /// Paints and presents. Without a surface the overlay is kept up to date.
    ///
    /// # Errors
    /// A picture of the window that could not be saved.
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
        // A device that is lost by that tells nobody else.
        Ok(if surface.is_lost() { Shown::NotNow } else { Shown::Yes })
    }

    /// A picture of the window is wanted.
    pub(crate) fn wants_shot(&self) -> bool {
        !self.shots.is_empty()
    }

    /// Saves what the window shows where that is wanted.
    pub(crate) fn shoot(&mut self, picture: &DisplayImage) -> Result<()> {
        for file in std::mem::take(&mut self.shots) {
            // No notice: it would be in the next.
            (self.setup.save)(Some(file), picture)?;
        }
        Ok(())
    }

    /// Saves a picture; a script ends where that fails.
    fn save(&mut self, file: Option<PathBuf>, picture: &DisplayImage) -> Result<()> {
        match (self.setup.save)(file, picture) {
            Ok(text) => self.app.notify(text),
            Err(line) if self.player.is_some() => return Err(line),
            Err(line) => self.app.complain(line),
        }
        Ok(())
    }
}
