//! The desktop's window: passes winit's events to the session, and presents its frames.

use std::{path::PathBuf, sync::Arc, time::Instant};

use glimpse::Gpu;
use glimpse_app::{App, Choices, Wake, script::ShellEvent};
use winit::{
    application::ApplicationHandler,
    dpi::PhysicalSize,
    event::{StartCause, WindowEvent},
    event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy},
    window::{Fullscreen, Window, WindowAttributes, WindowId},
};

use crate::{
    Result, Setup,
    session::{Leftover, RETRY, Session, Shown},
    surface::Surface,
};

/// How a file dialog ended.
#[derive(Debug)]
pub enum DialogEnd {
    /// The user chose this file.
    File(PathBuf),
    /// The user closed the dialog without choosing a file.
    Cancelled,
    /// The system has no file dialog.
    Missing,
}

/// Called when a file dialog has ended, on any thread.
pub type DialogEnded = Box<dyn FnOnce(DialogEnd) + Send>;

/// Shows a file dialog without blocking.
pub type OpenDialog = Box<dyn FnMut(DialogEnded)>;

/// Events from outside the event loop.
#[derive(Debug)]
pub enum Wakeup {
    /// The worker has sent a message.
    WorkerEvent,
    /// The file dialog has ended.
    Dialog(DialogEnd),
}

/// Runs the window until it is closed or the script ends.
///
/// # Errors
/// There is no display or no device, or a step of the script failed.
pub fn run(event_loop: EventLoop<Wakeup>, setup: Setup, open_dialog: OpenDialog) -> Result<()> {
    let proxy = event_loop.create_proxy();
    let waker = proxy.clone();
    // The event loop has ended where sending fails.
    let wake: Wake = Arc::new(move || drop(waker.send_event(Wakeup::WorkerEvent)));
    let mut shell = Shell {
        session: Session::new(setup, wake),
        proxy,
        open_dialog,
        instance: None,
        window: None,
        gpu: None,
        surface: None,
        size: [1, 1],
        title: String::new(),
        input: None,
        paused: false,
        failed: None,
    };
    event_loop.run_app(&mut shell).map_err(|error| format!("the event loop failed: {error}"))?;
    shell.failed.map_or(Ok(()), Err)
}

struct Shell {
    session: Session,
    proxy: EventLoopProxy<Wakeup>,
    open_dialog: OpenDialog,
    instance: Option<wgpu::Instance>,
    window: Option<Arc<Window>>,
    gpu: Option<Arc<Gpu>>,
    surface: Option<Surface>,
    /// Size of the surface in pixels, or of the last one.
    size: [u32; 2],
    /// Title of the window.
    title: String,
    input: Option<egui_winit::State>,
    /// A script has paused the app, which has no surface then.
    paused: bool,
    failed: Option<String>,
}

impl ApplicationHandler<Wakeup> for Shell {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let made = self.make_window(event_loop).and_then(|()| self.make_surface());
        self.end_on_failure(event_loop, made);
    }

    fn suspended(&mut self, _: &ActiveEventLoop) {
        self.surface = None;
    }

    fn user_event(&mut self, _: &ActiveEventLoop, wakeup: Wakeup) {
        match wakeup {
            Wakeup::Dialog(DialogEnd::File(file)) => self.session.app.open(&App::file_name(&file)),
            Wakeup::Dialog(DialogEnd::Missing) => self.session.app.browse(),
            Wakeup::Dialog(DialogEnd::Cancelled) | Wakeup::WorkerEvent => {}
        }
        self.redraw();
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if matches!(cause, StartCause::ResumeTimeReached { .. }) {
            self.redraw();
        }
    }

    fn memory_warning(&mut self, _: &ActiveEventLoop) {
        self.session.app.trim();
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let (Some(window), Some(input)) = (&self.window, &mut self.input) else { return };
        match event {
            WindowEvent::RedrawRequested => {
                let drawn = self.frame(event_loop);
                self.end_on_failure(event_loop, drawn);
                return;
            }
            WindowEvent::CloseRequested => return event_loop.exit(),
            _ => {}
        }
        // Input of the real mouse is ignored while a script is played.
        let heard = self.session.is_scripted() || input.on_window_event(window, &event).repaint;
        if heard || matches!(event, WindowEvent::Resized(_)) {
            self.redraw();
        }
    }
}

impl Shell {
    fn redraw(&self) {
        if let Some(window) = &self.window {
            window.request_redraw();
        }
    }

    fn end_on_failure(&mut self, event_loop: &ActiveEventLoop, result: Result<()>) {
        if let Err(line) = result {
            self.failed.get_or_insert(line);
            event_loop.exit();
        }
    }

    fn make_window(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        if self.window.is_some() {
            return Ok(());
        }
        let setup = self.session.setup();
        let [width, height] = setup.screen.map_or(setup.size, |screen| fitting(event_loop, screen.pixels));
        let attributes = WindowAttributes::default()
            .with_title("Glimpse")
            .with_inner_size(PhysicalSize::new(width, height))
            .with_min_inner_size(PhysicalSize::new(1, 1));
        let window = event_loop.create_window(attributes).map_err(|error| format!("no window: {error}"))?;
        self.window = Some(Arc::new(window));
        let mut descriptor = wgpu::InstanceDescriptor::new_with_display_handle_from_env(Box::new(
            event_loop.owned_display_handle(),
        ));
        descriptor.backends &= wgpu::Backends::PRIMARY;
        self.instance = Some(wgpu::Instance::new(descriptor));
        Ok(())
    }

