//! The worker: traces planes row by row and delivers them to the accumulator.

use std::sync::{
    Arc,
    mpsc::{Receiver, SyncSender, TryRecvError, TrySendError},
};

use glam::DVec3;

use super::{Delivery, Order, SampleImage};
use crate::reference::{Reference, ReferenceFrame, Rounding};

/// Traces planes of path samples on the thread that calls it.
pub struct Worker {
    orders: Receiver<Arc<Order>>,
    deliveries: SyncSender<Delivery>,
    order: Arc<Order>,
    begun: Option<Begun>,
    /// Finished samples that have not been delivered yet.
    finished: Option<SampleImage>,
}

/// A sample in progress; the rows before `row` are traced.
struct Begun {
    sample: u32,
    row: u32,
    rgb: Vec<f32>,
}

impl Worker {
    pub(super) fn new(
        orders: Receiver<Arc<Order>>,
        deliveries: SyncSender<Delivery>,
        order: Arc<Order>,
    ) -> Self {
        Self { orders, deliveries, order, begun: None, finished: None }
    }

    /// Traces one row of pixels of the newest view; an unfinished plane of another view is discarded. Returns
    /// false once the accumulator has ended the work and all finished samples are delivered; further calls do
    /// nothing.
    pub fn step(&mut self, reference: &Reference) -> bool {
        loop {
            match self.orders.try_recv() {
                Ok(order) => {
                    self.give_up();
                    self.order = order;
                }
                Err(TryRecvError::Empty) => break,
                Err(TryRecvError::Disconnected) => {
                    self.end();
                    return false;
                }
            }
        }
        self.trace_row(reference);
        self.hand_over();
        true
    }

    fn trace_row(&mut self, reference: &Reference) {
        let view = self.order.view;
        let [width, height] = view.size;
        let place = |[x, y]: [u32; 2]| 3 * (y as usize * width as usize + x as usize);
        let begun = self.begun.get_or_insert_with(|| Begun {
            sample: self.order.begin(),
            row: 0,
            rgb: vec![0.0; place([0, height])],
        });
        let frame =
            ReferenceFrame { reference, camera: view.camera, size: view.size, settings: view.settings };
        let mut add = |pixel, radiance: DVec3| {
            let sum = begun.rgb[place(pixel)..].iter_mut();
            sum.zip(radiance.as_vec3().to_array()).for_each(|(sum, more)| *sum += more);
        };
        let row = (begun.row..height).take(1);
        for pixel in row.flat_map(|y| (0..width).map(move |x| [x, y])) {
            let path = frame.path(pixel, begun.sample, &mut Rounding::none());
            add(pixel, path.own * path.radiance);
            if let Some(splat) = path.splat {
                add(splat.pixel, splat.share * path.radiance);
            }
        }
        begun.row += 1;
        if begun.row >= height {
            self.finish();
        }
    }

    fn finish(&mut self) {
        let Some(Begun { rgb, .. }) = self.begun.take() else { return };
        let image = SampleImage { samples: 1, rgb };
        match &mut self.finished {
            Some(finished) => finished.add(&image),
            None => self.finished = Some(image),
        }
    }

    /// Delivers finished samples if the channel has room; otherwise retries after the next row.
    fn hand_over(&mut self) {
        let Some(image) = self.finished.take() else { return };
        match self.deliveries.try_send(Delivery { order: self.order.clone(), image }) {
            Ok(()) => {}
            Err(TrySendError::Full(delivery)) => self.finished = Some(delivery.image),
            Err(TrySendError::Disconnected(delivery)) => self.order.tally.give_up(delivery.image.samples),
        }
    }

    /// Delivers the last samples; blocks until the channel has room, as the accumulator waits for them.
    fn end(&mut self) {
        if let Some(image) = self.finished.take() {
            let samples = image.samples;
            if self.deliveries.send(Delivery { order: self.order.clone(), image }).is_err() {
                self.order.tally.give_up(samples);
            }
        }
        self.give_up();
    }

    fn give_up(&mut self) {
        let begun = u32::from(self.begun.take().is_some());
        self.order.tally.give_up(begun + self.finished.take().map_or(0, |image| image.samples));
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.give_up();
    }
}