    /// Creates a surface for the window, and a device that supports it where there is none.
    fn make_surface(&mut self) -> Result<()> {
        let (Some(window), Some(instance)) = (&self.window, &self.instance) else { return Ok(()) };
        self.surface = None;
        let surface =
            instance.create_surface(window.clone()).map_err(|error| format!("no surface: {error}"))?;
        let is_new = self.gpu.is_none();
        let gpu = match &self.gpu {
            Some(gpu) => gpu.clone(),
            None => {
                let setup = self.session.setup();
                let (adapter, limits) = (setup.adapter.as_deref(), setup.limits.as_ref());
                let gpu = Gpu::for_surface(instance, adapter, Some(&surface), limits);
                Arc::new(gpu.map_err(|error| error.to_string())?)
            }
        };
        let surface = Surface::new(surface, &gpu, pixels(window), self.session.app.choices().vsync)?;
        if is_new {
            self.session.attach(&gpu, surface.format());
            self.input = Some(egui_winit::State::new(
                self.session.app.context().clone(),
                egui::ViewportId::ROOT,
                window.as_ref(),
                Some(window.scale_factor() as f32),
                window.theme(),
                Some(gpu.limits().max_texture_dimension_2d as usize),
            ));
        }
        self.gpu = Some(gpu);
        self.surface = Some(surface);
        window.request_redraw();
        Ok(())
    }

    fn frame(&mut self, event_loop: &ActiveEventLoop) -> Result<()> {
        let (Some(window), Some(input)) = (self.window.clone(), &mut self.input) else { return Ok(()) };
        let Choices { vsync, .. } = *self.session.app.choices();
        if let Some(surface) = &mut self.surface {
            surface.follow(pixels(&window), vsync);
            self.size = surface.size();
        }
        let raw = input.take_egui_input(&window);
        let (mut update, leftover) = self.session.frame(raw, self.size, window.scale_factor() as f32)?;
        let title = self.session.app.title();
        if title != self.title {
            window.set_title(&title);
            self.title = title;
        }
        let surface = self.surface.as_mut().filter(|_| !self.paused);
        let shown = self.session.show(&mut update.painting, surface)?;
        if let Some(input) = &mut self.input {
            input.handle_platform_output(&window, update.platform);
        }
        let mut rest = update.repaint_after;
        match shown {
            Shown::Yes => {}
            Shown::NotNow => rest = RETRY,
            Shown::Lost => self.make_surface()?,
        }
        let flow = match Instant::now().checked_add(rest) {
            _ if self.session.is_scripted() || update.repaint_after.is_zero() => {
                window.request_redraw();
                ControlFlow::Wait
            }
            Some(when) => ControlFlow::WaitUntil(when),
            None => ControlFlow::Wait,
        };
        event_loop.set_control_flow(flow);
        self.follow(event_loop, &window, leftover)
    }

    fn follow(&mut self, event_loop: &ActiveEventLoop, window: &Window, leftover: Leftover) -> Result<()> {
        match leftover.event {
            Some(ShellEvent::Size([width, height])) => resize(window, [width, height]),
            Some(ShellEvent::Rotate) => {
                self.session.turn();
                let size = window.inner_size();
                resize(window, [size.height, size.width]);
            }
            Some(ShellEvent::Minimise) => window.set_minimized(true),
            Some(ShellEvent::Restore) => window.set_minimized(false),
            Some(ShellEvent::FullScreen(on)) => set_full_screen(window, on),
            Some(ShellEvent::Pause) => {
                self.paused = true;
                self.surface = None;
            }
            Some(ShellEvent::Resume) => {
                self.paused = false;
                self.make_surface()?;
            }
            Some(ShellEvent::LoseSurface) => self.make_surface()?,
            Some(ShellEvent::LoseDevice) => self.gpu.iter().for_each(|gpu| gpu.destroy()),
            Some(ShellEvent::LowMemory | ShellEvent::Thermal(_)) | None => {}
        }
        if leftover.full_screen {
            set_full_screen(window, window.fullscreen().is_none());
        }
        if leftover.dialog {
            let proxy = self.proxy.clone();
            // The event loop has ended where sending fails.
            (self.open_dialog)(Box::new(move |end| drop(proxy.send_event(Wakeup::Dialog(end)))));
        }
        if leftover.new_device {
            self.gpu = None;
            self.make_surface()?;
        }
        if leftover.quit {
            event_loop.exit();
        }
        Ok(())
    }
}

fn pixels(window: &Window) -> [u32; 2] {
    window.inner_size().into()
}

fn resize(window: &Window, [width, height]: [u32; 2]) {
    // Where the size changes at once, winit returns it here and sends no event; the next frame reads it from the
    // window.
    let _ = window.request_inner_size(PhysicalSize::new(width, height));
}

fn set_full_screen(window: &Window, on: bool) {
    window.set_fullscreen(on.then_some(Fullscreen::Borderless(None)));
}

/// The size of the phone's screen, reduced to fit on the monitor.
fn fitting(event_loop: &ActiveEventLoop, pixels: [u32; 2]) -> [u32; 2] {
    let monitor = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next());
    let Some(monitor) = monitor.map(|monitor| monitor.size()) else { return pixels };
    let room = [monitor.width, monitor.height].map(|side| 0.9 * side as f32);
    let scale = (room[0] / pixels[0] as f32).min(room[1] / pixels[1] as f32).min(1.0);
    pixels.map(|side| ((side as f32 * scale).round() as u32).max(1))
}
